#include "mesher/step_solids.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <set>

#include "base/error.hpp"
#include "base/names.hpp"
#include "mesher/equal_solids.hpp"
#include "mesher/gmsh_session.hpp"

namespace dygita {

namespace {

constexpr double relative_within = 1e-4;  // of the assembly's diagonal: faces nearer than that touch
constexpr double cells_across = 20.0;     // the diagonal of a part whose size nobody says

// "Shapes/joint/bolt3/M10 bolt": the product last, the instance before it.
void read_names(Solid& solid) {
  std::string path;
  gmsh::model::getEntityName(3, solid.tag, path);
  std::vector<std::string> levels(1);
  for (const char c : path) c == '/' ? levels.emplace_back() : levels.back() += c;
  solid.part.product = levels.back();
  if (levels.size() > 2) solid.part.instance = levels[levels.size() - 2];
  // Several solids of one product, as NX writes them, are instances that OpenCASCADE calls by a label: "=>[0:1:1:3]".
  if (solid.part.instance.starts_with("=>[")) solid.part.instance.clear();
}

// Unique names: the product's; where that repeats the instance's; where that repeats or is missing, with the number.
void name_parts(std::vector<Solid>& solids) {
  const auto count = [&](const auto& member, const std::string& name) {
    return std::count_if(solids.begin(), solids.end(), [&](const Solid& s) { return member(s.part) == name; });
  };
  const auto product = [](const SolidNames& part) { return part.product; };
  const auto instance = [](const SolidNames& part) { return part.instance; };
  for (size_t i = 0; i < solids.size(); ++i) {
    SolidNames& part = solids[i].part;
    if (!part.instance.empty() && count(instance, part.instance) == 1)
      part.name = part.instance;
    else if (!part.product.empty() && count(product, part.product) == 1)
      part.name = part.product;
    else
      part.name = fmt::format("{}{}", part.product.empty() ? "volume" : part.product + " ", i + 1);
  }
}

std::vector<std::string> known_names(const std::vector<Solid>& solids) {
  std::set<std::string> names;
  for (const Solid& solid : solids)
    for (const std::string& name : {solid.part.name, solid.part.product})
      if (!name.empty()) names.insert(name);
  return {names.begin(), names.end()};
}

// Those that the deck asks for; names are given before, so that they do not depend on it.
void keep_asked(const StepOptions& options, std::vector<Solid>& solids) {
  for (const std::string& pattern : options.parts)
    if (std::none_of(solids.begin(), solids.end(), [&](const Solid& one) { return one.part.fit(pattern); }))
      throw InputError(fmt::format("{}: 'parts' names '{}', but no part has this name\n    {}", options.file, pattern,
                                   did_you_mean(pattern, known_names(solids))));
  if (options.parts.empty()) return;
  std::erase_if(solids, [&](const Solid& one) {
    return std::none_of(options.parts.begin(), options.parts.end(),
                        [&](const std::string& pattern) { return one.part.fit(pattern); });
  });
}

// A copy has the cells of the first one: where the deck wants the same of both, and names their faces alike.
void find_copies(const StepOptions& options, double unit, std::vector<Solid>& solids) {
  std::vector<SolidFaces> faces;
  for (const Solid& solid : solids) faces.push_back({solid.tag, solid.surfaces});
  const std::vector<std::optional<SolidCopy>> copies = equal_solids(faces, unit);
  if (std::none_of(copies.begin(), copies.end(), [](const auto& copy) { return copy.has_value(); })) return;
  std::set<int> touching;
  if (is_finer_at_contacts(options)) {
    const StepContacts contacts = contacts_of(solids);
    touching.insert(contacts.surfaces.begin(), contacts.surfaces.end());
  }
  for (size_t i = 0; i < solids.size(); ++i) {
    if (!copies[i]) continue;
    Solid &own = solids[i], &first = solids[copies[i]->of];
    if (own.size == first.size && own.surface_names == first.surface_names &&
        std::equal(own.surfaces.begin(), own.surfaces.end(), first.surfaces.begin(),
                   [&](int a, int b) { return touching.contains(a) == touching.contains(b); }))
      own.copy = copies[i];
  }
}

}  // namespace

Box box_of(int dimension, int tag) {
  Box box;
  gmsh::model::getBoundingBox(dimension, tag, box.low[0], box.low[1], box.low[2], box.high[0], box.high[1],
                              box.high[2]);
  return box;
}

StepContacts contacts_of(const std::vector<Solid>& solids) {
  std::map<int, std::vector<int>> surfaces_of;
  Box whole;
  for (const Solid& solid : solids) {
    surfaces_of[solid.tag] = solid.surfaces;
    const Box box = box_of(3, solid.tag);
    whole.add(box.low);
    whole.add(box.high);
  }
  return step_contacts(surfaces_of, relative_within * whole.size().norm());
}

bool is_finer_at_contacts(const StepOptions& options) { return options.fine || options.sizes.contains("contacts"); }

std::vector<Solid> read_solids(const StepOptions& options, double unit) {
  std::vector<Solid> solids;
  for (const int tag : gmsh_tags(3)) {
    Solid& solid = solids.emplace_back();
    solid.tag = tag;
    read_names(solid);
    GmshEntities boundary;
    gmsh::model::getBoundary({{3, tag}}, boundary, false, false);
    for (const auto& [dimension, surface] : boundary) {
      solid.surfaces.push_back(surface);
      gmsh::model::getEntityName(dimension, surface, solid.surface_names.emplace_back());
    }
    solid.size = options.size ? *options.size / unit : box_of(3, tag).size().norm() / cells_across;
  }
  if (solids.empty())
    throw InputError(fmt::format("{}: it contains no solid; surfaces alone cannot be meshed", options.file));
  name_parts(solids);
  keep_asked(options, solids);
  for (const auto& [pattern, size] : options.sizes) {
    if (pattern == "contacts") continue;
    bool is_used = false;
    for (Solid& solid : solids)
      if (solid.part.fit(pattern)) {
        solid.size = size / unit;
        is_used = true;
      }
    if (!is_used)
      throw InputError(fmt::format("{}: 'sizes' names '{}', but no part has this name\n    {}", options.file, pattern,
                                   did_you_mean(pattern, known_names(solids))));
  }
  find_copies(options, unit, solids);
  return solids;
}

}  // namespace dygita
