// Models of Nastran, which this program reads itself: their meshes, and the deck that says what they say.
#include "foreign/imported_deck.hpp"
#include "fuzz/model_file.hpp"

namespace dygita::fuzz {

namespace {

void read_as_bdf(const std::string& file) {
  attempt([&] {
    ForeignOptions options;
    options.file = file;
    options.units = file_units("mm t s");
    options.unit = options.units->length;
    options.skip = {"CQUAD4"};
    check_model(*ForeignMeshes::of_nastran(options));
    demand(!imported_deck({file, "mm t s", {"CQUAD4"}}).empty(), "what has meshes has a deck");
  });
}

}  // namespace

}  // namespace dygita::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  using namespace dygita::fuzz;
  static const Scratch scratch;
  static const bool is_quiet = (dygita::be_silent(), true);
  scratch.write("input.bdf", text_of(data, size));
  if (is_quiet) read_as_bdf((scratch.folder() / "input.bdf").string());
  return 0;
}
