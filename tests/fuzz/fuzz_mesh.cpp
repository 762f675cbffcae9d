// Mesh files of strangers, .msh, .geo and .step, through the mesher: whatever they are, they are read or refused, in
// time, and leave nothing behind: no file, no process.
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>

#include "base/clock.hpp"
#include "fuzz/target.hpp"
#include "fuzz/text_changes.hpp"
#include "intake/gmsh_reader.hpp"
#include "intake/step_assembly.hpp"
#include "mesh/mesh_limits.hpp"

namespace dygita::fuzz {

namespace {

constexpr double time_limit = 5.0;    // s: many scripts are infinite loops
constexpr double latest = 60.0;       // s, until it is stopped, on a machine that is busy
constexpr double size_in_cad = 5e-3;  // m: few cells, since it is not gmsh's meshing that is to be tried

const char* kind_of(const std::string& text) {
  if (text.starts_with("$")) return "input.msh";
  if (text.starts_with("ISO-10303")) return "input.step";
  return text.starts_with("DBRep") || text.find("CASCADE") < 40 ? "input.brep" : "input.geo";
}

// Errors are as they are told to users; a fault of our own in the mesher is not theirs.
void try_to_read(const std::function<void()>& read) {
  const auto start = Clock::now();
  attempt([&] {
    try {
      read();
    } catch (const InputError& error) {
      demand(std::string(error.what()).find("UndefinedBehaviorSanitizer") == std::string::npos, error.what());
      throw;
    }
  });
  demand(seconds_since(start) < latest, "the mesher is stopped in time");
  demand(waitpid(-1, nullptr, WNOHANG) == -1 && errno == ECHILD, "no process is left");
}

void read_all(const std::string& file) {
  const bool is_cad = file.ends_with(".step") || file.ends_with(".brep");
  try_to_read([&] {
    GmshOptions options;
    options.file = file;
    if (is_cad) options.size = size_in_cad;
    const GmshMeshes meshes(options);
    for (const std::string& name : meshes.volume_names())
      demand(meshes.volume(name)->nodes.allFinite(), "a mesh is finite");
  });
  if (!is_cad) return;
  try_to_read([&] {
    StepOptions options;
    options.file = file;
    options.size = size_in_cad;
    options.order = 1;
    const StepAssembly assembly(options);
  });
}

// A mesher that is not there refuses everything.
bool reads_a_cube(const Scratch& scratch) {
  scratch.write("cube.geo", "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 1, 1, 1};\n");
  GmshOptions options;
  options.file = (scratch.folder() / "cube.geo").string();
  return GmshMeshes(options).volume("volume1")->n_cells() > 0;
}

// The home of the process lies where a file that comes or goes is seen.
const Scratch& home() {
  static const Scratch scratch;
  static const bool is_there = [] {
    const std::string outer = scratch.folder().parent_path().string();
    setenv("HOME", outer.c_str(), 1);
    const bool reads = chdir(outer.c_str()) == 0 && reads_a_cube(scratch);
    set_mesh_limits({.time = time_limit, .trusted = {}});
    return reads;
  }();
  demand(is_there, "a folder to work in, and a mesher");
  return scratch;
}

// What a stranger might try.
const std::vector<std::string> attempts = {"SystemCall \"touch made\";\n",
                                           "Printf(\"x\") > \"made\";\n",
                                           "Save \"made.msh\";\n",
                                           "Print \"made.png\";\n",
                                           "Mesh.SaveAll = 1; Mesh 3; Save \"made.msh\";\n",
                                           "CreateDir \"made\";\n",
                                           "Include \"/dev/zero\";\n",
                                           "Merge \"/dev/random\";\n",
                                           "Merge \"input.geo\";\n",
                                           "For i In {0:1e18}\n  a = i;\nEndFor\n",
                                           "Exit;\n",
                                           "Abort;\n",
                                           "Error(\"%n%s%s\");\n",
                                           "Field[1] = ExternalProcess; Field[1].CommandLine = \"touch made\";\n",
                                           "DefineConstant[ n = 1e300 ];\n",
                                           "General.LogFileName = \"made\";\n",
                                           "Mesh.MeshSizeMax = 1e-9;\n",
                                           "Physical Volume(\"../../x\") = {1};\n",
                                           "Physical Volume(\"a\", 7) = {1, 2, -1, 1e9};\n",
                                           "SetFactory(\"OpenCASCADE\");\nSphere(9) = {0, 0, 0, 1e-300};\n",
                                           "Macro f\n  Call f;\nReturn\nCall f;\n"};

void add_attempt(std::string& text, Random& random) {
  const std::vector<Span> all = lines(text);
  text.insert(all.empty() ? 0 : one_of(all, random).begin, one_of(attempts, random));
}

}  // namespace

}  // namespace dygita::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  using namespace dygita::fuzz;
  const Scratch& scratch = home();
  const std::string text = text_of(data, size), name = kind_of(text);
  scratch.empty();
  scratch.write(name, text);
  read_all((scratch.folder() / name).string());
  scratch.demand_nothing_outside_was_touched();
  scratch.demand_alone(name);
  return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(std::uint8_t* data, size_t size, size_t most, unsigned seed) {
  using namespace dygita::fuzz;
  Random random(seed);
  if (chance(0.2, random)) return LLVMFuzzerMutate(data, size, most);
  std::string text = text_of(data, size);
  using Change = void (*)(std::string&, Random&);
  constexpr std::array<Change, 8> changes = {change_number, change_number, change_number, drop_line,
                                             copy_line,     take_lines,    spoil_byte,    add_attempt};
  const bool is_script = std::string(kind_of(text)) == "input.geo";
  for (size_t n = 1 + random() % 3; n > 0; --n)
    changes[random() % (changes.size() - (is_script ? 0 : 1))](text, random);
  const size_t n = std::min(text.size(), most);
  std::copy_n(text.begin(), n, reinterpret_cast<char*>(data));
  return n;
}
