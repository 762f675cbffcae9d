// The local stage of preloaded interfaces: the one shortening that all their points share (manual, eq. B1).
#include "latin/local_stage.hpp"

namespace dygita {

void LocalStage::shorten(int i_preload, const Vec& velocity, const Vec& q) {
  const Preload& preload = preloads_[i_preload];
  if (preload.points.empty()) return;
  if (prescribed_.size() > 0) {
    for (const int i : preload.points) points_[i].trial.shortening = prescribed_[i_preload];
    return;
  }
  for (const int i : preload.points) {
    const Point& point = model_->exchange.points[i];
    set_trial(point, gather(point.first_port, point.first_port_2, velocity, q),
              gather(point.first_port_2, point.end_port, velocity, q), points_[i]);
  }
  const double target = preload.target(i_increment_, model_->step->increments);
  dygita::shorten(*model_, preload, target, increment_, points_);
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
