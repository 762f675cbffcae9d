// What the program itself reads of a .geo or .step before the mesher does: parameters, included files, the unit.
#include "fuzz/target.hpp"
#include "intake/file_text.hpp"
#include "intake/geo_script.hpp"
#include "intake/mesh_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  using namespace dygita;
  using namespace dygita::fuzz;
  static const Scratch scratch;
  const std::string text = text_of(data, size);
  for (const char* name : {"input.geo", "input.step"}) {
    scratch.write(name, text);
    const std::string file = (scratch.folder() / name).string();
    attempt([&] {
      GmshOptions options;
      options.file = file;
      if (const GeoFacts facts = geo_facts(file); !facts.parameters.empty()) options.set[facts.parameters[0]] = 1.0;
      options.unit = 1e-3;
      check_options(options);
      if (!options.set.empty()) const ParameterFile with(file, options.set);
    });
    attempt([&] { step_unit(file); });
    attempt([&] { check_script(file); });
  }
  return 0;
}
