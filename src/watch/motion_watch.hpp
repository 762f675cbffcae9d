// Watches a run for motions that a theory of small displacements does not know: interfaces that slide on to other cells
// or leave each other. Looks now and then, and closely only where something may have happened.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "result/result.hpp"
#include "watch/watched_jumps.hpp"

namespace dygita {

// Is an increment among those that are looked at: some of every step, and of static ones those in equilibrium?
bool shows_motion(const Instant& instant);
// "t = 1.2 ms in step 'shock'"
std::string time_of(const Instant& instant);
// "(1, 2, 3) mm"
std::string in_mm(const Vec3& place);

class MotionWatch {
 public:
  // Collective.
  void begin_step(const Instant& start);
  void accept(const Instant& instant);
  // Collective. Puts together what all ranks have seen.
  void settle();
  // Warnings with figures, place and time, and the largest figures of all. On rank 0, once it has settled.
  void finish(RunResult& result) const;

 private:
  // When and where something was largest, and when it first was too much; times are indices in moments_.
  struct Finding {
    double most = 0.0;          // as a share of what is allowed
    double value = 0.0;         // m, or rad
    double length = 0.0;        // m, of the interface along the slip
    double cell = 0.0;          // m, along the slip
    Vec3 place = Vec3::Zero();  // m
    int at = -1, first = -1;
  };
  // What the meshes say of a surface, once; but for its name where it is watched alone.
  struct Watched {
    int surface = 0;
    std::string name{};              // "interface 'touch'"
    std::vector<double> shortest{};  // m, of each point, edges of the facets around it
    double cell = 0.0;               // m, median edge; 0: it has no facets, and is not looked at
    Finding slip{}, opening{}, passing{};
  };

  void prepare(const Instant& instant);
  static void look_at_edges(const Surface& surface, Watched& watched);
  static bool has_jump(const Instant& instant, const Watched& watched);  // that anything is known of
  void watch_surface(const Instant& instant, const Points& jumps, Watched& watched);
  void note(double share, Finding found, Finding& finding) const;

  bool is_ready_ = false;
  WatchedJumps jumps_;
  std::vector<Watched> surfaces_;     // that may slide or part
  std::vector<std::string> moments_;  // looked at so far, the same on all ranks
};

}  // namespace dygita
