// Watches every contact of a run, walls with them: each rank the points that it keeps.
#pragma once

#include <limits>
#include <vector>

#include "result/contact_summary.hpp"
#include "step/observer.hpp"

namespace dygita {

struct RunResult;

// All of these are collective.
class ContactRecorder {
 public:
  void begin_step(const Instant& start);
  void accept(const Instant& instant);
  // Once, after the last step: rank 0 knows all.
  void settle();
  // Warns of friction that dt does not resolve, of chatter and of parts that nothing touches at the end of the last
  // static step, in the contacts that it has given.
  void tell(RunResult& result) const;
  // In the order of interfaces and walls.
  std::vector<ContactSummary> take() { return std::move(contacts_); }

 private:
  // Increments in which a point has slid on one way.
  struct Slide {
    int n = 0;
    double work = 0.0;  // J
    Vec3 force = Vec3::Zero();
  };
  // A point when the step began, and its friction since.
  struct Start {
    Vec3 slip = Vec3::Zero();
    bool is_closed = false;
    bool was_closed = false;  // an increment ago
    double work = 0.0;        // J, that friction has taken up to the last increment
    Slide slide = {};
  };
  // Of a dynamic step, J: what friction takes in a contact, how much of it in slides of one or two increments, whose
  // ends dt decides, and the most that the assembly moves with.
  struct Rubbing {
    const Step* step;
    size_t contact;
    double taken = 0.0, brief = 0.0, motion = 0.0;
  };
  // Of the faces of a contact, those that have a part in the step.
  struct Watched {
    size_t contact;
    int surface;
    std::vector<Start> points;  // all of the surface; those that are kept elsewhere as they were made
    bool rubs = false;          // in increments of the deck
  };
  // Sums over the points of a contact at an instant.
  struct Sums {
    double pressed = 0.0;                // N
    Vec3 shear = Vec3::Zero();           // N
    double closed = 0.0, sliding = 0.0;  // m^2
    // N m, about the contact's middle: of the shear; of what presses, were it shear across the way there.
    Vec3 moment = Vec3::Zero();
    double leverage = 0.0;
    double changed = 0.0;  // m^2, closed since the last increment, or open
  };
  // Of a dynamic step, in the increments in which the contact carried something: their number, the area (m^2) that has
  // closed or opened, the sum of what pressed (N) and of its changes, its least and its most.
  struct Changes {
    const Step* step;
    size_t contact;
    int n = 0;
    double area = 0.0, pressed = 0.0, changed = 0.0, last = 0.0;
    double lowest = std::numeric_limits<double>::infinity(), highest = 0.0;
  };

  void find_contacts(const Instant& start);
  void follow_friction(const Instant& instant);
  static void follow_slide(const LawState& now, const Vec3& force, double taken, Slide& slide, Rubbing& of);
  void look_at(const Instant& instant, Watched& watched, Sums& sums, ContactStep& step) const;
  void tell_friction(RunResult& result) const;
  void tell_chatter(RunResult& result) const;
  void tell_let_go(RunResult& result) const;
  void find_let_go(const Instant& instant);
  void add(const Sums& sums, bool is_static, size_t contact);

  // A substructure that nothing holds at the end of the last static step, and the contact that is open furthest there.
  struct LetGo {
    const Step* step;
    std::string part, contact;
    double opening = 0.0;  // m
  };
  std::vector<ContactSummary> contacts_;
  std::vector<std::vector<int>> surfaces_;  // of each contact
  std::vector<Vec3> middles_;               // m, of each contact
  std::vector<Watched> watched_;            // in this step
  bool is_new_ = false;                     // the step: no increment yet
  std::vector<Changes> changes_;            // of each contact in this step, after those of the steps before
  std::vector<Rubbing> rubbing_;            // of each contact in this step, after those of the steps before
  std::vector<LetGo> let_go_;
};

}  // namespace dygita
