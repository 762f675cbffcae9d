// Watches a run for motions that a theory of small displacements does not know: interfaces that slide on to other cells
// or leave each other. Looks now and then, and closely only where something may have happened.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "result/moved_side.hpp"
#include "result/result.hpp"

namespace dygita {

// Is an increment among those that are looked at: some of every step, and of static ones those in equilibrium?
bool shows_motion(const Instant& instant);
// "t = 1.2 ms in step 'shock'"
std::string time_of(const Instant& instant);
// "(1, 2, 3) mm"
std::string in_mm(const Vec3& place);

class MotionWatch {
 public:
  void begin_step(const Instant& start);
  void accept(const Instant& instant);  // collective; all ranks see the same
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
    MovedSides sides;
    Finding slip{}, opening{}, passing{};
  };

  void prepare(const Instant& instant);
  static bool has_jump(const Instant& instant, const Watched& watched);  // that anything is known of
  static void watch_surface(const Instant& instant, const Points& jumps, Watched& watched);
  static void note(const Instant& instant, double share, Finding found, Finding& finding);

  bool is_ready_ = false;
  std::vector<Watched> surfaces_;
};

}  // namespace dygita
