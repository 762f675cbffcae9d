#include "intake/step_assembly.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <set>

#include "base/error.hpp"
#include "base/log.hpp"
#include "base/names.hpp"
#include "base/warnings.hpp"
#include "intake/gmsh_reader.hpp"
#include "intake/mesh_file.hpp"
#include "intake/mesher_process.hpp"
#include "intake/straighten.hpp"
#include "mesh/cell_quality.hpp"

namespace dygita {

namespace {

std::vector<std::string> known_names(const std::vector<StepPart>& parts) {
  std::set<std::string> names;
  for (const StepPart& part : parts)
    for (const std::string& name : {part.name, part.product})
      if (!name.empty()) names.insert(name);
  return {names.begin(), names.end()};
}

std::string extent(const Points& x) {
  const Vec3 size = 1e3 * (x.rowwise().maxCoeff() - x.rowwise().minCoeff());
  return fmt::format("{:.4g} x {:.4g} x {:.4g} mm", size[0], size[1], size[2]);
}

std::string line_of(const StepPart& part) {
  const Mesh& mesh = *part.mesh;
  std::string cells;
  for (const CellBlock& block : mesh.blocks)
    cells += fmt::format("{}{} {}", cells.empty() ? "" : " and ", block.n_cells(), cell_shape(block.type).name);
  return fmt::format("  '{}'{}: {}, {:.4g} cm^3, {}", part.name,
                     part.product.empty() || part.product == part.name ? "" : " (" + part.product + ")",
                     extent(mesh.nodes), 1e6 * volume(mesh),
                     part.copy_of.empty() ? fmt::format("{}, worst shape {:.2g}", cells, worst_shape(mesh))
                                          : fmt::format("the mesh of '{}'", part.copy_of));
}

// Whole, one part after the other, with the nodes moved from one to the next.
std::vector<StepPart> build_parts(MesherAnswer& all) {
  std::vector<StepPart> parts;
  for (size_t i = 0; i < all.solids.size(); ++i) {
    TaggedModel one{
        all.model.file, std::move(all.model.nodes), {std::move(all.model.volumes[i])}, std::move(all.surfaces[i])};
    StepPart& part = parts.emplace_back(StepPart{all.solids[i], {}, {}});
    if (const auto& copy = all.copies[i]) {
      const StepPart& first = parts[copy->of];
      part.copy_of = first.name;
      part.mesh = turned_mesh(*first.mesh, copy->turn, copy->shift);
    } else {
      part.mesh = build_mesh(one, one.volumes[0]);
    }
    all.model.nodes = std::move(one.nodes);
  }
  return parts;
}

}  // namespace

void say_parts(const std::string& file, const std::vector<StepPart>& parts) {
  Points corners(3, 2 * static_cast<Eigen::Index>(parts.size()));
  for (size_t i = 0; i < parts.size(); ++i) {
    corners.col(2 * static_cast<Eigen::Index>(i)) = parts[i].mesh->nodes.rowwise().minCoeff();
    corners.col(2 * static_cast<Eigen::Index>(i) + 1) = parts[i].mesh->nodes.rowwise().maxCoeff();
  }
  say(fmt::format("{}: {} parts, {} in all", file, parts.size(), extent(corners)));
  for (const StepPart& part : parts) {
    say(line_of(part));
    if (const double worst = worst_shape(*part.mesh); part.copy_of.empty() && worst < 0.0)
      warn(
          fmt::format("{}: part '{}' has cells that are inverted at a corner (worst shape {:.2g}, below 0): give it a "
                      "smaller size or more cells around its holes ('round'), or tetrahedra",
                      file, part.name, worst));
  }
}

bool SolidNames::fit(const std::string& pattern) const {
  return fits_pattern(name, pattern) || fits_pattern(product, pattern) || fits_pattern(instance, pattern);
}

bool fits_pattern(const std::string& text, const std::string& pattern) {
  const size_t star = pattern.find('*');
  if (star == std::string::npos) return text == pattern;
  if (!text.starts_with(pattern.substr(0, star))) return false;
  for (size_t from = star; from <= text.size(); ++from)
    if (fits_pattern(text.substr(from), pattern.substr(star + 1))) return true;
  return false;
}

StepAssembly::StepAssembly(const StepOptions& options) {
  file_ = options.file;
  GmshOptions plain;
  plain.file = options.file;
  check_options(plain);
  const std::string kind = kind_of_file(file_);
  if (kind != "step" && kind != "brep")
    throw InputError(
        fmt::format("mesh file '{}': mesh.step takes .step (or .stp) and .brep; mesh.gmsh reads a .{}", file_, kind));
  MesherAnswer answer = ask_mesher({.options = options, .path = file_}, file_);
  for (const Straightened& one : straighten(answer.model))
    warn(text_of(one, file_), {"tangled cells of " + file_, std::abs(one.volume_change), one.volume});
  parts_ = build_parts(answer);
  say_parts(file_, parts_);
}

const StepPart& NamedParts::part(const std::string& name) const {
  std::vector<const StepPart*> found;
  for (const StepPart& part : parts_)
    if (part.name == name) return part;
  for (const StepPart& part : parts_)
    if (part.product == name || part.instance == name) found.push_back(&part);
  if (found.empty())
    throw InputError(
        fmt::format("'{}' has no part '{}'\n    {}", file_, name, did_you_mean(name, known_names(parts_))));
  if (found.size() > 1)
    throw InputError(
        fmt::format("'{}' has {} parts '{}'\n    their names are '{}' to '{}'; assembly:parts \"{}\" "
                    "returns all of them",
                    file_, found.size(), name, found.front()->name, found.back()->name, name));
  return *found.front();
}

std::vector<const StepPart*> NamedParts::parts(const std::string& pattern) const {
  std::vector<const StepPart*> found;
  for (const StepPart& part : parts_)
    if (part.fit(pattern)) found.push_back(&part);
  if (found.empty())
    throw InputError(fmt::format("'{}' has no part that matches '{}'\n    {}", file_, pattern,
                                 did_you_mean(pattern, known_names(parts_))));
  return found;
}

}  // namespace dygita
