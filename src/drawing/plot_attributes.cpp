#include "drawing/plot_attributes.hpp"

#include "base/log.hpp"
#include "drawing/svg_text.hpp"

namespace dygita {

std::string axis_data(const char* axis, const PlotScale& scale) {
  std::string data = fmt::format(" data-{0}=\"{1:.9g} {2:.9g} {3:d} {4:.9g}\" data-{0}-title=\"{5}\"", axis,
                                 scale.low(), scale.high(), scale.is_log(), scale.unit_size(), escaped(scale.title()));
  if (!scale.has_own_ticks()) return data;
  std::string ticks;
  for (const PlotScale::Tick& tick : scale.ticks())
    ticks += fmt::format("{}[{:.2f},&quot;{}&quot;]", ticks.empty() ? "" : ",", scale.pixel(tick.value),
                         escaped(tick.label));
  return data + fmt::format(" data-{}-ticks=\"[{}]\"", axis, ticks);
}

std::string named(const std::string& name) { return " data-name=\"" + escaped(name) + "\""; }

}  // namespace dygita
