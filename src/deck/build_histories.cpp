#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "base/log.hpp"
#include "deck/build_model.hpp"
#include "deck/deck_state.hpp"
#include "signal/signal_file.hpp"

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
  if (rise + hold + fall <= 0.0) throw InputError("'rise', 'hold' and 'fall' are all zero: the pulse has zero length");
  return content(History::pulse(a.number("peak"), rise, hold, fall));
}

Content build_piecewise(const Declaration& d) {
  auto times = d.arguments.numbers("times"), values = d.arguments.numbers("values");
  if (times.size() != values.size()) {
    throw InputError(fmt::format("{} times and {} values: their numbers must be equal", times.size(), values.size()));
  }
  for (size_t i = 1; i < times.size(); ++i) {
    if (times[i] > times[i - 1]) continue;
    throw InputError(
        fmt::format("'times' must increase: times[{}] = {:g} s comes after {:g} s", i + 1, times[i], times[i - 1]));
  }
  return content(History::piecewise(std::move(times), std::move(values)));
}

std::string in_written_unit(const SampledSignal& signal, double value) {
  if (signal.unit_written.empty()) return fmt::format("{:.4g}", value);
  return fmt::format("{:.4g} {}", value / signal.unit_factor, signal.unit_written);
}

// What the record is, for the eye: a unit read wrongly shows in its peak.
std::string description(const std::string& file, const SampledSignal& signal) {
  const auto peak = std::max_element(signal.values.begin(), signal.values.end(),
                                     [](double a, double b) { return std::abs(a) < std::abs(b); });
  std::string text =
      fmt::format("signal '{}': {} points from {:.4g} to {:.4g} ms, peak {} at {:.4g} ms", file, signal.times.size(),
                  1e3 * signal.times.front(), 1e3 * signal.times.back(), in_written_unit(signal, *peak),
                  1e3 * signal.times[static_cast<size_t>(peak - signal.values.begin())]);
  if (!signal.has_unit)
    text += ", of no unit";
  else if (signal.unit_factor != 1.0)
    text += fmt::format(" ({:.4g} {})", *peak, signal.unit);
  return text + fmt::format("; before them {} holds, after them {}", in_written_unit(signal, signal.values.front()),
                            in_written_unit(signal, signal.values.back()));
}

// One of the file's values in SI, as the deck has it.
void take_unit(double factor, SampledSignal& signal) {
  if (signal.has_unit)
    throw InputError(fmt::format("the file gives the unit of its values, [{}]: leave out 'unit'", signal.unit_written));
  for (double& value : signal.values) {
    value *= factor;
    if (!std::isfinite(value))
      throw InputError(fmt::format("a value of the file times 'unit' = {:g} is not a finite number", factor));
  }
  signal.has_unit = true;
}

Content build_file(const Declaration& d) {
  const std::string path = d.arguments.file("file");
  SampledSignal signal = read_signal(path, d.arguments.has("column") ? d.arguments.text("column") : "");
  if (d.arguments.has("unit")) take_unit(d.arguments.number("unit"), signal);
  const std::string text = description(d.arguments.text("file"), signal);
  DeckState& state = DeckState::of(d.lua);
  if (state.signals_told.insert(text).second) say(text);
  return content(History::record(std::move(signal), path));
}

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
