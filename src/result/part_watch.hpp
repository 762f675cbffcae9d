// What is watched of all parts in every run, each part and piece on the rank that has it: errors, stresses, motions too
// large for the theory.
#pragma once

#include "result/error_estimator.hpp"
#include "result/motion_watch.hpp"
#include "result/rotation_watch.hpp"
#include "result/stress_recorder.hpp"

namespace dygita {

class PartWatch : public Observer {
 public:
  explicit PartWatch(const Problem& problem) : stresses_(problem) {}

  // All of these are collective.
  void begin_step(const Instant& start) override {
    errors_.begin_step(start);
    motion_.begin_step(start);
    turned_.begin_step(start);
  }
  void accept(const Instant& instant) override {
    errors_.accept(instant);
    motion_.accept(instant);
    turned_.accept(instant);
    stresses_.accept(instant);
  }
  // Once, after the last step: rank 0 knows all.
  void settle() {
    turned_.settle();
    stresses_.settle();
  }

  const ErrorEstimator& errors() const { return errors_; }
  const MotionWatch& motion() const { return motion_; }
  const RotationWatch& turned() const { return turned_; }
  StressRecorder& stresses() { return stresses_; }

 private:
  ErrorEstimator errors_;
  MotionWatch motion_;
  RotationWatch turned_;
  StressRecorder stresses_;
};

}  // namespace dygita
