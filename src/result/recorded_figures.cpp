#include "result/recorded_figures.hpp"

#include <cmath>

#include "result/spectra.hpp"
#include "result/spectrum_band.hpp"

namespace dygita {

std::map<std::string, double> recorded_figures(const Problem& problem, const RunResult& result) {
  std::map<std::string, double> figures = by_label(result.figures);
  for (const OutputPtr& output : problem.outputs) {
    if (const auto band = result.bands.find(output.get()); band != result.bands.end())
      for (size_t i = 1; i < band->second.names.size(); ++i)
        figures["spectrum '" + output->name + "', mean band, " + band->second.names[i] + " [dB]"] =
            mean_band(band->second, band->second.names[i]);
    if (const Exceedance worst = exceedance_of(*output, result); worst.is_known) {
      figures["largest exceedance of the specification of '" + output->name + "' [dB]"] = worst.decibels;
      figures["frequency of the largest exceedance of '" + output->name + "' [Hz]"] = worst.frequency;
    }
    if (const auto loop = result.loops.find(output.get()); loop != result.loops.end()) {
      const auto note = [&](const char* what, double value) {
        if (std::isfinite(value)) figures["loop '" + output->name + "', " + what] = value;
      };
      note("exponent of the loss over the force", loop->second.exponent);
      note("exponent of the loss over the displacement", loop->second.displacement_exponent);
      note("first stiffness [N/m]", loop->second.stiffness);
    }
  }
  return figures;
}

}  // namespace dygita
