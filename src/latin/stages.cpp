#include "latin/stages.hpp"

#include "step/joint_solves.hpp"

namespace dygita {

Stages::Stages(StepData& step, const Vec& k)
    : step_(step), turns_(step.loops.in_turn(step.model.near.border_pieces())) {
  if (step.settings.is_assembled) system_.emplace(step.model, step.local, k, step.settings.assembly_size);
}

void Stages::linear_stage(const Vec& q, Vec& velocity, bool is_sent, bool in_half) {
  const Stopwatch watch(step_.seconds.interface);
  if (system_) return system_->linear_stage(q, velocity);
  if (joint::is_joint()) return joint::interface_velocities(step_.model, q, velocity);  // all pieces are here
  const NearUnknowns& near = step_.model.near;
  const auto answer = [&](Piece& piece, int i) {
    const auto data = q.segment(near.start(i), piece.n_rows());
    auto to = velocity.segment(near.start(i), piece.n_rows());
    in_half ? piece.interface_velocity_in_half(data, to) : piece.interface_velocity(data, to);
  };
  step_.loops.for_each(turns_.border, answer);
  if (is_sent) step_.model.near.begin({q.data(), velocity.data()});
  step_.loops.for_each(turns_.interior, answer);
}

IndicatorSums Stages::local_stage(Vec& velocity, Vec& q, Vec& image, bool is_sent, Anderson* also) {
  const Stopwatch watch(step_.seconds.local);
  LocalStage& local = step_.local;
  if (!is_sent) step_.model.near.begin({q.data(), velocity.data()});
  local.run_inner(velocity, q, image);
  step_.model.near.end({q.data(), velocity.data()});
  local.run_outer(velocity, q, image);
  if (!also) return local.measure(velocity, q, image);
  const InterfaceSums::ToCome first = also->first_sums(step_.own(q), step_.own(image));
  return local.measure(velocity, q, image, first, [&](const double* sums) { also->take_first_sums(sums, first.n); });
}

void Stages::answer() {
  Iterate& at = step_.at;
  linear_stage(at.q, at.velocity, true);
  at.sums = local_stage(at.velocity, at.q, at.image, true);
}

std::vector<double> Stages::begin_pieces(int increment) {
  const Stopwatch watch(step_.seconds.forward);
  StepModel& model = step_.model;
  const std::vector<double> motions = model.motion_velocities(increment);
  model.loads->evaluate(increment);
  const StepSettings& settings = step_.settings;
  const double quiet = step_.indicator.quiet(settings.more_iterations > 0 ? settings.round_off : settings.tolerance);
  const bool is_joint = joint::is_joint();
  step_.loops.for_each_group([&](const std::vector<Piece*>& group, const std::vector<int>& members) {
    for (const int i : members) model.pieces[i]->begin(model.piece_force(i, step_.files.state), motions, quiet);
    if (!is_joint) group.front()->forward(group);
  });
  if (is_joint) joint::forward(model);
  return motions;
}

void Stages::begin_increment(int increment, bool starts_window) {
  const std::vector<double> motions = begin_pieces(increment);
  const Stopwatch watch(step_.seconds.forward);
  step_.local.begin(increment, motions, starts_window);
  if (step_.model.scheme.is_static) step_.indicator.start_displaced(step_.local.displacement_size());
}

void Stages::finish_increment(const Vec& found) {
  const Stopwatch watch(step_.seconds.backward);
  const Vec balanced = system_ ? system_->finish(step_.at.velocity, found) : Vec();
  const Vec& q = system_ ? balanced : found;
  const bool is_joint = joint::is_joint();
  if (is_joint) joint::backward(step_.model);
  step_.loops.for_each_group([&](const std::vector<Piece*>& group, const std::vector<int>& members) {
    if (!is_joint) group.front()->backward(group);
    for (const int i : members) {
      Piece& piece = *step_.model.pieces[i];
      const Points held = piece.has_motions() ? step_.local.held_force(i) : Points();
      step_.energy[i] =
          piece.finish(q.segment(step_.model.near.start(i), piece.n_rows()), piece.has_motions() ? &held : nullptr);
    }
  });
}

}  // namespace dygita
