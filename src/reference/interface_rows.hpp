// The laws on the law rows of the assembly: what an increment's nonlinear system asks (manual, eq. R4-R5 and R7).
//
// Unknown: the reduced forces f. rate = free - W f, F = f + R (rate - held), and at every point F = law(rate + Y F).
#pragma once

#include <algorithm>

#include "reference/merged_assembly.hpp"
#include "step/point_record.hpp"

namespace dygita {

// A factor is kept, over iterations and increments, while other tangents are solved with it by products that cost less
// than another factor, which is worth some n / 80 of them. Far from the solution that need not be close (S. C.
// Eisenstat, H. F. Walker, SIAM J. Sci. Comput. 17, 1996).
struct KeptFactor {
  static double close_enough(double residual) { return std::clamp(residual, 1e-8, 1e-3); }
  static int most_products(int n_rows) { return std::min(40, n_rows / 80); }
};

class InterfaceRows {
 public:
  // Both outlive this object.
  InterfaceRows(const StepModel& model, const MergedAssembly& assembly);

  struct Fields {
    Vec f, rate, force;                 // N, m/s (static m), N
    Vec asked;                          // law(rate + Y F), N
    double distance = 0.0, size = 0.0;  // W: sum Y (F - asked)^2, and of both fields

    Vec phi() const { return force - asked; }
  };
  // limits: normal trials that limit friction, one a point; empty: each point's own. Not finite where they have
  // diverged.
  Fields fields(Vec f, const std::vector<PointRecord>& records, const Increment& increment,
                const std::vector<double>& limits = {}) const;
  // The search problem of a point at such fields.
  Trial trial_of(size_t i_point, const Vec& rate, const Vec& force, const PointRecord& record) const;
  // Gives the records trials and forces of such fields.
  void keep(const Fields& fields, std::vector<PointRecord>& records, const Increment& increment) const;

  double relative(const Fields& fields) const;
  // What `relative` compares with: fields of increments that are solved, and energy seen so far (J), which keeps
  // increments where nothing happens from iterating on round-off.
  double largest() const { return std::max(largest_, floor_); }
  void note_size(double size) { largest_ = std::max(largest_, size); }
  void raise_floor(double energy, double dt) { floor_ = std::max(floor_, 1e-12 * energy / dt); }

  const StepModel& model() const { return *model_; }
  const MergedAssembly& assembly() const { return *assembly_; }
  const Vec& y() const { return y_; }
  double extent() const { return extent_; }  // m, of all substructures

 private:
  const StepModel* model_;
  const MergedAssembly* assembly_;
  Vec y_;
  double extent_ = 0.0, largest_ = 0.0, floor_ = 0.0;
};

}  // namespace dygita
