#include <spdlog/fmt/fmt.h>

#include "deck/build_bolts.hpp"

namespace dygita {

namespace {

void set_value(const Declaration& d, const char* key, size_t component, Load& load) {
  if (!d.arguments.has(key)) return;
  const TimeValue value = d.arguments.value(key);
  load.value[component] = value.history;
  load.is_number[component] = value.is_number;
}

Content build_load(const Declaration& d) {
  static const std::map<std::string, LoadKind> kinds = {{"load.pressure", LoadKind::pressure},
                                                        {"load.traction", LoadKind::traction},
                                                        {"load.force", LoadKind::force},
                                                        {"load.velocity", LoadKind::velocity},
                                                        {"load.displacement", LoadKind::displacement},
                                                        {"load.base_acceleration", LoadKind::base_acceleration},
                                                        {"load.gravity", LoadKind::gravity},
                                                        {"load.shortening", LoadKind::shortening},
                                                        {"load.release", LoadKind::release},
                                                        {"load.preload", LoadKind::preload}};
  auto load = std::make_shared<Load>();
  load->kind = kinds.at(d.path);
  load->origin = d.origin;
  load->on = d.arguments.targets("on");
  for (const char* scalar : {"history", "by", "at", "force"}) set_value(d, scalar, 0, *load);
  set_value(d, "x", 0, *load);
  set_value(d, "y", 1, *load);
  set_value(d, "z", 2, *load);
  if (d.arguments.has("direction")) load->direction = d.arguments.unit_vector("direction");
  if (load->kind == LoadKind::shortening || load->kind == LoadKind::preload) read_bolt(d, *load);
  return LoadPtr(load);
}

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
    throw InputError(fmt::format("{} times and {} values: as many are needed", times.size(), values.size()));
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

const Builders& load_builders() {
  static const Builders builders = {
      {"load.pressure", build_load},  {"load.traction", build_load},          {"load.force", build_load},
      {"load.velocity", build_load},  {"load.displacement", build_load},      {"load.base_acceleration", build_load},
      {"load.gravity", build_load},   {"load.shortening", build_load},        {"load.release", build_load},
      {"load.preload", build_load},   {"history.constant", build_constant},   {"history.step", build_step},
      {"history.ramp", build_ramp},   {"history.half_sine", build_half_sine}, {"history.haversine", build_haversine},
      {"history.pulse", build_pulse}, {"history.piecewise", build_piecewise}, {"history.file", build_file},
  };
  return builders;
}

}  // namespace dygita
