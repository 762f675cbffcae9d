#include "foreign/nastran_model.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <set>

#include "base/error.hpp"
#include "base/names.hpp"
#include "foreign/abaqus_cells.hpp"
#include "foreign/cards.hpp"

namespace dygita {

namespace {

constexpr int first_node = 3;  // field of a cell's first node

// Which of the file's nodes each of the type is. The prism's first triangle turns the other way here
// (mesh/cell_shape.hpp), and the file has the middles of upright edges before those of the upper ones.
struct NastranCell {
  const char* name;
  CellType linear, quadratic;
  std::vector<int> corners, order;
};

const std::vector<NastranCell>& nastran_cells() {
  static const std::vector<NastranCell> cells = {
      {"CTETRA", CellType::tet4, CellType::tet10, {0, 1, 2, 3}, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}},
      {"CPENTA",
       CellType::prism6,
       CellType::prism15,
       {0, 2, 1, 3, 5, 4},
       {0, 2, 1, 3, 5, 4, 8, 7, 6, 14, 13, 12, 9, 11, 10}},
      {"CHEXA", CellType::hex8, CellType::hex20, {0, 1, 2, 3, 4, 5, 6, 7}, {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,
                                                                            10, 11, 16, 17, 18, 19, 12, 13, 14, 15}}};
  return cells;
}

const NastranCell* nastran_cell(std::string_view name) {
  for (const NastranCell& cell : nastran_cells())
    if (name == cell.name) return &cell;
  return nullptr;
}

constexpr const char* cell_names = "CTETRA, CPENTA, CHEXA";

// Elements between points, and what joins motions of nodes: no cells.
bool is_left_out_always(std::string_view name) {
  static const std::set<std::string_view> joints = {"RBE1",   "RBE2", "RBE3",  "RBAR",  "RBAR1", "RROD", "RSPLINE",
                                                    "PLOTEL", "CGAP", "CVISC", "CWELD", "CFAST", "CSEAM"};
  for (const char* beginning : {"CBUSH", "CELAS", "CDAMP", "CMASS", "CONM"})
    if (name.starts_with(beginning)) return true;
  return joints.contains(name);
}

bool is_structural(std::string_view name) {
  for (const char* beginning : {"CQUAD", "CTRI", "CSHEAR", "CBAR", "CBEAM", "CBEND", "CROD", "CONROD", "CTUBE",
                                "CPYRAM", "CSHELL", "CRAC", "CIHEX", "CHEX", "CTET", "CPEN", "CPLST"})
    if (name.starts_with(beginning)) return true;
  return false;
}

bool is_read(std::string_view name) {
  static const std::set<std::string_view> used = {"GRID",  "GRDSET", "PSOLID", "MAT1", "MAT9",
                                                  "MAT11", "SET",    "SET1",   "SET3"};
  return used.contains(name) || nastran_cell(name) || name.starts_with("CORD1") || name.starts_with("CORD2");
}

}  // namespace

NastranModel::NastranModel(const NastranOptions& options)
    : options_(options), file_(options.file), names_(nastran_names(file_)), places_(file_) {
  model_.file = options.file;
  model_.files = file_.files();
  model_.elasticity = "MAT1, MAT9 or MAT11";
  model_.density = "RHO";
  for (std::string& type : options_.skip) type = in_capitals(type);
  for (const NastranGrid& grid : places_.grids()) model_.nodes.push_back(options_.unit * grid.x);
  read_control();
  read_parameters();
  read_properties();
  read_cells();
  read_sets();
  list_unused();
}

void NastranModel::read_control() {
  bool goes_on = false;
  for (const BulkLine& line : file_.control()) {
    const std::string_view said = without_blanks_around(line.text.substr(0, line.text.find('$')));
    if (said.empty()) continue;
    if (goes_on)
      control_.back().text += in_capitals(said);
    else
      control_.push_back({in_capitals(said), file_.where(line.file, line.line)});
    goes_on = control_.back().text.starts_with("SET") && control_.back().text.back() == ',';
  }
}

