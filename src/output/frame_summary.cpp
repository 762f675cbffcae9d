#include "output/frame_summary.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dygita {

namespace {

void gather(const std::vector<NamedField>& fields, const char* name, std::vector<double>& values) {
  for (const NamedField& field : fields)
    if (field.name == name && field.values.rows() == 1)
      for (Eigen::Index i = 0; i < field.values.cols(); ++i)
        if (std::isfinite(field.values(0, i))) values.push_back(field.values(0, i));
}

double exceeded_by_few(std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const auto place = values.begin() + static_cast<long>(values.size() - 1 - (values.size() - 1) / 200);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

FrameSummary summary_of(const Frame& frame) {
  FrameSummary summary{frame.label_time, frame.step};
  summary.missed = frame.missed;
  std::vector<double> von_mises, pressure;
  for (const PartFrame& part : frame.parts) {
    for (Eigen::Index i = 0; i < part.displacement.cols(); ++i)
      if (const double u = part.displacement.col(i).norm(); std::isfinite(u))
        summary.displacement = std::max(summary.displacement, u);
    gather(part.fields, "von_mises", von_mises);
  }
  for (const InterfaceFrame& interface : frame.interfaces) gather(interface.fields, "pressure", pressure);
  summary.von_mises = exceeded_by_few(von_mises);
  summary.pressure = exceeded_by_few(pressure);
  summary.has_interfaces = !frame.interfaces.empty();
  return summary;
}

}  // namespace dygita
