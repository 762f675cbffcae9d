// The local stage of preloaded interfaces: the one shortening that all their points share (manual, eq. B1).
#include <cmath>

#include "latin/local_stage.hpp"
#include "law/law.hpp"

namespace dygita {

// The normal forces of all points grow with d: no more than a scalar equation, each time the fields change.
void LocalStage::shorten(int i_preload, const Vec& velocity, const Vec& q) {
  const Preload& preload = preloads_[i_preload];
  if (preload.points.empty()) return;
  double slope = 0.0;
  for (const int i : preload.points) {
    const Point& point = model_->exchange.points[i];
    set_trial(point, gather(point.first_port, point.first_port_2, velocity, q),
              gather(point.first_port_2, point.end_port, velocity, q), points_[i]);
    if (const double y = points_[i].trial.y[0]; y > 0.0) slope += 1.0 / (increment_.dt * y);
  }
  double size = 0.0;
  const auto force = [&](double d) {
    double sum = 0.0;
    size = 0.0;
    for (const int i : preload.points) {
      PointRecord& record = points_[i];
      record.trial.shortening = d;
      const double f = model_->exchange.points[i].law->force(record.trial, increment_, record.law)[0];
      sum += f;
      size += std::abs(f);
    }
    return sum;
  };
  double d = points_[preload.points.front()].trial.shortening;
  if (prescribed_.size() > 0) {
    d = prescribed_[i_preload];
  } else {
    const double target = preload.target(i_increment_, model_->step->increments);
    force(d);
    d = find_shortening(force, target, d, slope, std::abs(target) + size);
  }
  for (const int i : preload.points) points_[i].trial.shortening = d;
}

PreloadFigures LocalStage::preload_figures() const {
  const int n = static_cast<int>(preloads_.size());
  PreloadFigures figures{Vec::Zero(n), Vec::Zero(n), Vec::Zero(n), Vec::Zero(n), {}};
  for (int k = 0; k < n; ++k) {
    figures.interfaces.push_back(preloads_[k].interface);
    figures.target[k] = preloads_[k].target(i_increment_, model_->step->increments);
    for (const int i : preloads_[k].points) {
      const PointRecord& record = points_[i];
      figures.shortening[k] = record.trial.shortening;
      figures.force[k] += record.force[0];
      if (record.trial.y[0] > 0.0) figures.stiffest[k] += 1.0 / (increment_.dt * record.trial.y[0]);
    }
  }
  return figures;
}

}  // namespace dygita
