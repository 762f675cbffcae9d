// Force against displacement of a joint (manual, eq. C1).
#include "result/loop_cycles.hpp"
#include "result/surface_sums.hpp"
#include "result/weighted_nodes.hpp"

namespace dygita {

namespace {

class LoopSampler : public Sampler {
 public:
  LoopSampler(const Problem& problem, const Output& output)
      : Sampler({{"time", "displacement", "force"}, {"s", "m", "N"}, {}, {}}), problem_(problem), output_(output) {
    for (const FaceOrRegion& place : output.between) between_.push_back(weighted_nodes(problem, place));
    is_support_ = std::holds_alternative<SupportPtr>(output.on.front());
  }

  void begin_step(const Instant& instant) override {
    before_ = displacement(instant);
    if (instant.i_step == 0) add_row(instant, instant.time(), {before_, 0.0});
  }

  // The force is a mean over a time step; so is the displacement then.
  void accept(const Instant& instant) override {
    const double now = displacement(instant),
                 force = resultant(instant, problem_, output_.on).force.dot(*output_.direction);
    add_row(instant, mean_time(instant),
            {instant.is_static() ? now : 0.5 * (before_ + now), is_support_ ? -force : force});
    before_ = now;
  }

  void summarise(RunResult& result) override {
    int first = 0;
    const int i_after = output_.after ? index_of(problem_.steps, output_.after.get()) : -1;
    for (int i = 0; i < table().n_rows(); ++i)
      if (table().step[i] <= i_after) first = i;
    if (table().n_rows() == 0) return;
    result.loops[&output_] = summarise_loop(table(), first);
  }

 private:
  // Of side 2 against side 1; the ground is side 1 of a support.
  double displacement(const Instant& instant) const {
    if (!between_.empty()) {
      Vec3 moved = mean_over(between_.back(), instant.displacement(between_.back().part));
      if (between_.size() > 1) moved -= mean_over(between_.front(), instant.displacement(between_.front().part));
      return moved.dot(*output_.direction);
    }
    double sum = 0.0, area = 0.0;
    for (const int s : surfaces_of(instant, output_.on)) {
      const Surface& surface = (*instant.model.surfaces)[s];
      const Points u_1 = instant.displacement(surface.part_1);
      const Points u_2 = surface.part_2 >= 0 ? instant.displacement(surface.part_2) : Points();
      for (int i = 0; i < surface.n_points(); ++i) {
        Vec3 jump = -u_1.col(surface.facing.nodes_1[i]);
        if (surface.part_2 >= 0) jump += u_2.col(surface.facing.nodes_2[i]);
        sum += surface.facing.areas[i] * jump.dot(*output_.direction);
        area += surface.facing.areas[i];
      }
    }
    // A wall is side 2 of its surface, and side 1 here.
    return (is_support_ ? -sum : sum) / area;
  }

  const Problem& problem_;
  const Output& output_;
  std::vector<WeightedNodes> between_;
  bool is_support_ = false;
  double before_ = 0.0;
};

}  // namespace

std::unique_ptr<Sampler> make_loop_sampler(const Problem& problem, const Output& output) {
  return std::make_unique<LoopSampler>(problem, output);
}

}  // namespace dygita
