// The table of laws: every duty of every law answered, and answered soundly.
#include <algorithm>
#include <cmath>
#include <ostream>
#include <set>

#include "base/error.hpp"
#include "law/law_arguments.hpp"
#include "law/law_checks.hpp"
#include "law/rough_contact.hpp"

namespace dygita {

void PrintTo(const LawEntry& entry, std::ostream* out) { *out << entry.word; }

namespace {

class EveryLaw : public ::testing::TestWithParam<LawEntry> {
 protected:
  LawPtr law = example_of(GetParam());
};

INSTANTIATE_TEST_SUITE_P(Table, EveryLaw, ::testing::ValuesIn(law_table()),
                         [](const auto& tested) { return tested.param.word; });

// Contact whose optional arguments are given.
const LawEntry rough_contacts[] = {
    {"contact", {"friction", "gap", "normal", "tangential"}, make_rough_contact},
    {"contact", {"friction", "gap", "coefficient", "height", "ratio"}, make_rough_contact},
    {"contact", {"friction", "gap", "approach[1]", "pressure[1]", "ratio"}, make_rough_contact},
};
INSTANTIATE_TEST_SUITE_P(Rough, EveryLaw, ::testing::ValuesIn(rough_contacts));

TEST_P(EveryLaw, has_the_word_and_the_parameters_of_its_entry) {
  EXPECT_EQ(law->word(), GetParam().word);
  std::set<std::string> names;
  for (const LawParameter& parameter : law->parameters()) {
    EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name;
    const double value = std::visit([](auto v) { return static_cast<double>(v); }, parameter.value);
    EXPECT_EQ(value, 1.0) << parameter.name << " is not what was given";
  }
  std::set<std::string> needed(GetParam().arguments.begin(), GetParam().arguments.end());
  std::erase_if(needed, is_optional);
  EXPECT_EQ(names, needed);
}

TEST_P(EveryLaw, says_its_parameters_with_their_numbers) {
  for (const LawRemark& remark : law->remarks()) {
    EXPECT_FALSE(remark.text.empty());
    if (!remark.unit.empty()) {
      EXPECT_NE(remark.text.find("{}"), std::string::npos) << remark.text;
    }
    EXPECT_TRUE(std::isfinite(remark.value));
  }
}

TEST_P(EveryLaw, declares_its_memory) {
  std::set<std::string> names;
  int n_scalars = 0, n_vectors = 0;
  for (const MemoryEntry& entry : law->memory()) {
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    EXPECT_FALSE(entry.name.empty() || entry.unit.empty());
    EXPECT_GT(entry.count, 0);
    (entry.kind == MemoryEntry::Kind::scalar ? n_scalars : n_vectors) += entry.count;
  }
  const LawState start = law->initial();
  EXPECT_EQ(start.memory.n_scalars(), n_scalars);
  EXPECT_EQ(start.memory.n_vectors(), n_vectors);
  const Trial t = trial({2e3, 1e3, -1e3});
  const LawState end = law->advance(t, dynamic_step, start, law->force(t, dynamic_step, start));
  EXPECT_EQ(end.memory.size(), start.memory.size());
}

TEST_P(EveryLaw, puts_no_force_where_it_does_not_act) {
  const Increment increment = dynamic_step;
  LawState start = law->initial();
  start.rate = {-1.0, 2.0, 0.5};
  Trial t = trial({-1.0, 2.0, 0.5});
  t.y.setZero();
  EXPECT_EQ(law->force(t, increment, start), Vec3(0, 0, 0));
  t = trial({-1.0, 2.0, 0.5});
  const Vec3 force = law->force(t, increment, start);
  for (int d = 0; d < 3; ++d)
    if (!law->acts_on(d, false)) {
      EXPECT_EQ(force[d], 0.0) << d;
    }
}

TEST_P(EveryLaw, obeys_the_search_problem_and_shows_its_force) {
  for (const Increment& increment : {dynamic_step, static_step}) {
    if (!law->takes_part(increment.is_static)) continue;
    const Trial t = trial({-1.0, 2.0, 0.5});
    const LawState start = law->initial();
    const Vec3 force = law->force(t, increment, start);
    const LawState end = law->advance(t, increment, start, force);
    EXPECT_EQ(end.force, force);
    EXPECT_LT((end.rate - (t.s - t.y.cwiseProduct(force))).norm(), 1e-15);
  }
}

TEST_P(EveryLaw, dissipates_and_never_creates) {
  LawState state = law->initial();
  double stored = 0.0;
  for (int i = 0; i < 200; ++i) {
    const Trial t = trial(2e3 * Vec3(std::sin(0.7 * i), std::cos(1.3 * i), std::sin(2.1 * i)), {1e-2, 1e-2, 1e-2});
    const LawState end = law->advance(t, dynamic_step, state, law->force(t, dynamic_step, state));
    const Work work = law->work(state, end, dynamic_step, t.area);
    EXPECT_GE(work.plastic, 0.0);
    EXPECT_GE(work.damping, 0.0);
    EXPECT_EQ(work.given, 0.0);
    stored += work.stored;
    EXPECT_GE(stored, -1e-12);
    state = end;
  }
  // What a release gives back is all that was stored.
  LawState gone = state;
  gone.force.setZero();
  gone.status = PointState::open;
  law->let_go(gone);
  EXPECT_NEAR(law->work(state, gone, dynamic_step, 1e-4).stored, -stored, 1e-9 * stored);
}

TEST_P(EveryLaw, has_an_explicit_form_or_says_why_not) {
  const ExplicitForm form = law->explicit_form();
  EXPECT_EQ(form.is_none(), !form.refusal.empty());
  if (form.springs) {
    EXPECT_GT(form.springs->stiffness(1e-4, 1e8, 0.1).minCoeff(), 0.0);
    SpringPoint point = spring_point(*law, law->initial(), 1e-4, 1e8);
    move_to(*law, {-2.0, 0, 0}, point);  // further than the example's gap
    EXPECT_LT(point.now.force[0], 0.0);
  }
}

TEST_P(EveryLaw, holds_for_small_motions_only_where_it_acts) {
  for (const PointState status : {PointState::open, PointState::stick, PointState::slip}) {
    LawState state = law->initial();
    state.status = status;
    const Tangent tangent = law->tangent(state, true);
    for (int d = 0; d < 3; ++d) {
      EXPECT_GE(tangent.damping[d], 0.0);
      EXPECT_GE(tangent.stiffness[d], 0.0);
      EXPECT_FALSE(tangent.holds[d] && (tangent.damping[d] > 0.0 || tangent.stiffness[d] > 0.0));
      if (tangent.holds[d] || tangent.stiffness[d] > 0.0) {
        EXPECT_TRUE(law->acts_on(d, true));
      }
    }
  }
}

TEST_P(EveryLaw, that_joins_groups_or_is_tightened_holds_all_directions) {
  for (int d = 0; d < 3; ++d) {
    if (law->is_tie()) {
      EXPECT_TRUE(law->acts_on(d, true) && law->tangent(law->initial(), false).holds[d]);
    }
    if (law->can_be_tightened()) {
      EXPECT_TRUE(law->acts_on(d, true));
    }
  }
  if (law->can_be_tightened()) {
    EXPECT_GT(law->tension_limit().traction, 0.0);
  }
}

TEST(LawTable, has_one_entry_a_word_and_knows_the_first_laws) {
  std::set<std::string> words;
  for (const LawEntry& entry : law_table()) EXPECT_TRUE(words.insert(entry.word).second) << entry.word;
  for (const char* word : {"bonded", "contact", "plastic"}) EXPECT_TRUE(words.contains(word)) << word;
}

TEST(LawTable, makes_a_law_only_of_the_arguments_it_takes) {
  EXPECT_THROW(make_law("glue"), ContractError);
  EXPECT_THROW(make_law("contact", {{"friction", 0.1}}), ContractError);
  EXPECT_THROW(make_law("bonded", {{"friction", 0.1}}), ContractError);
}

// A point of one frame stands for surface points of another: what goes in comes out.
TEST(LawStates, are_turned_and_shared) {
  Mat3 frame;
  frame << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  LawState member;
  member.gap = 1e-6;
  member.slip = {1e-6, 2e-6, 3e-6};
  member.force = {1, 2, 3};
  member.status = PointState::slip;
  member.memory = LawMemory({{"number", "m"}, {"vectors", "Pa", MemoryEntry::Kind::vector, 2}});
  member.memory.scalar(0) = 5.0;
  member.memory.vector(1) = Vec3(1, 2, 3);
  LawState point;
  point.add(member, 0.25, frame);
  point.add(member, 0.75, frame);
  EXPECT_DOUBLE_EQ(point.gap, 1e-6);
  EXPECT_EQ(point.force, Vec3(6, 2, 4));          // both members', along N, T1, T2
  EXPECT_DOUBLE_EQ(point.memory.scalar(0), 5.0);  // means, not sums
  EXPECT_EQ(point.memory.vector(1), Vec3(3, 1, 2));
  EXPECT_EQ(point.memory.vector(0), Vec3(0, 0, 0));
  const LawState back = point.member(0.5, frame);
  EXPECT_EQ(back.memory.scalar(0), 5.0);
  EXPECT_EQ(back.memory.vector(1), Vec3(1, 2, 3));
  EXPECT_THROW(point.memory.scalar(1), ContractError);
  EXPECT_THROW(point.memory.vector(2), ContractError);
  EXPECT_LT((back.slip - member.slip).norm(), 1e-20);
  EXPECT_EQ(back.force, member.force);
  EXPECT_EQ(back.status, PointState::slip);
}

}  // namespace
}  // namespace dygita
