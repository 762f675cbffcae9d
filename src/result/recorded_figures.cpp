#include "result/recorded_figures.hpp"

namespace dygita {

std::map<std::string, double> recorded_figures(const RunResult& result) {
  std::map<std::string, double> figures = by_label(result.figures);
  for (const auto& [output, findings] : result.findings)
    figures.insert(findings.figures.begin(), findings.figures.end());
  return figures;
}

}  // namespace dygita
