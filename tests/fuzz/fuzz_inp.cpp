// Meshes of other programs, which this one reads itself: .inp.
#include "foreign/foreign_meshes.hpp"
#include "fuzz/target.hpp"

namespace dygita::fuzz {

namespace {

void read_as_inp(const std::string& file, const std::optional<FileUnits>& units) {
  attempt([&] {
    ForeignOptions options;
    options.file = file;
    options.units = units;
    if (units) options.unit = units->length;
    options.skip = {"S4"};
    const auto read = ForeignMeshes::of_abaqus(options);
    for (const StepPart& part : read->parts()) {
      demand(part.mesh->nodes.allFinite() && volume(*part.mesh) > 0.0, "a part has a volume");
      const auto* regions = read->regions(part.mesh);
      demand(regions != nullptr, "a part has its regions");
      for (const auto& [name, nodes] : *regions)
        for (const int node : nodes) demand(node >= 0 && node < part.mesh->n_nodes(), "regions have nodes of the part");
    }
    for (const char* name : {"STEEL", "M"}) attempt([&] { read->material(name); });
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
