// What is watched of all parts and interfaces in every run, on the rank that has them: errors, stresses, motions too
// large for the theory, penetrations.
#pragma once

#include "estimates/error_estimator.hpp"
#include "watch/contact_recorder.hpp"
#include "watch/gap_watch.hpp"
#include "watch/motion_watch.hpp"
#include "watch/rotation_watch.hpp"
#include "watch/stress_recorder.hpp"

namespace dygita {

class PartWatch : public Observer {
 public:
  explicit PartWatch(const Problem& problem) : views_(problem), errors_(problem, views_), stresses_(problem, views_) {}
  PartWatch(const PartWatch&) = delete;
  PartWatch& operator=(const PartWatch&) = delete;

  // All of these are collective.
  void begin_step(const Instant& start) override {
    errors_.begin_step(start);
    motion_.begin_step(start);
    turned_.begin_step(start);
    gaps_.begin_step(start);
    contacts_.begin_step(start);
  }
  void accept(const Instant& instant) override {
    errors_.accept(instant);
    motion_.accept(instant);
    turned_.accept(instant);
    stresses_.accept(instant);
    gaps_.accept(instant);
    contacts_.accept(instant);
  }
  // Once, after the last step: rank 0 knows all.
  void settle() {
    motion_.settle();
    turned_.settle();
    stresses_.settle();
    gaps_.settle();
    contacts_.settle();
  }

  const ErrorEstimator& errors() const { return errors_; }
  const MotionWatch& motion() const { return motion_; }
  const RotationWatch& turned() const { return turned_; }
  PartViews& views() { return views_; }
  StressRecorder& stresses() { return stresses_; }
  ContactRecorder& contacts() { return contacts_; }
  const GapWatch& gaps() const { return gaps_; }

 private:
  PartViews views_;
  ErrorEstimator errors_;
  MotionWatch motion_;
  RotationWatch turned_;
  StressRecorder stresses_;
  GapWatch gaps_;
  ContactRecorder contacts_;
};

}  // namespace dygita
