#include "files/frame_summary.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace dygita {

namespace {

// is_own: of the points; empty: all count.
void gather(const std::vector<NamedField>& fields, const char* name, std::vector<double>& values,
            const std::vector<char>& is_own = {}) {
  for (const NamedField& field : fields)
    if (field.name == name && field.values.rows() == 1)
      for (Eigen::Index i = 0; i < field.values.cols(); ++i)
        if (std::isfinite(field.values(0, i)) && (is_own.empty() || is_own[static_cast<size_t>(i)]))
          values.push_back(field.values(0, i));
}

}  // namespace

double exceeded_by(size_t n, std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const auto place = values.begin() + static_cast<long>(n);
  std::nth_element(values.begin(), place, values.end(), std::greater<>());
  return *place;
}

std::vector<double> stresses_of(const Frame& frame) {
  std::vector<double> von_mises;
  for (const PartFrame& part : frame.parts) gather(part.fields, "von_mises", von_mises, part.is_own);
  return von_mises;
}

FrameSummary summary_of(const Frame& frame) {
  FrameSummary summary{frame.label_time, frame.step};
  summary.missed = frame.missed;
  std::vector<double> von_mises = stresses_of(frame), pressure;
  for (const PartFrame& part : frame.parts) {
    for (Eigen::Index i = 0; i < part.displacement.cols(); ++i)
      if (const double u = part.displacement.col(i).norm(); std::isfinite(u))
        summary.displacement = std::max(summary.displacement, u);
  }
  for (const InterfaceFrame& interface : frame.interfaces) gather(interface.fields, "pressure", pressure);
  summary.von_mises = exceeded_by(n_exceeding(von_mises.size()), von_mises);
  summary.pressure = exceeded_by(n_exceeding(pressure.size()), pressure);
  summary.has_interfaces = !frame.interfaces.empty();
  return summary;
}

}  // namespace dygita
