#include "intake/gmsh_reader.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/fnv1a.hpp"
#include "base/log.hpp"
#include "base/names.hpp"
#include "base/warnings.hpp"
#include "intake/mesh_file.hpp"
#include "intake/mesher_process.hpp"
#include "intake/straighten.hpp"

namespace dygita {

namespace {

// Lengths in millimetres taken for metres, or the reverse, show in the size of a part.
void warn_of_implausible_size(const Mesh& mesh, const std::string& volume) {
  const double length = (mesh.nodes.rowwise().maxCoeff() - mesh.nodes.rowwise().minCoeff()).norm();
  if (length > 100 || length < 1e-5)
    warn(fmt::format(
        "{}: volume '{}' is {:.3g} m across; is 'unit' correct? mesh files are in metres unless 'unit' is given",
        mesh.source, volume, length));
}

TaggedModel mesh_file(const GmshOptions& options) {
  if (options.set.empty()) return ask_mesher({.options = options, .path = options.file}, options.file).model;
  const ParameterFile parameters(options.file, options.set);
  return ask_mesher({.options = options, .path = parameters.path()}, options.file).model;
}

}  // namespace

GmshMeshes::GmshMeshes(const GmshOptions& options) : file_(options.file) {
  check_options(options);
  TaggedModel model = mesh_file(options);
  for (const Straightened& one : straighten(model))
    warn(text_of(one, file_), {"tangled cells of " + file_, std::abs(one.volume_change), one.volume});
  Fnv1a digest;
  for (const TaggedVolume& volume : model.volumes) {
    const MeshPtr mesh = build_mesh(model, volume);
    warn_of_implausible_size(*mesh, volume.name);
    volumes_[volume.name] = mesh;
    digest.add(volume.name);
    digest.add(mesh->digest);
  }
  digest_ = digest.hexadecimal();
}

MeshPtr GmshMeshes::volume(const std::string& name) const {
  const auto found = volumes_.find(name);
  if (found != volumes_.end()) return found->second;
  throw InputError(
      fmt::format("mesh file '{}' has no volume '{}'\n    {}", file_, name, did_you_mean(name, volume_names())));
}

std::vector<std::string> GmshMeshes::volume_names() const {
  std::vector<std::string> names;
  for (const auto& [name, mesh] : volumes_) names.push_back(name);
  return names;
}

}  // namespace dygita
