// What each load asks of the solvers.
#include <gtest/gtest.h>

#include <set>

#include "model/assembly.hpp"
#include "model/mode_forces.hpp"
#include "model/output_double.hpp"

namespace dygita {

namespace {

// What load.mode is given in place of a run's modes.
class ModesOfNothing final : public OutputDouble, public ModeShapes {
 public:
  using OutputDouble::OutputDouble;
  Points shape(const Substructure& part, int) const override { return Points::Zero(3, part.mesh->n_nodes()); }
  Points mass_times_shape(const Substructure& part, int number) const override { return shape(part, number); }
  double generalised_mass(int) const override { return 1.0; }
  double frequency(int) const override { return 0.0; }
  double damping_ratio(int) const override { return 0.0; }
};

class LoadEffects : public Assembly {
 protected:
  const Face top{upper, "zmax"}, side{upper, "xmax"};

  template <class Kind>
  std::vector<Kind> effects(const LoadPtr& load) {
    std::vector<Kind> all;
    for (const Effect& effect : load->effects()) all.push_back(std::get<Kind>(effect));
    return all;
  }
};

TEST_F(LoadEffects, of_forces_are_one_for_each_value_and_place) {
  EXPECT_EQ(effects<NodalForces>(load("pressure", {top, side})).size(), 2U);
  const auto traction = effects<NodalForces>(load("traction", {top, side}, {{"x", 1.0}, {"z", 2.0}}));
  ASSERT_EQ(traction.size(), 4U);
  EXPECT_EQ(traction[0].name, "load.traction x");
  EXPECT_EQ(traction[3].name, "load.traction z");
  EXPECT_EQ(std::get<Face>(traction[3].on).group, "xmax");
  EXPECT_EQ(traction[3].value.history.value(0.0), 2.0);
  EXPECT_TRUE(traction[3].value.is_number);
}

// A force in all: faces of one size take half of it each, wherever they are.
TEST_F(LoadEffects, of_a_force_on_two_faces_share_it_by_their_area) {
  const auto halves = effects<NodalForces>(load("force", {top, side}, {{"z", 100.0}}));
  ASSERT_EQ(halves.size(), 2U);
  LoadedNodes nodes;
  nodes.weights = Vec::Constant(4, 0.25);  // a face of 1 m^2
  for (const NodalForces& half : halves) EXPECT_DOUBLE_EQ(half.unit(nodes).row(2).sum(), 0.5);
}

TEST_F(LoadEffects, of_gravity_act_on_masses) {
  const auto gravity = effects<BodyForce>(load("gravity", {}, {{"z", -9.0}}));
  ASSERT_EQ(gravity.size(), 1U);
  EXPECT_EQ(gravity[0].unit(Vec3(1, 2, 3)), Vec3::UnitZ());
}

TEST_F(LoadEffects, of_prescribed_motions_leave_what_is_not_given_free) {
  for (const char* word : {"velocity", "displacement"}) {
    const auto motion = effects<PrescribedMotion>(load(word, {top}, {{"y", 3.0}}));
    ASSERT_EQ(motion.size(), 1U);
    EXPECT_EQ(motion[0].is_velocity, std::string(word) == "velocity");
    EXPECT_FALSE(motion[0].along[0] || motion[0].along[2]);
    EXPECT_EQ(motion[0].along[1]->history.value(0.0), 3.0);
    EXPECT_EQ(motion[0].name_along(1), std::string("load.") + word + " y");
  }
}

TEST_F(LoadEffects, of_base_acceleration_shake_a_support_along_a_unit_direction) {
  const auto base_motion =
      effects<BaseMotion>(load("base_acceleration", {SupportPtr(base)}, {{"history", 5.0}}, Vec3(0, 3, 4)));
  ASSERT_EQ(base_motion.size(), 1U);
  EXPECT_EQ(base_motion[0].on, base);
  EXPECT_LT((base_motion[0].direction - Vec3(0, 0.6, 0.8)).norm(), 1e-15);
  EXPECT_EQ(base_motion[0].acceleration.value(0.0), 5.0);
}

TEST_F(LoadEffects, of_a_bolt_are_a_length_a_force_or_its_end) {
  EXPECT_EQ(effects<Shortening>(load("shortening", {InterfacePtr(shank)}, 1e-5))[0].value.history.value(0.0), 1e-5);
  EXPECT_EQ(effects<PreloadForce>(load("preload", {InterfacePtr(shank)}, 3e4))[0].value.history.value(0.0), 3e4);
  EXPECT_EQ(effects<Release>(load("release", {InterfacePtr(shank)}, 2e-6))[0].at, 2e-6);
}

TEST_F(LoadEffects, of_a_preload_by_torque_are_the_force_of_the_share_that_is_modelled) {
  GivenArguments arguments("load.preload", {});
  arguments.on = {InterfacePtr(shank)};
  for (const auto& [key, value] :
       std::map<std::string, double>{{"torque", 80.0}, {"friction_factor", 0.2}, {"diameter", 0.012}, {"share", 0.25}})
    arguments.values_of_time[key] = {History::constant(value), true};
  const auto preload = effects<PreloadForce>(make_load(arguments));
  EXPECT_DOUBLE_EQ(preload.at(0).value.history.value(0.0), 0.25 * 80.0 / (0.2 * 0.012));
  EXPECT_EQ(preload[0].share, 0.25);
}

TEST_F(LoadEffects, are_there_for_every_load_of_the_table_with_words_of_their_own) {
  std::set<std::string> words;
  for (const LoadEntry& entry : load_table()) {
    EXPECT_TRUE(words.insert(entry.word).second) << entry.word;
    GivenArguments arguments("load." + entry.word, {"deck.lua", 40});
    for (const char* key : {"history", "by", "at", "force", "x", "value", "number", "speed", "expansion"})
      arguments.values_of_time[key] = {History::constant(1.0), true};
    for (const char* key : {"direction", "axis", "through"}) arguments.lists[key] = {0, 0, 1};
    arguments.parts = {upper};
    arguments.words["name"] = "modes";
    arguments.outputs["mode"] = std::make_shared<ModesOfNothing>(arguments);
    for (const Target& target :
         std::vector<Target>{top, Region{upper, {0, 1}}, InterfacePtr(shank), SupportPtr(base)}) {
      arguments.on = {target};
      const LoadPtr load = entry.make(arguments);
      EXPECT_EQ(load->word(), entry.word);
      EXPECT_STRNE(load->unit(), "");
      if (!load->can_act_on(target) && !load->is_everywhere()) continue;
      EXPECT_FALSE(load->effects().empty()) << entry.word;
    }
  }
}

}  // namespace

}  // namespace dygita
