// Meshes, materials, substructures and supports; the builders of all parts by their words.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/log.hpp"
#include "deck/build_model.hpp"
#include "deck/deck_state.hpp"
#include "deck/integration.hpp"
#include "deck/orientation.hpp"
#include "intake/geo_script.hpp"
#include "intake/mesh_file.hpp"
#include "law/law.hpp"
#include "mesh/bolt.hpp"
#include "mesh/box.hpp"
#include "mesh/layers.hpp"
#include "mesh/mesh_limits.hpp"
#include "model/extent.hpp"
#include "ranks/machine_copies.hpp"

namespace dygita {

namespace {

constexpr double bytes_per_cell = 100.0;  // of a box or a bolt: coordinates, connectivity, facets
constexpr double bytes_per_quadratic_cell = 400.0;
constexpr double locking_poisson = 0.45;

// The type by its name, else by the order.
CellType cell_of_box(const LuaArguments& a) {
  const int order = a.integer("order");
  if (!a.has("cell")) return order == 2 ? CellType::hex20 : CellType::hex8;
  const std::string name = a.text("cell");
  const CellShape& cell = *std::find_if(std::begin(cell_shapes), std::end(cell_shapes),
                                        [&](const CellShape& row) { return row.name == name; });
  const int own = nodes_per_cell(cell.type) > cell.n_corners ? 2 : 1;
  if (order > own) throw InputError(fmt::format("'order' = {}, but 'cell' = \"{}\" is of order {}", order, name, own));
  return cell.type;
}

Content build_box(const Declaration& d) {
  const auto cells = d.arguments.counts("cells");
  const auto bytes = static_cast<size_t>(bytes_per_cell * cells[0] * cells[1] * cells[2]);
  d.lua.reserve(fmt::format("mesh.box: {} x {} x {} cells", cells[0], cells[1], cells[2]), bytes);
  const MeshPtr mesh =
      box_mesh(d.arguments.vector("origin"), d.arguments.vector("size"), cells, cell_of_box(d.arguments));
  d.lua.hold_reserved(mesh, bytes);
  return mesh;
}

Content build_gmsh(const Declaration& d) {
  GmshOptions options;
  options.file = d.arguments.file("file");
  if (!is_trusted_mesh(options.file)) check_script(options.file);
  options.set = d.arguments.settings("set");
  if (d.arguments.has("size")) options.size = d.arguments.number("size");
  options.unit = d.arguments.number("unit");
  options.order = d.arguments.integer("order");
  options.is_complete = d.arguments.has("cell") && d.arguments.text("cell") == "hex27";
  if (options.order < 2 && d.arguments.has("cell"))
    throw InputError("'cell' selects among cells of order 2: add order = 2");
  const LuaState::Pause pause(d.lua);
  return std::make_shared<const GmshMeshes>(options);
}

Content build_step_mesh(const Declaration& d) {
  const LuaArguments& a = d.arguments;
  StepOptions options;
  options.file = a.file("file");
  options.order = a.integer("order");
  if (a.has("size")) options.size = a.number("size");
  options.sizes = a.settings("sizes");
  if (const auto all = options.sizes.find("default"); all != options.sizes.end()) {
    if (options.size) throw InputError("'size' and 'sizes.default' are mutually exclusive: give one of them");
    options.size = all->second;
    options.sizes.erase("default");
  }
  if (a.has("fine")) {
    if (a.is_number("fine")) {
      options.fine = StepOptions::Fine{a.number("fine")};
    } else {
      const auto fine = a.settings("fine");
      options.fine = StepOptions::Fine{fine.at("size"), fine.at("growth")};
    }
  }
  options.cells_a_turn = a.integer("round");
  if (a.has("unit")) {
    GmshOptions given;
    given.file = options.file;
    given.unit = options.unit = a.number("unit");
    check_options(given);
  }
  if (a.has("parts")) options.parts = a.texts("parts");
  const std::string cells = a.text("cells");
  if (cells != "tetrahedra")
    options.sweep = cells == "hexahedra" ? StepOptions::Sweep::all : StepOptions::Sweep::where_possible;
  const LuaState::Pause pause(d.lua);
  return std::make_shared<const StepAssembly>(options);
}

// A part of a bolt, as lua/bolts.lua asks for it.
Content build_bolt_mesh(const Declaration& d) {
  const LuaArguments& a = d.arguments;
  const int around = a.integer("around"), order = a.integer("order");
  const auto made = [&](const auto& shape, auto make) -> Content {
    const double cells = n_cells(shape), bytes = cells * (order == 2 ? bytes_per_quadratic_cell : bytes_per_cell);
    d.lua.reserve(fmt::format("bolt.hex: {:.3g} cells in a part", cells), static_cast<size_t>(std::min(bytes, 1e18)));
    const MeshPtr mesh = make(shape);
    d.lua.hold_reserved(mesh, static_cast<size_t>(bytes));
    return mesh;
  };
  if (a.has("inner"))
    return made(
        WasherShape{a.number("inner"), a.number("outer"), a.number("low"), a.number("thickness"), around, order},
        washer_mesh);
  return made(BoltEnd{a.number("diameter"), a.number("flats"), a.number("height"), a.number("shank"),
                      a.number("bearing"), a.boolean("above"), around, order},
              bolt_end_mesh);
}

Damping damping_over_band(const LuaArguments& a) {
  const std::vector<double> ratio = a.numbers("damping_ratio"), band = a.numbers("damping_band");
  if (a.has("damping_frequency"))
    throw InputError("'damping_band' and 'damping_frequency' are mutually exclusive: give one of them");
  if (ratio.size() > 1)
    throw InputError("'damping_ratio' over a 'damping_band' is one value for all frequencies of it");
  if (!(band[0] < band[1]))
    throw InputError(fmt::format("'damping_band' must go from a lower to a higher frequency, and is {:g} to {:g} Hz",
                                 band[0], band[1]));
  return damping_over(ratio[0], {band[0], band[1]});
}

Damping damping_by_ratio(const LuaArguments& a) {
  if (!a.is_number("damping") || a.number("damping") != 0.0)
    throw InputError("'damping' and 'damping_ratio' are mutually exclusive: give one of them");
  if (a.has("damping_band")) return damping_over_band(a);
  if (!a.has("damping_frequency"))
    throw InputError(
        "'damping_ratio' requires the frequency at which it holds\n    damping_frequency = 1*kHz, or { 200*Hz, 2*kHz "
        "}; or damping_band = { 100*Hz, 10*kHz }");
  const std::vector<double> ratio = a.numbers("damping_ratio"), frequency = a.numbers("damping_frequency");
  if (ratio.size() > frequency.size())
    throw InputError("'damping_ratio' has two values and 'damping_frequency' one: give one frequency per ratio");
  if (frequency.size() == 1) return damping_of(ratio[0], frequency[0]);
  return damping_of({ratio.front(), ratio.back()}, {frequency[0], frequency[1]});
}

}  // namespace

Damping damping_in(const LuaArguments& a) {
  if (a.has("damping_ratio")) return damping_by_ratio(a);
  for (const char* key : {"damping_frequency", "damping_band"})
    if (a.has(key)) throw InputError(fmt::format("'{}' requires 'damping_ratio', which is missing", key));
  if (a.is_number("damping")) return {0.0, a.number("damping")};
  const auto damping = a.settings("damping");
  return {damping.at("mass"), damping.at("stiffness")};
}

std::shared_ptr<const Strength> strength_in(const LuaArguments& a) {
  return std::make_shared<const Strength>(a.settings("strength"),
                                          a.text("criterion") == "hashin" ? Criterion::hashin : Criterion::tsai_wu);
}

namespace {

// Of the entry of a word, from all numbers of the declaration.
Content build_material(const Declaration& d) {
  const auto entry = std::find_if(material_table().begin(), material_table().end(),
                                  [&](const MaterialEntry& one) { return one.word == d.arguments.word(); });
  auto material = std::make_shared<Material>(Material{entry->make(d.arguments.plain_numbers()), {}});
  material->name = d.arguments.text("name");
  if (d.arguments.has("yield")) material->yield = d.arguments.number("yield");
  if (d.arguments.has("strength")) material->strength = strength_in(d.arguments);
  material->damping = damping_in(d.arguments);
  return std::shared_ptr<const Material>(material);
}

// What a ply bears; of von Mises' the equal of Tsai and Wu.
std::shared_ptr<const Strength> strength_of(const Material& material) {
  if (!material.yield) return material.strength;
  const double y = *material.yield, s = y / std::sqrt(3.0);
  return std::make_shared<const Strength>(
      std::map<std::string, double>{
          {"xt", y}, {"xc", y}, {"yt", y}, {"yc", y}, {"zt", y}, {"zc", y}, {"s12", s}, {"s13", s}, {"s23", s}},
      Criterion::tsai_wu);
}

void check_ply(const Material& material, int ply, bool has_strength) {
  const std::string its = fmt::format("'plies[{}]': material '{}'", ply, material.name);
  if (material.layup) throw InputError(its + " is a laminate itself\n    list its plies");
  if (!material.damping.is_none()) throw InputError(its + " has a damping of its own\n    give it to the laminate");
  if ((material.strength || material.yield) != has_strength)
    throw InputError(
        fmt::format("{} has {}strength, unlike that of the first ply\n    all plies have a 'strength' (or "
                    "'yield'), or none has",
                    its, has_strength ? "no " : "a "));
}

Content build_laminate(const Declaration& d) {
  std::vector<PlyOf> plies;
  bool has_strength = false;
  d.arguments.each("plies", [&](const LuaArguments& one) {
    const auto& material = *one.object("material").as<std::shared_ptr<const Material>>();
    if (plies.empty()) has_strength = material.strength || material.yield;
    check_ply(material, static_cast<int>(plies.size()) + 1, has_strength);
    plies.push_back({material, strength_of(material), one.number("thickness"), one.number("angle")});
  });
  auto material = std::make_shared<Material>(Material{laminate(plies), {}});
  material->name = d.arguments.text("name");
  material->damping = damping_in(d.arguments);
  return std::shared_ptr<const Material>(material);
}

void doubt_locking(const Substructure& part) {
  for (const CellBlock& block : part.mesh->blocks) {
    const std::string_view cells = cell_shape(block.type).locks_as;
    if (cells.empty()) continue;
    const double poisson = part.material.constant("poisson").value_or(0.0);
    if (poisson <= locking_poisson)
      warn(
          fmt::format("{}substructure '{}': {} are far too stiff in bending and give poor stresses; order = 2 in the "
                      "mesh makes them tet10",
                      part.origin.prefix(), part.name, cells));
    else
      warn(fmt::format("{}substructure '{}': {} with a Poisson's ratio of {:g} lock; hexahedra or prisms do not",
                       part.origin.prefix(), part.name, cells, poisson));
  }
}

Content build_substructure(const Declaration& d) {
  auto part = new_named<Substructure>(d);
  part->mesh = d.arguments.object("mesh").as<MeshPtr>();
  const auto& material = d.arguments.object("material").as<std::shared_ptr<const Material>>();
  part->material = *material;
  part->yield = material->yield;
  if (!material->is_isotropic())
    part->mesh = oriented(*part->mesh, d.arguments);
  else if (d.arguments.has("orientation"))
    throw InputError(
        fmt::format("'orientation' of a part of material '{}', which is the same in all directions\n    "
                    "material.orthotropic has axes",
                    material->name));
  if (material->layup) check_layers(*part->mesh, material->layup->thickness());
  set_place(d.arguments.numbers("place"), *part);
  share_on_machine(part->mesh, part->mesh->arrays());
  part->velocity = d.arguments.vector("velocity");
  if (d.arguments.has("integration")) part->integration = integration_of(d.arguments.text("integration"));
  doubt_size(*part);
  doubt_locking(*part);
  return SubstructurePtr(part);
}

// Of each place what it counts with: factors, of springs 1 and -1, or terms along axes.
void set_sum(const Declaration& d, Support& support) {
  const auto fail = [&](const std::string& why) {
    throw InputError(d.origin, fmt::format("{} '{}': {}", d.path, support.name, why));
  };
  const size_t n = support.on.size();
  if (support.kind->spring(0)) {
    if (n > 2) fail(fmt::format("'on' has {} places: a spring is between two, or one and the ground", n));
    support.factors = {1.0, -1.0};
    support.factors.resize(n);
    return;
  }
  const bool has_terms = d.arguments.has("terms");
  if (has_terms == d.arguments.has("factors"))
    fail("it takes 'factors' with x, y or z = true, or 'terms' along several axes, one of them");
  if (has_terms)
    d.arguments.each("terms", [&](const LuaArguments& term) {
      const Vec3 along = support.axes * Vec3(term.number("x"), term.number("y"), term.number("z"));
      support.factors.push_back(along.norm());
      support.terms.push_back(along.normalized());
    });
  else
    support.factors = d.arguments.numbers("factors");
  const char* const key = has_terms ? "terms" : "factors";
  if (support.factors.size() != n)
    fail(fmt::format("'on' has {} places and '{}' {} {}: one a place", n, key, support.factors.size(),
                     has_terms ? "of them" : "numbers"));
  for (size_t i = 0; i < n; ++i)
    if (support.factors[i] == 0.0) fail(fmt::format("'{}[{}]' is 0: leave its place out", key, i + 1));
}

Content build_support(const Declaration& d) {
  auto support = new_named<Support>(d);
  support->on = d.arguments.places("on");
  std::map<std::string, double> numbers = d.arguments.plain_numbers();
  if (d.arguments.has("terms") && numbers["x"] + numbers["y"] + numbers["z"] > 0.0)
    throw InputError(d.origin, fmt::format("{} '{}': 'terms' say along which axes; x, y and z go with 'factors'",
                                           d.path, support->name));
  if (d.arguments.has("terms")) numbers["x"] = 1.0;
  support->kind = make_support(d.arguments.word(), numbers);
  if (support->kind->sums() == Directions::none) return SupportPtr(support);
  if (d.arguments.has("axes")) {
    const std::vector<double> axes = d.arguments.numbers("axes");
    support->axes = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(axes.data());
  }
  set_sum(d, *support);
  return SupportPtr(support);
}

Content build_parameters(const Declaration&) { return std::monostate(); }

}  // namespace

const Builders& part_builders() {
  static const Builders builders = [] {
    Builders all = {
        {"mesh.box", build_box},
        {"mesh.gmsh", build_gmsh},
        {"bolt.mesh", build_bolt_mesh},
        {"mesh.step", build_step_mesh},
        {"mesh.abaqus", build_abaqus},
        {"mesh.nastran", build_nastran},
        {"mesh.unv", build_unv},
        {"material.laminate", build_laminate},
        {"substructure", build_substructure},
        {"substructure.rigid", build_rigid},
        {"mass.point", build_rigid},
        {"substructure.superelement", build_superelement},
        {"param", build_parameters},
    };
    for (const MaterialEntry& kind : material_table()) all.emplace("material." + kind.word, build_material);
    for (const LawEntry& law : law_table()) all.emplace("interface." + law.word, build_interface);
    all.emplace("interface.cyclic", build_cyclic);
    for (const SupportEntry& kind : support_table()) all.emplace("support." + kind.word, build_support);
    return all;
  }();
  return builders;
}

}  // namespace dygita
