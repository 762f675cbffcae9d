#include "run/condensed_lines.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

namespace dygita {

namespace {

std::string line_of(const Output& output, const LoopSummary& loop) {
  std::string line = fmt::format("loop '{}': ", output.name);
  const int n = loop.cycles.n_rows();
  if (n == 0) {
    line += "no closed cycle";
  } else {
    const std::vector<double>& force = loop.cycles.column("force_amplitude");
    const auto [low, high] = std::minmax_element(force.begin(), force.end());
    line += fmt::format("{} cycle{} of {:.4g}{} N", n, n > 1 ? "s" : "", *low,
                        n > 1 ? fmt::format(" to {:.4g}", *high) : "");
    if (std::isfinite(loop.exponent))
      line += fmt::format(", loss grows with the force to the power {:.2f}, with the displacement to the power {:.2f}",
                          loop.exponent, loop.displacement_exponent);
  }
  if (std::isfinite(loop.stiffness))
    line += fmt::format("; stiffness {:.4g} N/m at first, {:.4g} N/m at {:.4g} N", loop.stiffness, loop.secant,
                        loop.largest_force);
  return line;
}

std::string line_of(const Output& output, const Superelement& element) {
  const size_t n_modes = static_cast<size_t>(element.fixed_frequencies.size());
  std::string line = fmt::format(
      "superelement '{}': {} interface rows and {} modes after step '{}', to be used up to {:.4g} Hz; natural "
      "frequencies",
      output.name, element.rows.size() - n_modes, n_modes, element.step, element.valid_to);
  int n = 0;
  for (;
       n < std::min<int>(8, static_cast<int>(element.frequencies.size())) && element.frequencies[n] <= element.valid_to;
       ++n)
    line += fmt::format(" {:.5g}", element.frequencies[n]);
  return line + (n == 0 ? " above that" : n < 8 ? " Hz, the others above that" : " ... Hz");
}

}  // namespace

std::vector<std::string> condensed_lines(const Problem& problem, const RunResult& result) {
  std::vector<std::string> lines;
  const char* doubt = result.converged ? "" : "; NOT TO BE USED: increments have not converged";
  for (const OutputPtr& output : problem.outputs) {
    if (const auto loop = result.loops.find(output.get()); loop != result.loops.end())
      lines.push_back(line_of(*output, loop->second) + doubt);
    const auto element = result.superelements.find(output.get());
    if (element != result.superelements.end()) lines.push_back(line_of(*output, element->second));
    if (output->kind == OutputKind::superelement && element == result.superelements.end())
      lines.push_back(fmt::format("superelement '{}': NOT MADE", output->name));
  }
  return lines;
}

}  // namespace dygita
