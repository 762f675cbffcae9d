// A measured face between its points.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "signal/scan.hpp"

namespace dygita {
namespace {

class Scanned {
 public:
  explicit Scanned(const std::string& text) {
    path_ = std::filesystem::temp_directory_path() / ("dygita_scan_" + std::to_string(getpid()) + ".csv");
    std::ofstream(path_) << text;
  }
  ~Scanned() { std::filesystem::remove(path_); }
  Scan read(double smooth = 0.0, std::optional<double> unit = {}, std::optional<double> height = {}) const {
    return Scan({path_.string(), unit, height, smooth});
  }
  void refuse(const std::string& words, std::optional<double> unit = {}, std::optional<double> height = {}) const {
    try {
      read(0.0, unit, height);
      FAIL() << words;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }

 private:
  std::filesystem::path path_;
};

// n x n points, a millimetre apart; heights in micrometres.
std::string grid(int n, const std::function<double(double, double)>& height, const std::string& title) {
  std::string text = title;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      text += std::to_string(i) + "; " + std::to_string(j) + "; " + std::to_string(height(i, j)) + "\n";
  return text;
}
const std::string title = "x [mm]; y [mm]; height [um]\n";

TEST(Scan, of_a_plane_is_that_plane_to_its_edges) {
  const Scanned file(grid(
      6, [](double x, double y) { return 2 * x - 3 * y + 5; }, title));
  const Scan scan = file.read();
  EXPECT_EQ(scan.n_points(), 36u);
  EXPECT_NEAR(scan.smooth(), 1e-3, 1e-12);
  for (const double x : {0.0, 1.3, 2.5, 5.0, 5.4})
    for (const double y : {0.0, 0.7, 4.99, 5.0})
      EXPECT_NEAR(*scan.at(1e-3 * x, 1e-3 * y), 1e-6 * (2 * x - 3 * y + 5), 1e-12);
  EXPECT_FALSE(scan.at(6.5e-3, 0.0));
  EXPECT_FALSE(scan.at(0.0, 1.0));
  EXPECT_FALSE(scan.at(NAN, 0.0));
}

// A crown: what smoothing adds is known, twice the curvature times the mean square of the distance.
TEST(Scan, smooths_over_the_length_that_is_asked_for) {
  const Scanned crown(grid(
      41, [](double x, double y) { return 0.5 * ((x - 20) * (x - 20) + (y - 20) * (y - 20)); }, title));
  for (const double smooth : {2e-3, 4e-3})
    EXPECT_NEAR(*crown.read(smooth).at(20e-3, 20e-3), 1e-6 * 0.5 * 1e6 * smooth * smooth,
                0.01e-6 * 1e6 * smooth * smooth);
  // Noise of +-1 from point to point goes.
  const Scanned rough(grid(
      41, [](double x, double y) { return 7 + (static_cast<int>(x + y) % 2 == 0 ? 1 : -1); }, title));
  EXPECT_NEAR(*rough.read(3e-3).at(20.3e-3, 19.6e-3), 7e-6, 1e-9);
}

TEST(Scan, units_are_of_titles_or_given) {
  const auto one = [](double, double) { return 1.0; };
  EXPECT_NEAR(*Scanned(grid(3, one, "")).read(0.0, 1e-3, 1e-6).at(1e-3, 1e-3), 1e-6, 1e-15);
  Scanned(grid(3, one, "")).refuse("column 1 has no unit");
  Scanned(grid(3, one, "")).refuse("column 3 has no unit", 1e-3);
  Scanned(grid(3, one, title)).refuse("the title of column 1 says 0.001 m, and 'unit' is 1 m", 1.0);
  Scanned(grid(3, one, "x [mm]; y [mm]; height [N]\n")).refuse("N");
}

TEST(Scan, refuses_what_is_no_face) {
  Scanned("").refuse("has no numbers");
  Scanned("1; 2\n3; 4\n").refuse("has 2 columns");
  Scanned(title + "0; 0; 1\n1; 1; 1\n2; 2; 1\n").refuse("four that span an area are needed");
  Scanned(title + "0; 0; 1\n1; 0; 1\n2; 0; 1\n3; 0; 1\n").refuse("four that span an area are needed");
  Scanned(title + "0; 0; 1\n1; x; 1\n").refuse("'1; x; 1' is not two places and a height");
}

TEST(Scan, refuses_two_heights_of_one_place_by_their_lines) {
  const std::string text = grid(
      4, [](double x, double y) { return x + y; }, title);
  Scanned(text + "2; 1; 3.5\n").refuse(":18: the height at (2, 1) mm is 3.5 um here and 3 um in line 11");
  EXPECT_EQ(Scanned(text + "2; 1; 3\n").read().n_points(), 17u);  // the same height twice
}

// Lines of the points that contradict what lies around them; `spoiled`: those that are 9 um higher.
std::vector<int> outliers(int n, const std::function<double(double, double)>& height,
                          const std::vector<std::pair<int, int>>& spoiled) {
  const Scan scan = Scanned(grid(
                                n,
                                [&](double x, double y) {
                                  double h = height(x, y);
                                  for (const auto& [i, j] : spoiled)
                                    if (x == i && y == j) h += 9.0;
                                  return h;
                                },
                                title))
                        .read();
  std::vector<int> lines;
  for (const ScanOutlier& outlier : outliers_of(scan.points())) lines.push_back(outlier.point->line);
  std::sort(lines.begin(), lines.end());
  return lines;
}

TEST(Scan, finds_heights_that_contradict_those_around_them) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 0.2);
  const auto rough = [&](double x, double y) { return 2 * x - 0.1 * y * y + noise(random); };
  const std::function<double(double, double)> faces[] = {
      [](double, double) { return 0.0; }, [](double x, double y) { return 3 * x - y; },
      [](double x, double y) { return 0.02 * (x * x + y * y); }, rough};
  constexpr int n = 20;
  const auto line = [](int i, int j) { return 2 + n * i + j; };
  for (size_t f = 0; f < std::size(faces); ++f) {
    SCOPED_TRACE(f);
    EXPECT_TRUE(outliers(n, faces[f], {}).empty());
    // In the middle, on an edge, in a corner, two side by side.
    const std::vector<std::pair<int, int>> places = {{9, 9}, {0, 7}, {19, 19}, {14, 3}, {14, 4}};
    EXPECT_EQ(outliers(n, faces[f], places),
              (std::vector<int>{line(0, 7), line(9, 9), line(14, 3), line(14, 4), line(19, 19)}));
  }
}

TEST(Scan, takes_steps_waves_and_digits_for_no_outliers) {
  const std::function<double(double, double)> faces[] = {
      [](double x, double y) { return x > 7 && x < 13 && y > 4 && y < 15 ? 20.0 : 0.0; },      // a pad, its corners
      [](double x, double y) { return x + 2 * y > 30 ? 5.0 : 0.0; },                           // an oblique step
      [](double x, double) { return x == 9 ? 4.0 : 0.0; },                                     // a rib
      [](double x, double y) { return std::round(0.3 * x) + std::round(0.7 * std::sin(y)); },  // few digits
      [](double x, double y) { return 3 * std::sin(0.8 * x) * std::cos(0.6 * y); },            // waves
      [](double x, double y) { return 9 * std::exp(-0.1 * (std::pow(x - 8, 2) + y * y)); },    // a bump
      [](double x, double y) { return std::fmod(7 * x + 5 * y, 3.0); }};                       // rough throughout
  for (size_t f = 0; f < std::size(faces); ++f) EXPECT_TRUE(outliers(20, faces[f], {}).empty()) << f;
}

}  // namespace
}  // namespace dygita
