#include <gtest/gtest.h>

#include "mesh/expect_input_error.hpp"
#include "model/bolt_rating.hpp"

namespace dygita {
namespace {

// ISO 898-1, table 3 and 4, of coarse threads.
TEST(BoltRating, has_the_areas_of_the_standard) {
  for (const auto& [size, area] : std::vector<std::pair<std::string, double>>{{"M3", 5.03},
                                                                              {"M4", 8.78},
                                                                              {"M5", 14.2},
                                                                              {"M6", 20.1},
                                                                              {"M8", 36.6},
                                                                              {"M10", 58.0},
                                                                              {"M12", 84.3},
                                                                              {"M14", 115},
                                                                              {"M16", 157},
                                                                              {"M18", 192},
                                                                              {"M20", 245},
                                                                              {"M22", 303},
                                                                              {"M24", 353},
                                                                              {"M27", 459},
                                                                              {"M30", 561}})
    EXPECT_NEAR(1e6 * thread_of(size).stress_area(), area, 4e-3 * area) << size;
}

// ISO 898-1, table 5: N.
TEST(BoltRating, has_the_proof_loads_of_the_standard) {
  const auto proof = [](const std::string& size, const std::string& of) {
    const Thread thread = thread_of(size);
    return thread.stress_area() * proof_stress(of, thread);
  };
  for (const auto& [size, of, load] : std::vector<std::tuple<std::string, std::string, double>>{{"M8", "4.6", 8240},
                                                                                                {"M8", "8.8", 21200},
                                                                                                {"M10", "8.8", 33700},
                                                                                                {"M16", "8.8", 91000},
                                                                                                {"M20", "8.8", 147000},
                                                                                                {"M12", "10.9", 70000},
                                                                                                {"M24", "10.9", 293000},
                                                                                                {"M6", "12.9", 19500},
                                                                                                {"M30", "5.8", 213000},
                                                                                                {"M14", "6.8", 50600}})
    EXPECT_NEAR(proof(size, of), load, 4e-3 * load) << size << " " << of;
  EXPECT_NEAR(proof("M8", "A2-70"), 36.6 * 450, 50);
  EXPECT_THROW(proof("M20", "9.8"), InputError);
}

}  // namespace
}  // namespace dygita
