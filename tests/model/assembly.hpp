// A small sound problem that each test breaks in one place: two unit blocks, one on the other, screwed together.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "base/log.hpp"
#include "law/law.hpp"
#include "mesh/box.hpp"
#include "model/given_arguments.hpp"
#include "model/load.hpp"
#include "model/output_double.hpp"

namespace dygita {

template <class T>
std::shared_ptr<T> declared(const std::string& name, int line) {
  auto object = std::make_shared<T>();
  object->name = name;
  object->origin = Origin{"deck.lua", line};
  return object;
}

// A load of these values, and of a direction or an axis along z where it has one.
inline LoadPtr load(const std::string& word, std::vector<Target> on, const std::map<std::string, double>& values,
                    const Vec3& direction = Vec3::UnitZ()) {
  GivenArguments arguments("load." + word, {"deck.lua", 40});
  arguments.on = std::move(on);
  for (const auto& [key, value] : values) arguments.values_of_time[key] = {History::constant(value), true};
  for (const char* key : {"direction", "axis"}) arguments.lists[key] = {direction[0], direction[1], direction[2]};
  return make_load(arguments);
}

// The same value whatever the load calls it; along x where it has axes.
inline LoadPtr load(const std::string& word, std::vector<Target> on, double value = 1.0) {
  return load(word, std::move(on), {{"history", value}, {"by", value}, {"at", value}, {"force", value}, {"x", value}});
}

inline SupportKindPtr a_wall() { return make_support("wall", {{"friction", 0.0}, {"gap", 0.0}}); }

class Assembly : public ::testing::Test {
 protected:
  std::shared_ptr<Substructure> lower = declared<Substructure>("lower", 1), upper = declared<Substructure>("upper", 2);
  std::shared_ptr<Interface> shank = declared<Interface>("shank", 10), mating = declared<Interface>("mating", 11);
  std::shared_ptr<Support> base = declared<Support>("base", 20);
  std::shared_ptr<Step> tighten = declared<Step>("tighten", 30), shock = declared<Step>("shock", 31);
  std::shared_ptr<OutputDouble> above = output_double("above", 50), below = output_double("below", 51);
  Problem problem;

  Assembly() {
    lower->mesh = box_mesh(Vec3::Zero(), Vec3::Ones(), {2, 2, 2});
    upper->mesh = box_mesh(Vec3(0, 0, 1), Vec3::Ones(), {2, 2, 2});
    shank->law = make_law("plastic", {{"yield", 5e8}, {"hardening", 0.0}, {"compression", 0.0}});
    mating->law = make_law("contact", {{"friction", 0.0}, {"gap", 0.0}});
    for (const auto& interface : {shank, mating}) {
      interface->side_1 = Face{lower, "zmax"};
      interface->side_2 = Face{upper, "zmin"};
    }
    base->on = {Face{lower, "zmin"}};
    base->kind = make_support("fixed");
    tighten->is_static = true;
    tighten->loads = {load("shortening", {InterfacePtr(shank)}, 1e-5)};
    shock->after = tighten;
    shock->duration = 200e-6;
    shock->dt = 1e-6;
    shock->loads = {load("pressure", {Face{upper, "zmax"}}, 1e6)};
    problem.name = "bolted";
    problem.origin = Origin{"deck.lua", 84};
    problem.substructures = {lower, upper};
    problem.interfaces = {shank, mating};
    problem.supports = {base};
    problem.steps = {tighten, shock};
    problem.outputs = {above, below};
    take_warnings();
  }
};

}  // namespace dygita
