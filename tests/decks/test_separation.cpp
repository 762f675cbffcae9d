// The rings of a launcher stage: one sector between planes of symmetry, and the whole ring of turned sectors.
#include <gtest/gtest.h>

#include <cmath>

#include "decks/deck_prints.hpp"

namespace dygita::test::separation_tests {
namespace {

TEST(SeparationRing, of_one_sector_is_tightened_shaken_and_loses_little_preload) {
  const PrintedRun sector = run_printing("separation_ring.lua", {{"sector", "1"}, {"size", "12*mm"}});
  EXPECT_TRUE(sector.runs.at(0).result->converged);
  EXPECT_NEAR(sector.number("last tightening, least"), 20.0, 1e-3);
  EXPECT_GT(sector.number("friction takes"), 0.0);
  const double above = sector.number("at 10 kHz above"), below = sector.number("; below");
  EXPECT_NEAR(sector.number("lost"), 20.0 * std::log10(above / below), 0.1);
  EXPECT_LT(sector.runs.at(0).figures().at("energy created by the scheme [%]"), 1e-4);
}

// All bolts at once and the charge lit everywhere: each sector of the ring is the one between planes of symmetry, but
// that the mesh of a sector is not quite its own mirror image. The sector whose cuts are tied by interface.cyclic has
// the ring's own mesh and bolts, and its answer, whatever the mass.
TEST(SeparationRing, that_is_loaded_evenly_moves_as_its_sector) {
  const Settings even = {
      {"bolts", "8"}, {"size", "15*mm"}, {"duration", "40*us"}, {"detonation", "1e9"}, {"together", "8"}};
  Settings one = even;
  one.emplace_back("sector", "1");
  const std::string lumped = "latin{ mass = 'lumped' }";
  const PrintedRun ring = run_printing("separation_ring.lua", even, lumped),
                   sector = run_printing("separation_ring.lua", one, lumped);
  EXPECT_TRUE(ring.runs.at(0).result->converged);
  EXPECT_NEAR(ring.number("joint opens by"), sector.number("joint opens by"), 0.02 * sector.number("joint opens by"));
  const auto peak = [](const PrintedRun& run, const char* output) {
    double largest = 0.0;
    for (const double a : run.runs.at(0).column(output, "acceleration")) largest = std::max(largest, std::abs(a));
    return largest;
  };
  for (const char* at : {" 0", " 90", " 180"}) {
    EXPECT_NEAR(peak(ring, (std::string("above") + at).c_str()), peak(sector, "above 0"),
                0.005 * peak(sector, "above 0"));
    EXPECT_NEAR(peak(ring, (std::string("below") + at).c_str()), peak(sector, "below 0"),
                0.005 * peak(sector, "below 0"));
  }
  one.back().second = "2";
  for (const std::string& mass : {lumped, std::string("latin{ mass = 'tuned' }")}) {
    SCOPED_TRACE(mass);
    const PrintedRun tied = run_printing("separation_ring.lua", one, mass),
                     whole = mass == lumped ? ring : run_printing("separation_ring.lua", even, mass);
    for (const char* number : {"joint opens by", "last tightening, least", "slips by"})
      EXPECT_NEAR(tied.number(number), whole.number(number), 1e-3 + 1e-5 * whole.number(number)) << number;
    for (const char* of : {"above 0", "below 0"}) EXPECT_NEAR(peak(tied, of), peak(whole, of), 1e-5 * peak(whole, of));
  }
}

}  // namespace
}  // namespace dygita::test::separation_tests