void NastranModel::read_parameters() {
  for (const BulkCard& card : file_.cards()) {
    const BulkFields fields(file_, card);
    if (card.name != "PARAM" || fields.word(1) != "WTMASS") continue;
    mass_factor_ = fields.real(2, "a factor of masses");
    if (!(mass_factor_ > 0)) fields.fail("WTMASS: a factor above 0 is expected");
    if (mass_factor_ != 1.0)
      model_.told.push_back(
          fmt::format("{}: densities and masses are multiplied by WTMASS = {:g}", file_.where(card), mass_factor_));
  }
}

void NastranModel::read_properties() {
  for (NastranMaterial& one : nastran_materials(file_, names_, mass_factor_, model_.told)) {
    material_names_[one.number] = one.material.name;
    model_.materials.push_back(std::move(one.material));
  }
  std::vector<std::string> taken;
  for (const BulkCard& card : file_.cards()) {
    if (card.name != "PSOLID") continue;
    const BulkFields fields(file_, card);
    const long number = fields.whole(1, "the number of a property");
    const long material = fields.whole_or(2, 0, "the number of a material");
    const long axes = fields.whole_or(3, 0, "a coordinate system");
    if (!groups_.emplace(number, static_cast<int>(model_.groups.size())).second)
      fields.fail(fmt::format("there is a property {} already", number));
    const auto found = material_names_.find(material);
    model_.groups.push_back({unique_name(names_.properties, number, "PSOLID", taken),
                             found == material_names_.end() ? "" : found->second, axes == 0 ? "" : std::to_string(axes),
                             ""});
    if (found == material_names_.end())
      model_.told.push_back(fmt::format("{}: there is no MAT1, MAT9 or MAT11 {}", file_.where(card), material));
  }
}

int NastranModel::group_of(long property) {
  const auto [found, is_new] = groups_.try_emplace(property, static_cast<int>(model_.groups.size()));
  if (is_new) {
    const auto name = names_.properties.find(property);
    model_.groups.push_back(
        {name == names_.properties.end() ? fmt::format("property {}", property) : name->second, "", "", ""});
    model_.told.push_back(fmt::format("the cells of property {} have no PSOLID, so no material", property));
  }
  return found->second;
}

bool NastranModel::is_skipped(std::string_view type) const {
  return std::find(options_.skip.begin(), options_.skip.end(), type) != options_.skip.end();
}

void NastranModel::read_cells() {
  for (const BulkCard& card : file_.cards()) {
    if (nastran_cell(card.name) && !is_skipped(card.name)) {
      add_cell(card);
    } else if (is_left_out_always(card.name)) {
      leave_out(card);
    } else if (nastran_cell(card.name) || is_structural(card.name)) {
      if (!is_skipped(card.name))
        file_.fail(card, fmt::format("elements of this type are no cells here: {} are\n"
                                     "    skip = {{ \"{}\" }} leaves them out",
                                     cell_names, printable(std::string(card.name))));
      leave_out(card);
    }
  }
  std::string left_out;
  for (const auto& [type, n] : n_left_out_) left_out += fmt::format(" {} of type {} are left out.", n, type);
  if (model_.cells.empty())
    throw InputError(
        fmt::format("mesh file '{}' has no element that is a cell here ({}).{}", file_.file(), cell_names, left_out));
  tell_left_out();
}

void NastranModel::leave_out(const BulkCard& card) {
  if (is_whole(file_.field(card, 1))) cells_.emplace(BulkFields(file_, card).whole(1, "a number"), -1);
  ++n_left_out_[std::string(card.name)];
}

void NastranModel::tell_left_out() {
  for (const auto& [type, n] : n_left_out_)
    model_.told.push_back(fmt::format("{} elements of type {} are no cells here and are left out", n, type));
  const auto n_linear = std::count_if(model_.cells.begin(), model_.cells.end(),
                                      [](const ForeignCell& cell) { return cell.type == CellType::hex8; });
  if (n_linear > 0)
    model_.told.push_back(fmt::format(
        "{} CHEXA of 8 nodes: with incompatible modes; Nastran's, with reduced shear, bend alike and are not the same",
        n_linear));
}

