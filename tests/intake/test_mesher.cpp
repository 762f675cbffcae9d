// What the mesher, a process of its own, survives and what it is kept from.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <limits>

#include "base/error.hpp"
#include "intake/gmsh_reader.hpp"
#include "intake/mesher_process.hpp"

namespace dygita::mesher_tests {

namespace {

namespace fs = std::filesystem;

// A folder of files that goes with the test, and the limits of others that come back.
class Mesher : public ::testing::Test {
 protected:
  Mesher() : folder_(fs::temp_directory_path() / ("dygita_mesher_" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~Mesher() override {
    set_mesh_limits({});
    fs::remove_all(folder_);
  }

  fs::path at(const std::string& name) const { return folder_ / name; }
  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(at(name)) << text;
    return at(name).string();
  }
  // "" where it is read. The checks before gmsh are those of the deck: here gmsh sees everything.
  static std::string complaint(const std::string& file) {
    GmshOptions options;
    options.file = file;
    try {
      const GmshMeshes meshes(options);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

 private:
  fs::path folder_;
};

const std::string cube =
    R"(SetFactory("OpenCASCADE"); Box(1) = {0, 0, 0, 1, 1, 1}; MeshSize{ PointsOf{ Volume{1}; } } = 0.5;
)";

TEST_F(Mesher, reads_what_a_harmless_script_includes) {
  file("part.geo", cube);
  EXPECT_EQ(complaint(file("whole.geo", "Include \"part.geo\";\n")), "");
}

// Each writes or runs something where gmsh may; the file `taken` must not come into being.
TEST_F(Mesher, reads_nothing_but_its_own_folder_and_the_decks) {
  const std::string secret = file("secret.geo", "Error(\"the secret is read\");\n" + cube);
  fs::create_directories(at("apart"));
  const std::string curious = file("apart/curious.geo", "Merge \"" + secret + "\";\n");
  const std::string refused = complaint(curious);
  EXPECT_NE(refused, "");
  EXPECT_EQ(refused.find("the secret is read"), std::string::npos) << refused;
  set_mesh_folder(at("").string());  // a deck beside it
  EXPECT_NE(complaint(curious).find("the secret is read"), std::string::npos) << complaint(curious);
  set_mesh_folder("");
}

TEST_F(Mesher, refuses_more_cells_than_any_machine_meshes_before_it_begins) {
  const auto start = std::chrono::steady_clock::now();
  GmshOptions options;
  options.file = file("cube.geo", cube);
  options.size = 1e-4;
  std::string message;
  try {
    const GmshMeshes meshes(options);
  } catch (const InputError& error) {
    message = error.what();
  }
  EXPECT_NE(message.find("cells of 0.1 mm in a part 1.732 m across would be about 8e+12"), std::string::npos)
      << message;
  EXPECT_NE(message.find("is a unit missing or repeated"), std::string::npos) << message;
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
}

TEST_F(Mesher, starts_no_program_and_writes_no_file) {
  const std::string taken = at("taken").string();
  const std::vector<std::pair<std::string, std::string>> attacks = {
      {"call.geo", "SystemCall \"touch " + taken + "\";\n" + cube},
      {"quoted.geo", "a = \"//\"; SystemCall \"touch " + taken + "\";\n" + cube},
      {"unwatched.geo", "NonBlockingSystemCall \"touch " + taken + "\";\n" + cube},
      {"print.geo", "Printf(\"x\") > \"" + taken + "\";\n" + cube},
      {"save.geo", cube + "Mesh 3; Save \"" + taken + ".msh\";\n"},
      {"folder.geo", "CreateDir \"" + taken + "\";\n" + cube},
      {"field.geo", cube + "Field[1] = ExternalProcess; Field[1].CommandLine = \"touch " + taken +
                        "\"; Background Field = 1; Mesh 3;\n"},
      {"hidden.msh", "$x;\nSystemCall \"touch " + taken + "\";\n"}};
  for (const auto& [name, text] : attacks) {
    complaint(file(name, text));
    for (const auto& entry : fs::directory_iterator(at("")))
      EXPECT_FALSE(entry.path().filename().string().starts_with("taken")) << "by " << name;
  }
}

TEST_F(Mesher, obeys_a_file_that_the_user_trusts) {
  const std::string attack = file("call.geo", "SystemCall \"touch " + at("taken").string() + "\";\n" + cube);
  set_mesh_limits({.trusted = {attack}});
  EXPECT_EQ(complaint(attack), "");
  EXPECT_TRUE(fs::exists(at("taken")));
}

TEST_F(Mesher, is_stopped_when_it_runs_on) {
  set_mesh_limits({.time = 1.0, .trusted = {}});
  const std::string said = complaint(file("endless.geo", "For i In {1:1e18}\n  a = i;\nEndFor\n" + cube));
  EXPECT_NE(said.find("gmsh has taken 1 s to read and mesh it, and was stopped"), std::string::npos) << said;
  EXPECT_NE(said.find("--mesh-time-limit"), std::string::npos);
}

// gmsh 4.8 (Debian 12) dies of this recombination; a later one may mesh it.
TEST_F(Mesher, that_crashes_is_an_error_of_the_file) {
  const std::string said = complaint(file("crash.geo", R"(SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 0.02, 0.02, 0.01};
Cylinder(2) = {0.01, 0.01, 0, 0, 0, 0.01, 0.004};
BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }
Mesh.Algorithm = 8; Mesh.RecombineAll = 1; Mesh.RecombinationAlgorithm = 1; Mesh.SubdivisionAlgorithm = 2;
MeshSize{ PointsOf{ Volume{1}; } } = 0.002;
)"));
  if (said.empty()) GTEST_SKIP() << "this gmsh meshes it";
  EXPECT_NE(said.find("crash.geo: gmsh terminated "), std::string::npos) << said;  // by signal, or its sanitizer
}

TEST_F(Mesher, that_cannot_read_a_file_says_so_without_what_a_terminal_obeys) {
  const std::string said = complaint(
      file("spoiled.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 8 1 8\n3 1 0 -5\n$EndNodes\n\x1b[31m"));
  EXPECT_NE(said.find("spoiled.msh"), std::string::npos) << said;
  EXPECT_EQ(said.find('\x1b'), std::string::npos) << said;
}

TEST_F(Mesher, answers_nothing_that_is_believed_unchecked) {
  MesherAnswer answer;
  answer.model.nodes = {{1, Vec3(0, 0, 0)}, {2, Vec3(1, 0, 0)}, {3, Vec3(0, 1, 0)}, {4, Vec3(0, 0, 1)}};
  answer.model.volumes = {{"body", {{CellType::tet4, {1, 2, 3, 4}}}}};
  answer.model.surfaces = {{"base", {{{1, 2, 3}, 3}}}};
  const MesherAnswer read = answer_of(to_bytes(answer), "a.msh");
  EXPECT_EQ(read.model.volumes[0].cells.at(CellType::tet4), (std::vector<size_t>{1, 2, 3, 4}));
  EXPECT_EQ(read.model.surfaces[0].facets[0].corners[2], 3U);
  EXPECT_EQ(read.model.nodes.at(4), Vec3(0, 0, 1));

  const auto refusal = [](const MesherAnswer& wrong) -> std::string {
    try {
      answer_of(to_bytes(wrong), "a.msh");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  MesherAnswer wrong = answer;
  wrong.model.volumes[0].cells[CellType::tet4][3] = 9;
  EXPECT_EQ(refusal(wrong), "a.msh: gmsh returned no valid mesh: a cell with node 9, which is not there");
  wrong = answer;
  wrong.model.nodes[2][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal(wrong), "a.msh: gmsh returned no valid mesh: node 2, which is at no finite place");
  wrong = answer;
  wrong.model.volumes[0].cells[CellType::tet4].pop_back();
  EXPECT_EQ(refusal(wrong), "a.msh: gmsh returned no valid mesh: a cell without all of its nodes");
  const std::string whole = to_bytes(answer);
  EXPECT_THROW(answer_of(whole.substr(0, whole.size() / 2), "a.msh"), InputError);
  EXPECT_THROW(answer_of("", "a.msh"), InputError);
  EXPECT_THROW(answer_of(std::string(100000, '\x81'), "a.msh"), InputError);  // lists within lists
}

}  // namespace

}  // namespace dygita::mesher_tests
