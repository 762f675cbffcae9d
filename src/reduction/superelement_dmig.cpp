// A superelement for Nastran.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <tuple>

#include "base/log.hpp"
#include "base/names.hpp"
#include "model/places.hpp"
#include "reduction/superelement_files.hpp"

namespace dygita {

namespace {

// Beyond what models usually number.
constexpr long first_grid = 9000001;

// A row's grid point and component, 1 to 6; 0 of a mode, which is a scalar point.
struct GridRow {
  long grid;
  int component;
};

class GridNumbers {
 public:
  explicit GridNumbers(const Superelement& element) : element_(element) {
    for (const Superelement::Row& row : element.rows)
      if (row.on >= 0) {
        const auto [it, is_new] = numbers_.try_emplace(key(row), first_grid + static_cast<long>(places_.size()));
        if (is_new) {
          places_.push_back(row.place);
          components_.emplace_back();
        }
        components_[static_cast<size_t>(it->second - first_grid)] += static_cast<char>('1' + row.direction);
        rows_.push_back({it->second, row.direction + 1});
      }
    long next = first_grid + static_cast<long>(places_.size());
    for (const Superelement::Row& row : element.rows)
      if (row.on < 0) rows_.push_back({next++, 0});
    n_modes_ = next - first_grid - static_cast<long>(places_.size());
  }
  const std::vector<GridRow>& rows() const { return rows_; }
  const std::vector<Vec3>& places() const { return places_; }
  // "456": components of a grid point that have no row.
  std::string held(size_t grid) const {
    std::string without;
    for (const char c : std::string("123456"))
      if (components_[grid].find(c) == std::string::npos) without += c;
    return without;
  }
  long n_modes() const { return n_modes_; }
  // 0: all rows of that node are those of others.
  long at(int on, int node) const {
    const auto found = numbers_.find(key({on, node, 0, Vec3::Zero()}));
    return found == numbers_.end() ? 0 : found->second;
  }

 private:
  using Key = std::tuple<const Substructure*, int, int>;
  Key key(const Superelement::Row& row) const {
    const FaceOrRegion place = *place_of(element_.on[static_cast<size_t>(row.on)]);
    return {&part_of(place), row.node < 0 ? row.on : -1, row.node};
  }

  const Superelement& element_;
  std::map<Key, long> numbers_;
  std::vector<Vec3> places_;
  std::vector<std::string> components_;
  std::vector<GridRow> rows_;
  long n_modes_ = 0;
};

std::string real_field(double x) { return fmt::format("{:>16}", fmt::format("{:.9E}", x)); }

// Double precision has a D.
std::string entry_field(double x) {
  std::string field = real_field(x);
  std::replace(field.begin(), field.end(), 'E', 'D');
  return field;
}

std::string grid_cards(const GridNumbers& grids) {
  std::string text;
  for (size_t i = 0; i < grids.places().size(); ++i) {
    const Vec3& x = grids.places()[i];
    text += fmt::format("GRID*   {:16}{:16}{}{}\n*       {}{:16}{:>16}\n", first_grid + static_cast<long>(i), "",
                        real_field(x[0]), real_field(x[1]), real_field(x[2]), "", grids.held(i));
  }
  const long first = first_grid + static_cast<long>(grids.places().size()), n = grids.n_modes();
  if (n == 1) text += fmt::format("SPOINT  {:8}\n", first);
  if (n > 1) text += fmt::format("SPOINT  {:8}    THRU{:8}\n", first, first + n - 1);
  return text;
}

// The lower triangle by columns.
std::string dmig_cards(const char* name, const Mat& matrix, const std::vector<GridRow>& rows) {
  constexpr double nothing = 1e-90;  // whose exponent has three digits
  std::string text = fmt::format("DMIG    {:8}{:8}{:8}{:8}{:8}\n", name, 0, 6, 2, 0);
  auto out = std::back_inserter(text);
  for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
    bool is_first = true;
    for (Eigen::Index i = j; i < matrix.rows(); ++i) {
      if (std::abs(matrix(i, j)) < nothing) continue;
      const GridRow &row = rows[static_cast<size_t>(i)], &column = rows[static_cast<size_t>(j)];
      if (is_first) fmt::format_to(out, "DMIG*   {:16}{:16}{:16}\n", name, column.grid, column.component);
      fmt::format_to(out, "*       {:16}{:16}{}\n", row.grid, row.component, entry_field(matrix(i, j)));
      is_first = false;
    }
  }
  return text;
}

std::string point_table(const Superelement& element, const GridNumbers& grids) {
  std::string text = "face, node, x, y, z\n";
  const std::vector<std::string> names = face_names(element.on);
  for (size_t f = 0; f < element.on.size(); ++f) {
    const int on = static_cast<int>(f);
    const auto add = [&](int node) {
      const long grid = grids.at(on, node);
      if (grid == 0) return;
      const Vec3& x = grids.places()[static_cast<size_t>(grid - first_grid)];
      text += fmt::format("{}, {}, {:.17g}, {:.17g}, {:.17g}\n", names[f], grid, x[0], x[1], x[2]);
    };
    add(-1);
    for (const int node : nodes_at(*place_of(element.on[f]))) add(node);
  }
  return text;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> dmig_files(const SuperelementRequest& request,
                                                            const Superelement& element) {
  const GridNumbers grids(element);
  const bool damps = element.damping.size() > 0;
  std::string text = fmt::format(
      "$ superelement '{}' about the end of step '{}': rows are described in {}.md\n$ SI: m, kg, s, N. K2GG = KAAX, "
      "M2GG = MAAX{}; valid up to {:.6g} Hz\n",
      request.name, element.step, file_name_of(request.name), damps ? ", B2GG = BAAX" : "", element.valid_to);
  if (element.missed > 0) text += "$ " + unconverged_text(element) + "\n";
  text += grid_cards(grids) + dmig_cards("KAAX", element.stiffness, grids.rows()) +
          dmig_cards("MAAX", element.mass, grids.rows());
  if (damps) text += dmig_cards("BAAX", element.damping, grids.rows());
  return {{".pch", text}, {"_points.csv", point_table(element, grids)}};
}

}  // namespace dygita
