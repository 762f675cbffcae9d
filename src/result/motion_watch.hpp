// Watches a run for motions that a theory of small displacements does not know: interfaces that slide on to other cells
// or leave each other, parts that turn. Looks now and then, and closely only where something may have happened.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "result/result.hpp"
#include "solution/observer.hpp"

namespace dygita {

class MotionWatch {
 public:
  void begin_step(const Instant& start);
  void accept(const Instant& instant);
  // Warnings with figures, place and time, and the largest figures of all.
  void finish(RunResult& result) const;

 private:
  // When and where something was largest, and when it first was too much.
  struct Finding {
    double most = 0.0;          // as a share of what is allowed
    double value = 0.0;         // m, or rad
    double length = 0.0;        // m, of the interface along the slip
    double cell = 0.0;          // m, along the slip
    Vec3 place = Vec3::Zero();  // m
    std::string at{}, first{};  // "t = 1.2 ms of step 'shock'"
  };
  // What the meshes say of a surface, once.
  struct Watched {
    int surface = 0;
    std::string name;              // "interface.contact 'touch'"
    std::vector<double> shortest;  // m, of each point, edges of the facets around it
    double cell = 0.0;             // m, median edge
    Finding slip{}, opening{}, passing{};
  };

  void prepare(const Instant& instant);
  void watch_surface(const Instant& instant, const std::vector<Points>& displacement, Watched& watched) const;
  void watch_part(const Instant& instant, int part, const Points& displacement);
  static void note(const Instant& instant, double share, Finding found, Finding& finding);

  bool is_ready_ = false;
  std::vector<Watched> surfaces_;
  std::vector<std::string> parts_;
  std::vector<double> smallest_cell_;  // m, of each part
  std::vector<Finding> rotation_;      // of each part
};

}  // namespace dygita
