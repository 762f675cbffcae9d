// Watches every contact of a run, walls with them: each rank the points that it keeps.
#pragma once

#include <vector>

#include "result/contact_summary.hpp"
#include "step/observer.hpp"

namespace dygita {

// All of these are collective.
class ContactRecorder {
 public:
  void begin_step(const Instant& start);
  void accept(const Instant& instant);
  // Once, after the last step: rank 0 knows all.
  void settle();
  // In the order of interfaces and walls.
  std::vector<ContactSummary> take() { return std::move(contacts_); }

 private:
  // A point when the step began.
  struct Start {
    Vec3 slip = Vec3::Zero();
    bool is_closed = false;
  };
  // Of the faces of a contact, those that have a part in the step.
  struct Watched {
    size_t contact;
    int surface;
    std::vector<Start> points;  // all of the surface; those that are kept elsewhere as they were made
  };
  // Sums over the points of a contact at an instant.
  struct Sums {
    double pressed = 0.0;                // N
    Vec3 shear = Vec3::Zero();           // N
    double closed = 0.0, sliding = 0.0;  // m^2
  };

  void find_contacts(const Instant& start);
  void look_at(const Instant& instant, const Watched& watched, Sums& sums, ContactStep& step) const;
  void add(const Sums& sums, bool is_static, ContactSummary& contact) const;

  std::vector<ContactSummary> contacts_;
  std::vector<std::vector<int>> surfaces_;  // of each contact
  std::vector<Watched> watched_;            // in this step
  bool is_new_ = false;                     // the step: no increment yet
};

}  // namespace dygita