void NastranModel::add_cell(const BulkCard& card) {
  const BulkFields fields(file_, card);
  const NastranCell& type = *nastran_cell(card.name);
  const long number = fields.whole(1, "the number of an element");
  const auto n_all = static_cast<int>(type.order.size()), n_corners = static_cast<int>(type.corners.size());
  const int n_given = fields.size() - first_node + 1;
  if (n_given > n_all) fields.fail(fmt::format("element {} has more than {} nodes", number, n_all));
  int n_middles = 0;
  for (int a = n_corners; a < n_given; ++a) n_middles += fields.whole_or(first_node + a, 0, "a node") != 0;
  if (n_middles != 0 && n_middles != n_all - n_corners)
    fields.fail(fmt::format("element {} has {} of its {} nodes between corners: it is read with all or none", number,
                            n_middles, n_all - n_corners));
  const bool is_quadratic = n_middles > 0;
  if (!cells_.emplace(number, static_cast<int>(model_.cells.size())).second)
    fields.fail(fmt::format("element {} is given twice", number));
  ForeignCell cell{is_quadratic ? type.quadratic : type.linear,
                   static_cast<int>(model_.connectivity.size()),
                   -1,
                   card.file,
                   card.line,
                   number};
  cell.group = group_of(fields.whole_or(2, number, "the number of a property"));
  for (const int a : is_quadratic ? type.order : type.corners) {
    const long given = fields.whole(first_node + a, "the number of a node");
    const int node = places_.index_of(given);
    if (node < 0) fields.fail(fmt::format("element {} has node {}, which the file does not give", number, given));
    model_.connectivity.push_back(node);
  }
  model_.cells.push_back(cell);
}

int NastranModel::node(long number, const BulkFields& asked) const {
  const int index = places_.index_of(number);
  if (index < 0) asked.fail(fmt::format("there is no node {}", number));
  return index;
}

int NastranModel::cell(long number, const BulkFields& asked) const {
  const auto found = cells_.find(number);
  if (found == cells_.end()) asked.fail(fmt::format("there is no element {}", number));
  return found->second;
}

ForeignFacet NastranModel::facet(int cell, long g1, long g34, const BulkFields& asked) const {
  const ForeignCell& of = model_.cells[static_cast<size_t>(cell)];
  const int* nodes = model_.nodes_of(of);
  const int one = node(g1, asked), other = g34 == 0 ? -1 : node(g34, asked);
  const bool is_tetrahedron = of.type == CellType::tet4 || of.type == CellType::tet10;
  std::vector<ForeignFacet> fitting;
  for (const auto& corners : abaqus_cell_of(of.type).faces) {
    ForeignFacet facet{cell, {-1, -1, -1, -1}};
    for (size_t a = 0; a < corners.size(); ++a) facet.corners[a] = nodes[corners[a]];
    const auto at = [&](int n) {
      return std::find(facet.corners.begin(), facet.corners.end(), n) - facet.corners.begin();
    };
    const auto n = static_cast<long>(corners.size());
    if (at(one) >= n) continue;
    const bool fits = is_tetrahedron ? other >= 0 && at(other) >= n
                      : other < 0    ? n == 3
                                     : n == 4 && at(other) < n && std::abs(at(one) - at(other)) == 2;
    if (fits) fitting.push_back(facet);
  }
  if (fitting.size() != 1 || (is_tetrahedron && std::find(nodes, nodes + 4, other) == nodes + 4))
    asked.fail(fmt::format("nodes {} and {} are no face of element {}", g1, g34, of.number));
  return fitting[0];
}

void NastranModel::list_unused() {
  std::map<std::string_view, std::vector<std::string>> others;
  for (const BulkCard& card : file_.cards()) {
    const bool is_mass_factor = card.name == "PARAM" && BulkFields(file_, card).word(1) == "WTMASS";
    if (!is_read(card.name) && !is_mass_factor) others[card.name].push_back(file_.where(card));
  }
  for (const auto& [name, places] : others)
    model_.unused.push_back(fmt::format("{}: {}", printable(std::string(name)), few_of(places)));
}

}  // namespace dygita
