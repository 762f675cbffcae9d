#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>

#include "base/log.hpp"
#include "deck/build_model.hpp"
#include "deck/deck_state.hpp"
#include "deck/integration.hpp"
#include "deck/orientation.hpp"
#include "intake/geo_script.hpp"
#include "intake/mesh_file.hpp"
#include "law/law.hpp"
#include "law/rough_contact.hpp"
#include "mesh/bolt.hpp"
#include "mesh/box.hpp"
#include "mesh/face_nodes.hpp"
#include "mesh/mesh_limits.hpp"
#include "model/extent.hpp"
#include "model/found_faces.hpp"
#include "model/point_faces.hpp"
#include "ranks/machine_copies.hpp"

namespace dygita {

namespace {

constexpr double bytes_per_cell = 100.0;  // of a box or a bolt: coordinates, connectivity, facets
constexpr double bytes_per_quadratic_cell = 400.0;
constexpr double locking_poisson = 0.45;
constexpr double default_share_of_size = 1e-4;  // of the assembly: how far apart named faces may be that touch

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

Damping damping_by_ratio(const LuaArguments& a) {
  if (!a.is_number("damping") || a.number("damping") != 0.0)
    throw InputError("'damping' and 'damping_ratio' are mutually exclusive: give one of them");
  if (!a.has("damping_frequency"))
    throw InputError(
        "'damping_ratio' requires the frequency at which it holds\n    damping_frequency = 1*kHz, or { 200*Hz, 2*kHz "
        "}");
  const std::vector<double> ratio = a.numbers("damping_ratio"), frequency = a.numbers("damping_frequency");
  if (ratio.size() > frequency.size())
    throw InputError("'damping_ratio' has two values and 'damping_frequency' one: give one frequency per ratio");
  if (frequency.size() == 1) return damping_of(ratio[0], frequency[0]);
  return damping_of({ratio.front(), ratio.back()}, {frequency[0], frequency[1]});
}

}  // namespace

Damping damping_in(const LuaArguments& a) {
  if (a.has("damping_ratio")) return damping_by_ratio(a);
  if (a.has("damping_frequency")) throw InputError("'damping_frequency' requires 'damping_ratio', which is missing");
  if (a.is_number("damping")) return {0.0, a.number("damping")};
  const auto damping = a.settings("damping");
  return {damping.at("mass"), damping.at("stiffness")};
}

namespace {

// Of the entry of a word, from all numbers of the declaration.
Content build_material(const Declaration& d) {
  const auto entry = std::find_if(material_table().begin(), material_table().end(),
                                  [&](const MaterialEntry& one) { return one.word == d.arguments.word(); });
  auto material = std::make_shared<Material>(Material{entry->make(d.arguments.plain_numbers()), {}});
  material->name = d.arguments.text("name");
  if (d.arguments.has("yield")) material->yield = d.arguments.number("yield");
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
  set_place(d.arguments.numbers("place"), *part);
  share_on_machine(part->mesh, part->mesh->arrays());
  part->velocity = d.arguments.vector("velocity");
  if (d.arguments.has("integration")) part->integration = integration_of(d.arguments.text("integration"));
  doubt_size(*part);
  doubt_locking(*part);
  return SubstructurePtr(part);
}

InterfaceSide side_of(const Object& object) {
  if (object.kind == "substructure") return {object.as<SubstructurePtr>(), {}};
  const Face& face = object.as<Face>();
  return {face.part, face};
}

const char* cure_of_gap(bool knows_gaps) {
  return knows_gaps ? "gap = \"geometry\" keeps the actual gap, closed = true confirms contact"
                    : "move them together by 'place' or 'origin'";
}

// Does the deck say what is to be taken for the gap?
bool has_gap_of_its_own(const Declaration& d) {
  return (d.arguments.has("gap") && (!d.arguments.is_number("gap") || d.arguments.number("gap") != 0.0)) ||
         (d.arguments.has("closed") && d.arguments.boolean("closed"));
}

// A gap of round surfaces is taken from them where the deck says none; others are told.
void settle_gap(const Declaration& d, const std::string& who_1, const std::string& who_2, const GapDoubt& doubt,
                Interface& interface) {
  const bool knows_gaps = d.arguments.has("gap");
  if (doubt.is_empty() || has_gap_of_its_own(d)) return;
  const bool is_kept = knows_gaps && doubt.is_known;
  if (!is_kept && doubt.is_slight) return;
  interface.has_gap_of_geometry = interface.is_gap_drawn = is_kept;
  warn(fmt::format("{}{} '{}': '{}' and '{}' {}; {}", d.origin.prefix(), d.path, interface.name, who_1, who_2,
                   is_kept ? doubt.kept() : doubt.neglected(),
                   is_kept ? "closed = true starts the interface closed" : cure_of_gap(knows_gaps)),
       kind_of(doubt, is_kept, interface.side_1.part->name, interface.side_2.part->name));
}

// Faces that are named meet where they are near, within a distance that the assembly gives: not less than their own.
// Round ones that are apart meet all around.
void set_named_faces(const Declaration& d, const Face& one, const Face& other, Interface& interface) {
  const bool is_given = interface.within.has_value();
  interface.side_1 = with_facets(one, other, interface.within);
  interface.side_2 = with_facets(other, one, interface.within);
  const double size = std::max(extent_of(*one.part).size().norm(), extent_of(*other.part).size().norm());
  const double within = interface.within.value_or(default_share_of_size * size);
  if (!is_given && d.arguments.has("gap") && !has_gap_of_its_own(d))
    if (const double apart = 2.0 * clearance_of_round(interface.side_1, interface.side_2); apart > within)
      interface.within = apart;
  const GapDoubt doubt = doubt_of_gap(interface.side_1, interface.side_2, interface.within.value_or(within));
  // Where 'within' is larger than what facets hide, the check of the whole problem tells it.
  if (!is_given || doubt.is_hidden || (doubt.is_known && d.arguments.has("gap")))
    settle_gap(d, one.label(), other.label(), doubt, interface);
}

// The faces, found where parts are given.
void set_sides(const Declaration& d, Interface& interface) {
  const std::vector<const Object*> sides = d.arguments.objects("between");
  const InterfaceSide one = side_of(*sides[0]), other = side_of(*sides[1]);
  if (one.face && other.face) {
    set_named_faces(d, *one.face, *other.face, interface);
    return;
  }
  for (const InterfaceSide* side : {&one, &other})
    if (!side->face && !side->part->mesh->has_cells() && side->part->mesh->faces.empty())
      throw InputError(fmt::format("superelement '{}' has points but no facets: name its face and the opposite face",
                                   side->part->name));
  for (const auto& [own, opposite] : {std::pair(&one, &other), std::pair(&other, &one)})
    if (own->face && is_of_points(*own->face))
      throw InputError(fmt::format("'{}' is given by points alone: give the face of '{}' that lies on them",
                                   own->label(), opposite->label()));
  const FoundFaces found = find_faces(one, other, interface.within);
  interface.side_1 = found.side_1;
  interface.side_2 = found.side_2;
  interface.within = found.touching.within;
  say(fmt::format("{} '{}': '{}' and '{}' touch on {}", d.path, interface.name, one.label(), other.label(),
                  describe(found.touching)));
  settle_gap(d, one.label(), other.label(), doubt_of_gap(interface.side_1, interface.side_2, found.touching.within),
             interface);
}

// Elastic constants of two faces against each other: 1/E* of both, and the tangential slope over the normal one of
// their asperities (Mindlin). Throws InputError where a part has not two constants; cure: what to give instead.
std::array<double, 2> contact_constants(const Interface& interface, const std::string& what, const std::string& cure) {
  double normal = 0.0, tangential = 0.0;
  for (const Face* face : {&interface.side_1, &interface.side_2}) {
    const Elastic& material = face->part->material;
    if (!face->part->mesh->has_cells() || !material.is_isotropic())
      throw InputError(fmt::format("'{}' needs Young's modulus and Poisson's ratio of '{}', which has none\n    {}",
                                   what, face->part->name, cure));
    const double poisson = *material.constant("poisson");
    normal += (1.0 - poisson * poisson) / material.young();
    tangential += (2.0 - poisson) / material.shear_modulus();
  }
  return {1.0 / normal, 4.0 * normal / tangential};
}

// What the law is given of `compliance`.
void add_compliance(const Declaration& d, const Interface& interface, std::map<std::string, double>& of_law) {
  std::map<std::string, double> given = d.arguments.settings("compliance");
  if (given.contains("asperities.radius")) {
    const double height = given["asperities.height"];
    const double modulus = contact_constants(interface, "compliance.asperities", "give compliance.normal")[0];
    of_law["coefficient"] =
        coefficient_of_asperities(given["asperities.radius"], given["asperities.density"], modulus, height);
    of_law["height"] = height;
  }
  for (const auto& [name, value] : given)
    if (!name.starts_with("asperities.")) of_law[name] = value;
  if (const auto friction = of_law.find("friction"); friction == of_law.end() || friction->second == 0.0) {
    if (given.contains("tangential"))
      throw InputError("'compliance.tangential' acts within the limit of 'friction', which is 0");
  } else if (!given.contains("tangential")) {
    of_law["ratio"] = contact_constants(interface, "compliance", "give compliance.tangential")[1];
  }
}

// The gap that a function of the deck adds at the nodes of both sides (m), and what it is like on the first.
void set_form(const Declaration& d, Interface& interface) {
  constexpr double most = 0.01;
  double least = 1e300, largest = -1e300, sum = 0.0, area = 0.0;
  for (const int side : {0, 1}) {
    const Face& face = side == 0 ? interface.side_1 : interface.side_2;
    const FaceNodes of_face = face_nodes(*face.part->mesh, face.facets());
    for (size_t i = 0; i < of_face.nodes.size(); ++i) {
      const Vec3 x = face.part->mesh->nodes.col(of_face.nodes[i]) + face.part->place;
      const double gap = d.arguments.number_at("gap", x);
      if (std::abs(gap) > most)
        throw InputError(
            d.origin, fmt::format("{} '{}': 'gap' is {:g} mm at ({:g}, {:g}, {:g}) m, and gaps are below {:g} mm\n    "
                                  "the function answers in m: was a unit forgotten?",
                                  d.path, interface.name, 1e3 * gap, x[0], x[1], x[2], 1e3 * most));
      interface.form[static_cast<size_t>(side)][of_face.nodes[i]] = gap;
      if (side == 1) continue;
      const double own = of_face.areas[static_cast<Eigen::Index>(i)];
      least = std::min(least, gap);
      largest = std::max(largest, gap);
      sum += own * gap;
      area += own;
    }
  }
  if (area > 0.0)
    say(fmt::format("{} '{}': 'gap' adds {:.4g} to {:.4g} um, {:.4g} um on average", d.path, interface.name,
                    1e6 * least, 1e6 * largest, 1e6 * sum / area));
}

// The law of a word, from all numbers and truth values of the declaration.
Content build_interface(const Declaration& d) {
  auto interface = new_named<Interface>(d);
  std::map<std::string, double> of_law = d.arguments.plain_numbers();
  if (of_law.erase("within") > 0) interface->within = d.arguments.number("within");
  try {
    set_sides(d, *interface);
  } catch (const InputError& error) {
    throw InputError(d.origin, fmt::format("{} '{}': {}", d.path, interface->name, error.what()));
  }
  if (interface->side_1.part == interface->side_2.part && interface->side_1.group == interface->side_2.group) {
    throw InputError(d.origin, fmt::format("{} '{}': 'between' has face '{}' twice", d.path, interface->name,
                                           interface->side_1.label()));
  }
  if (d.arguments.has("points"))
    interface->points = d.arguments.text("points") == "first" ? Carrier::first : Carrier::second;
  if (d.arguments.has("gap") && !d.arguments.is_number("gap")) {
    interface->has_gap_of_geometry = true;
    of_law["gap"] = 0.0;
    if (d.arguments.is_function("gap")) set_form(d, *interface);
  }
  of_law.erase("closed");
  if (d.arguments.has("closed") && d.arguments.boolean("closed") &&
      (interface->has_gap_of_geometry || d.arguments.number("gap") != 0.0))
    throw InputError(d.origin,
                     fmt::format("{} '{}': 'closed' and 'gap' contradict each other", d.path, interface->name));
  if (d.arguments.has("compliance")) add_compliance(d, *interface, of_law);
  const auto entry = std::find_if(law_table().begin(), law_table().end(),
                                  [&](const LawEntry& law) { return law.word == d.arguments.word(); });
  const bool rubs = std::find(entry->arguments.begin(), entry->arguments.end(), "friction") != entry->arguments.end();
  if (rubs && of_law.try_emplace("friction", 0.0).second) DeckState::of(d.lua).without_friction.emplace_back(interface);
  interface->law = make_law(d.arguments.word(), of_law);
  return InterfacePtr(interface);
}

Content build_support(const Declaration& d) {
  auto support = new_named<Support>(d);
  support->on = d.arguments.places("on");
  support->kind = make_support(d.arguments.word(), d.arguments.plain_numbers());
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
        {"substructure", build_substructure},
        {"substructure.rigid", build_rigid},
        {"substructure.superelement", build_superelement},
        {"param", build_parameters},
    };
    for (const MaterialEntry& kind : material_table()) all.emplace("material." + kind.word, build_material);
    for (const LawEntry& law : law_table()) all.emplace("interface." + law.word, build_interface);
    for (const SupportEntry& kind : support_table()) all.emplace("support." + kind.word, build_support);
    return all;
  }();
  return builders;
}

}  // namespace dygita
