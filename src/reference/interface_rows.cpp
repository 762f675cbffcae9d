#include "reference/interface_rows.hpp"

#include <cmath>
#include <limits>

#include "law/law_slope.hpp"

namespace dygita {

InterfaceRows::InterfaceRows(const StepModel& model, const MergedAssembly& assembly)
    : model_(&model), assembly_(&assembly), y_(assembly.compliance().diagonal()) {
  // Any positive Y gives the same solution; one for both tangents keeps the friction disc round.
  for (size_t i = 0; i < model.exchange.points.size(); ++i) {
    const int t1 = assembly.row(i, 1), t2 = assembly.row(i, 2);
    if (t1 >= 0 && t2 >= 0) y_[t1] = y_[t2] = 0.5 * (y_[t1] + y_[t2]);
  }
  for (const SubstructurePtr& part : model.problem->substructures) {
    const Points& nodes = part->mesh->nodes;
    extent_ += (nodes.rowwise().maxCoeff() - nodes.rowwise().minCoeff()).norm();
  }
}

Trial InterfaceRows::trial_of(size_t i_point, const Vec& rate, const Vec& force, const PointRecord& record) const {
  Trial trial = record.trial;
  trial.s = record.given_rate;
  trial.y.setZero();
  for (int d = 0; d < 3; ++d)
    if (const int i = assembly_->row(i_point, d); i >= 0) {
      trial.y[d] = y_[i];
      trial.s[d] = rate[i] + y_[i] * force[i];
    }
  return trial;
}

InterfaceRows::Fields InterfaceRows::fields(Vec f, const std::vector<PointRecord>& records, const Increment& increment,
                                            const std::vector<double>& limits) const {
  Fields all;
  all.f = std::move(f);
  all.rate = assembly_->free_rate() - assembly_->compliance() * all.f;
  all.force = all.f + assembly_->softening().cwiseProduct(all.rate - assembly_->held_rate());
  all.asked = Vec::Zero(all.f.size());
  for (size_t p = 0; p < records.size(); ++p) {
    const Point& point = model_->exchange.points[p];
    if (!point.law || records[p].is_released) continue;
    const Vec3 asked = limited_force(*point.law, trial_of(p, all.rate, all.force, records[p]), increment,
                                     records[p].law, limits.empty() ? nullptr : &limits[p]);
    for (int d = 0; d < 3; ++d)
      if (const int i = assembly_->row(p, d); i >= 0) all.asked[i] = asked[d];
  }
  all.distance = (all.phi().array().square() * y_.array()).sum();
  all.size = 0.5 * (all.force.array().square() * y_.array() + all.rate.array().square() / y_.array()).sum();
  return all;
}

void InterfaceRows::keep(const Fields& fields, std::vector<PointRecord>& records, const Increment& increment) const {
  for (size_t p = 0; p < records.size(); ++p) {
    PointRecord& record = records[p];
    record.trial = trial_of(p, fields.rate, fields.force, record);
    record.force.setZero();
    const Point& point = model_->exchange.points[p];
    if (point.law && !record.is_released) record.force = point.law->force(record.trial, increment, record.law);
  }
}

double InterfaceRows::relative(const Fields& fields) const {
  return std::sqrt(fields.distance / std::max({largest_, fields.size, floor_, std::numeric_limits<double>::min()}));
}

}  // namespace dygita
