// substructure.superelement, .rigid and mass.point, and what they have in common with other substructures.
#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <filesystem>
#include <map>

#include "base/log.hpp"
#include "deck/build_model.hpp"
#include "intake/condensed_builder.hpp"
#include "intake/superelement_file.hpp"
#include "numerics/dense.hpp"

namespace dygita {

void doubt_size(const Substructure& part) {
  constexpr double smallest_part = 1e-6, largest_part = 5;  // m, beyond them a unit is probably wrong
  const Points& nodes = part.mesh->nodes;
  if (nodes.cols() == 0) return;
  const double size = (nodes.rowwise().maxCoeff() - nodes.rowwise().minCoeff()).maxCoeff();
  if (size >= smallest_part && size <= largest_part) return;
  warn(fmt::format("{}substructure '{}' measures {:g} m; coordinates are metres unless its mesh says unit = mm",
                   part.origin.prefix(), part.name, size));
}

// A translation, or a rotation row by row and a translation: what turns is a mesh of its own.
void set_place(const std::vector<double>& place, Substructure& part) {
  part.place = Eigen::Map<const Vec3>(place.data() + place.size() - 3);
  if (place.size() == 3) return;
  const Mat3 rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(place.data());
  part.mesh = turned_mesh(*part.mesh, rotation, Vec3::Zero());
}

namespace {

// What a mesh of matrices has in the place of a material: what search directions and comparisons of stiffness go by.
Elastic material_like(double young, const char* name) {
  constexpr double poisson = 0.3, bar_speed = 5200.0;  // m/s, as metals have it
  return {name, young, poisson, young / (bar_speed * bar_speed)};
}

// Of consistent systems: lengths, masses and times.
const std::map<std::string, MatrixUnits> units_of = {{"m kg s", {}},
                                                     {"mm t s", {1e-3, 1e3, 1.0}},
                                                     {"mm kg ms", {1e-3, 1.0, 1e-3}},
                                                     {"in lbf s", {0.0254, 4.4482216152605 / 0.0254, 1.0}}};

MeshPtr superelement_of(const LuaArguments& a) {
  if (a.has("file")) {
    for (const char* other : {"stiffness", "mass", "damping", "points", "stiffness_name", "mass_name", "damping_name",
                              "units", "total_mass"})
      if (a.has(other))
        throw InputError(fmt::format(
            "'file' already refers to all matrices: '{}' is for matrices from other programs, without 'file'", other));
    return read_superelement(a.file("file"));
  }
  for (const char* needed : {"mass", "points"})
    if (!a.has(needed))
      throw InputError(fmt::format("'stiffness' requires 'mass' and 'points': '{}' is missing", needed));
  MatrixFiles files{a.file("stiffness"), a.file("mass"), {}, a.file("points")};
  if (a.has("damping")) files.damping = a.file("damping");
  for (const auto& [key, name] :
       {std::pair("stiffness_name", &files.stiffness_name), std::pair("mass_name", &files.mass_name),
        std::pair("damping_name", &files.damping_name)})
    if (a.has(key)) *name = a.text(key);
  if (a.has("units")) files.units = units_of.at(a.text("units"));
  if (a.has("total_mass")) files.total_mass = a.number("total_mass");
  return read_matrices(files);
}

// Nothing is known of its inside where it is held there.
void check_free(const Substructure& part) {
  if (part.velocity.isZero() || !part.mesh->inside->resists(part.mesh->nodes, part.velocity)) return;
  throw InputError(fmt::format(
      "'velocity' of '{}': its matrices resist that motion because a support was condensed with it", part.name));
}

// Matrices are kept dense and sparse, about as large as their texts each.
size_t bytes_of_superelement(const LuaArguments& a) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const auto size = [&](const fs::path& file) {
    const std::uintmax_t own = fs::file_size(file, ignored);
    return ignored ? std::uintmax_t{0} : own;
  };
  std::uintmax_t bytes = 0;
  for (const char* key : {"stiffness", "mass", "damping"})
    if (a.has(key)) bytes += size(a.file(key));
  if (a.has("file"))
    for (const char* what : {"stiffness", "mass", "damping"})
      bytes += size(fs::path(a.file("file")).replace_extension().string() + "_" + what + ".mtx");
  return static_cast<size_t>(2 * bytes);
}

}  // namespace

