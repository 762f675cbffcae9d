#include "model/bolt_rating.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "base/error.hpp"

namespace dygita {

namespace {

// Nominal diameter and pitch, mm: ISO 262, coarse.
const std::map<std::string, std::pair<double, double>> threads = {
    {"M3", {3, 0.5}},   {"M4", {4, 0.7}},    {"M5", {5, 0.8}}, {"M6", {6, 1}},   {"M8", {8, 1.25}},
    {"M10", {10, 1.5}}, {"M12", {12, 1.75}}, {"M14", {14, 2}}, {"M16", {16, 2}}, {"M18", {18, 2.5}},
    {"M20", {20, 2.5}}, {"M22", {22, 2.5}},  {"M24", {24, 3}}, {"M27", {27, 3}}, {"M30", {30, 3.5}}};

struct Class {
  double up_to_16, above;  // MPa; of bolts up to M16, and of larger ones
};

// Proof stress of ISO 898-1, table 3; stress at 0.2 % of ISO 3506-1, where bolts of stainless steel have no other.
const std::map<std::string, Class> classes = {
    {"4.6", {225, 225}},   {"4.8", {310, 310}},   {"5.6", {280, 280}},   {"5.8", {380, 380}},   {"6.8", {440, 440}},
    {"8.8", {580, 600}},   {"9.8", {650, 650}},   {"10.9", {830, 830}},  {"12.9", {970, 970}},  {"A2-50", {210, 210}},
    {"A2-70", {450, 450}}, {"A2-80", {600, 600}}, {"A4-50", {210, 210}}, {"A4-70", {450, 450}}, {"A4-80", {600, 600}}};

}  // namespace

double Thread::stress_area() const {
  const double stressed = diameter - 0.9382 * pitch;
  return 0.25 * std::numbers::pi * stressed * stressed;
}

Thread thread_of(const std::string& size) {
  const auto found = threads.find(size);
  CHECK(found != threads.end(), "a size of the table");
  return {1e-3 * found->second.first, 1e-3 * found->second.second};
}

double proof_stress(const std::string& property_class, const Thread& thread) {
  const auto found = classes.find(property_class);
  CHECK(found != classes.end(), "a class of the table");
  constexpr double largest_small = 16.5e-3;  // m
  if (property_class == "9.8" && thread.diameter > largest_small) throw InputError("class 9.8 is of bolts up to M16");
  return 1e6 * (thread.diameter < largest_small ? found->second.up_to_16 : found->second.above);
}

}  // namespace dygita
