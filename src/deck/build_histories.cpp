#include <spdlog/fmt/fmt.h>

#include "deck/build_model.hpp"

namespace dygita {

namespace {

Content content(History history) { return std::make_shared<const History>(std::move(history)); }

Content build_constant(const Declaration& d) { return content(History::constant(d.arguments.number("value"))); }

Content build_step(const Declaration& d) {
  return content(History::step(d.arguments.number("value"), d.arguments.number("at")));
}

Content build_ramp(const Declaration& d) {
  const LuaArguments& a = d.arguments;
  return content(History::ramp(a.number("from"), a.number("to"), a.number("duration")));
}

Content build_half_sine(const Declaration& d) {
  return content(History::half_sine(d.arguments.number("peak"), d.arguments.number("duration")));
}

Content build_haversine(const Declaration& d) {
  return content(History::haversine(d.arguments.number("peak"), d.arguments.number("duration")));
}

Content build_pulse(const Declaration& d) {
  const LuaArguments& a = d.arguments;
  const double rise = a.number("rise"), hold = a.number("hold"), fall = a.number("fall");
  if (rise + hold + fall <= 0.0) throw InputError("'rise', 'hold' and 'fall' are all zero: the pulse has no length");
  return content(History::pulse(a.number("peak"), rise, hold, fall));
}

Content build_piecewise(const Declaration& d) {
  auto times = d.arguments.numbers("times"), values = d.arguments.numbers("values");
  if (times.size() != values.size()) {
    throw InputError(fmt::format("{} times and {} values: equally many are needed", times.size(), values.size()));
  }
  for (size_t i = 1; i < times.size(); ++i) {
    if (times[i] > times[i - 1]) continue;
    throw InputError(
        fmt::format("'times' must increase: times[{}] = {:g} s comes after {:g} s", i + 1, times[i], times[i - 1]));
  }
  return content(History::piecewise(std::move(times), std::move(values)));
}

Content build_file(const Declaration& d) { return content(History::from_file(d.arguments.file("file"))); }

}  // namespace

const Builders& history_builders() {
  static const Builders builders = {
      {"history.constant", build_constant},   {"history.step", build_step},           {"history.ramp", build_ramp},
      {"history.half_sine", build_half_sine}, {"history.haversine", build_haversine}, {"history.pulse", build_pulse},
      {"history.piecewise", build_piecewise}, {"history.file", build_file},
  };
  return builders;
}

}  // namespace dygita