Content build_superelement(const Declaration& d) {
  auto part = new_named<Substructure>(d);
  const size_t bytes = bytes_of_superelement(d.arguments);
  d.lua.reserve("substructure.superelement", bytes);
  {
    const LuaState::Pause pause(d.lua);
    part->mesh = superelement_of(d.arguments);
  }
  d.lua.hold_reserved(part->mesh, bytes);
  part->material = material_like(part->mesh->inside->matrices()->modulus(part->mesh->nodes), "superelement");
  set_place(d.arguments.numbers("place"), *part);
  part->velocity = d.arguments.vector("velocity");
  check_free(*part);
  doubt_size(*part);
  return SubstructurePtr(part);
}

namespace {

// xx, yy, zz, and xy, xz, yz: the integrals of products of coordinates with a minus.
Mat3 inertia_in(const LuaArguments& a) {
  std::vector<double> given = a.numbers("inertia");
  if (given.size() != 3 && given.size() != 6)
    throw InputError(fmt::format("'inertia' has 3 moments xx, yy, zz, or 6 with xy, xz, yz, not {}", given.size()));
  given.resize(6, 0.0);
  Mat3 inertia;
  inertia << given[0], given[3], given[4], given[3], given[1], given[5], given[4], given[5], given[2];
  const Vec3 principal = principal_axes(inertia).values;
  constexpr double round_off = 1e-6;
  if (!(principal[0] > 0) || principal[2] > (1 + round_off) * (principal[0] + principal[1]))
    throw InputError(fmt::format(
        "'inertia' has the principal moments {:.4g}, {:.4g} and {:.4g} kg m^2, which no body has\n    all are above 0, "
        "and none is more than the sum of the two others",
        principal[0], principal[1], principal[2]));
  return inertia;
}

// Without moments of its own: a millionth of what its mass has at the nodes around.
Mat3 inertia_of_ball(double mass, const RigidBody& body) {
  constexpr double radius = 1e-3;  // of their distance
  double size = 0.0;
  for (const RigidBody::Side& side : body.sides) {
    const Vec3 middle = side.places.rowwise().mean();
    size = std::max(size, (side.places.colwise() - middle).colwise().norm().maxCoeff());
  }
  return mass * std::pow(radius * size, 2) * Mat3::Identity();
}

// Faces that were picked by geometry, or all, are called by their place in `on`, too: "face 2".
MeshPtr with_short_names(const MeshPtr& body, const std::vector<Face>& faces, bool all) {
  auto mesh = std::make_shared<Mesh>(*body);
  for (size_t i = 0; i < faces.size(); ++i) {
    const auto own = mesh->faces.find(faces[i].group), labelled = mesh->faces.find(faces[i].label());
    const auto it = own != mesh->faces.end() ? own : labelled;
    if ((!faces[i].picked && !all) || it == mesh->faces.end()) continue;
    const std::vector<Facet> facets = it->second;
    mesh->faces.emplace(fmt::format("face {}", i + 1), facets);
  }
  return mesh;
}

RigidBody::Side side_on(const Face& face, const std::string& name) {
  RigidBody::Side side{name, face.facets(), {}};
  const std::vector<int> nodes = nodes_of(side.facets);
  side.places.resize(3, static_cast<long>(nodes.size()));
  for (size_t i = 0; i < nodes.size(); ++i)
    side.places.col(static_cast<long>(i)) = face.part->mesh->nodes.col(nodes[i]) + face.part->place;
  for (Facet& facet : side.facets)
    for (int& node : facet.nodes())
      node = static_cast<int>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
  return side;
}

}  // namespace

Content build_rigid(const Declaration& d) {
  const LuaArguments& a = d.arguments;
  auto part = new_named<Substructure>(d);
  RigidBody body{a.number("mass"), Mat3::Zero(), a.vector("at"), {}};
  std::vector<Face> faces;
  for (const FaceOrRegion& place : a.places("on")) faces.push_back(std::get<Face>(place));
  double young = 0.0;
  for (const Face& face : faces) {
    const bool is_alone =
        std::count_if(faces.begin(), faces.end(), [&](const Face& other) { return other.group == face.group; }) == 1;
    if (face.facets().empty()) throw InputError(fmt::format("'on': '{}' has points and no facets", face.label()));
    body.sides.push_back(side_on(face, is_alone ? face.group : face.label()));
    young = std::max(young, face.part->material.young());
  }
  body.inertia = a.has("inertia") ? inertia_in(a) : inertia_of_ball(body.mass, body);
  part->mesh = with_short_names(rigid_body(body), faces, d.path == "mass.point");
  part->material = material_like(young, "rigid");
  part->velocity = a.vector("velocity");
  return SubstructurePtr(part);
}

}  // namespace dygita
