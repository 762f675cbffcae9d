#include <gtest/gtest.h>

#include "deck/fake_engine.hpp"

namespace dygita::test::units_tests {

namespace {

TEST(Units, are_numbers_in_SI) {
  EXPECT_EQ(message_of(R"(
    local function same(a, b) return math.abs(a / b - 1) < 1e-14 end
    assert(same(20*mm, 0.02) and same(1*um, 1e-6))
    assert(same(3*ms, 3e-3) and same(15*us, 15e-6))
    assert(same(2*kN, 2000))
    assert(same(1*kPa, 1e3) and same(640*MPa, 640e6) and same(210*GPa, 210e9))
    assert(same(10*Hz, 10) and same(10*kHz, 1e4))
    assert(same(g0, 9.80665) and same(180*deg, math.pi))
    assert(same(0.02 / mm, 20))
  )"),
            "");
}

TEST(Near, forgives_round_off_and_nothing_more) {
  EXPECT_EQ(message_of(R"(
    assert(near(0.1 + 0.2, 0.3))
    assert(near(0, 5e-9) and not near(0, 5e-8))        -- m: a CAD kernel's round-off, not a cell
    assert(near(1000, 1000.0005) and not near(1000, 1000.01))
    assert(not near(10*mm, 10.1*mm))
  )"),
            "");
}

}  // namespace

}  // namespace dygita::test::units_tests
