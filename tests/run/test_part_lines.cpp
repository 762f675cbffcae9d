// What a check and a run tell of parts and of bases that are shaken.
#include "model/assembly.hpp"
#include "run/part_lines.hpp"

namespace dygita {
namespace {

using BaseLines = Assembly;

// 100 m/s^2 and 2 ms: 2/pi of their product is the velocity, and from the pulse's middle on it counts for the way.
TEST_F(BaseLines, tell_where_a_shaken_base_ends) {
  GivenArguments arguments("load.base_acceleration", {"deck.lua", 40});
  arguments.on = {base};
  arguments.lists["direction"] = {0.0, 0.0, -1.0};
  arguments.values_of_time["history"] = {History::half_sine(100.0, 2e-3), false};
  shock->loads = {make_load(arguments)};
  shock->duration = 10e-3;
  shock->dt = 10e-6;
  auto later = std::make_shared<Step>(*shock);  // it keeps its velocity
  later->loads.clear();
  later->after = shock;
  problem.steps = {tighten, shock, later};
  EXPECT_EQ(base_lines(problem),
            std::vector<std::string>{"  base 'base': in the 20 ms of the dynamic steps its velocity changes by (0, 0, "
                                     "-0.127) m/s, and its final displacement is (0, 0, -2.42) mm"});
  // So it does where a static step comes last.
  auto relax = std::make_shared<Step>(*tighten);
  relax->after = later;
  problem.steps.push_back(relax);
  EXPECT_NE(base_lines(problem).at(0).find("its velocity changes by (0, 0, -0.127) m/s"), std::string::npos);
  shock->loads.clear();
  EXPECT_TRUE(base_lines(problem).empty());
}

}  // namespace
}  // namespace dygita
