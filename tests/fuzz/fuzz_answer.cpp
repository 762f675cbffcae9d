// What comes back through the pipe from the mesher, and the bodies that are made of it: nothing of it is believed.
#include <Eigen/LU>
#include <cmath>

#include "fuzz/target.hpp"
#include "intake/mesher_task.hpp"
#include "intake/straighten.hpp"
#include "mesh/cell_quality.hpp"

namespace dygita::fuzz {

namespace {

void build(const TaggedModel& model, const TaggedVolume& volume) {
  attempt([&] {
    const MeshPtr mesh = build_mesh(model, volume);
    demand(mesh->nodes.allFinite() && mesh->n_cells() > 0, "a mesh that is accepted is finite");
    worst_shape(*mesh);
    dygita::volume(*mesh);
  });
}

// As of a file of gmsh's, and as of an assembly.
void build_all(MesherAnswer& answer) {
  for (const Straightened& one : straighten(answer.model)) text_of(one, "input");
  for (const TaggedVolume& volume : answer.model.volumes) build(answer.model, volume);
  for (size_t i = 0; i < answer.solids.size(); ++i) {
    if (const auto& copy = answer.copies.at(i)) {
      demand(!answer.copies.at(copy->of) && std::abs(copy->turn.determinant() - 1.0) < 1e-6,
             "a copy is of a solid before it, turned");
      continue;
    }
    TaggedModel one{"input", answer.model.nodes, {answer.model.volumes.at(i)}, answer.surfaces.at(i)};
    build(one, one.volumes[0]);
  }
}

}  // namespace

}  // namespace dygita::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  using namespace dygita;
  using namespace dygita::fuzz;
  const std::string bytes = text_of(data, size);
  MesherAnswer answer;
  if (!attempt([&] { answer = answer_of(bytes, "input"); })) return 0;
  demand(answer_of(to_bytes(answer), "input").model.nodes.size() == answer.model.nodes.size(),
         "an answer reads back as it was");
  attempt([&] { build_all(answer); });
  return 0;
}
