// Meshes of other programs, which this one reads itself: .inp.
#include "fuzz/model_file.hpp"

namespace dygita::fuzz {

namespace {

void read_as_inp(const std::string& file, const std::optional<FileUnits>& units) {
  attempt([&] {
    ForeignOptions options;
    options.file = file;
    options.units = units;
    if (units) options.unit = units->length;
    options.skip = {"S4"};
    check_model(*ForeignMeshes::of_abaqus(options));
  });
}

}  // namespace

}  // namespace dygita::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  using namespace dygita::fuzz;
  static const Scratch scratch;
  static const bool is_quiet = (dygita::be_silent(), true);
  scratch.write("input.inp", text_of(data, size));
  read_as_inp((scratch.folder() / "input.inp").string(),
              is_quiet ? std::optional(dygita::file_units("mm t s")) : std::nullopt);
  return 0;
}
