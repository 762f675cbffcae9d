// Ties: the jump is held, by forces or by springs.
#include "law/law_checks.hpp"

namespace dygita {
namespace {

TEST(Bonded, brings_the_jump_to_the_shortening) {
  const LawPtr law = make_law("bonded");
  Trial t = trial({0.2, 0.1, -0.1});
  t.jump = {1e-6, 2e-6, 3e-6};
  t.shortening = 5e-6;
  const Vec3 f = law->force(t, static_step, {});
  const Vec3 rate = law->advance(t, static_step, {}, f).rate;
  EXPECT_NEAR((t.jump + rate - Vec3(-5e-6, 0, 0)).norm(), 0.0, 1e-15);
}

TEST(Bonded, has_the_slope_of_the_search_directions) {
  const LawPtr law = make_law("bonded");
  const Mat3 found = slope(*law, trial({0.2, 0.1, -0.1}, {1e-3, 2e-3, 4e-3}), dynamic_step, {}, 1e-6);
  EXPECT_LT((found - Vec3(1e3, 500, 250).asDiagonal().toDenseMatrix()).norm(), 1e-6);
  EXPECT_EQ(law->tangent({}, false).holds, (std::array{true, true, true}));
}

TEST(Bonded, its_springs_come_to_the_held_jump) {
  const LawPtr law = make_law("bonded");
  for (const double k : {1e6, 1e9}) {
    SpringPoint point = spring_point(*law, {}, 1e-4, k);
    move_to(*law, {100.0 / k, 0, -50.0 / k}, point);
    EXPECT_NEAR((point.now.force - Vec3(100, 0, -50)).norm(), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace dygita
