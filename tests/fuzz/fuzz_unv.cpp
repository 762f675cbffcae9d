// Universal files, which this program reads itself.
#include "fuzz/model_file.hpp"

namespace dygita::fuzz {

namespace {

void read_as_unv(const std::string& file) {
  attempt([&] {
    ForeignOptions options;
    options.file = file;
    options.skip = {"117"};
    check_model(*ForeignMeshes::of_unv(options));
  });
}

}  // namespace

}  // namespace dygita::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  using namespace dygita::fuzz;
  static const Scratch scratch;
  static const bool is_quiet = (dygita::be_silent(), true);
  scratch.write("input.unv", text_of(data, size));
  if (is_quiet) read_as_unv((scratch.folder() / "input.unv").string());
  return 0;
}
