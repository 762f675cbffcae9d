#include "watch/rotation_watch.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fem/cell_rotation.hpp"
#include "partition/all_pieces.hpp"
#include "result/limits.hpp"
#include "watch/motion_watch.hpp"

namespace dygita {

namespace {

constexpr double degree = std::numbers::pi / 180.0, allowed = limit::rotation * degree;

}  // namespace

void RotationWatch::begin_step(const Instant& start) {
  if (cut_) return;
  cut_ = start.model.cut;
  pieces_.resize(static_cast<size_t>(cut_->n_pieces()));
  for (int i = 0; i < cut_->n_pieces(); ++i)
    smallest_cell_.push_back(cut_->is_here(i) ? smallest_cell(*cut_->piece(i).body->mesh) : 0.0);
}

// Cells turn no more than displacements differ over the smallest of them.
void RotationWatch::accept(const Instant& instant) {
  if (!shows_motion(instant)) return;
  const int now = static_cast<int>(moments_.size());
  moments_.push_back(time_of(instant));
  for (int i = 0; i < cut_->n_pieces(); ++i) {
    if (!cut_->is_here(i)) continue;
    const Points displacement = instant.piece_displacement(i);
    const Vec3 range = displacement.rowwise().maxCoeff() - displacement.rowwise().minCoeff();
    Finding& worst = pieces_[static_cast<size_t>(i)];
    if (range.norm() <
        std::max(1.0, worst.angle / allowed) * std::tan(allowed) * smallest_cell_[static_cast<size_t>(i)])
      continue;
    const Substructure& body = *cut_->piece(i).body;
    const CellRotation turned = largest_rotation(*body.mesh, displacement);
    if (!(turned.angle > worst.angle)) continue;
    const bool is_first = worst.first < 0 && turned.angle > allowed;
    worst = {turned.angle, turned.place + body.place, now, is_first ? now : worst.first};
  }
}

void RotationWatch::settle() {
  if (!cut_) return;
  constexpr int n = 6;
  const std::vector<double> all = of_all_pieces(*cut_, n, [&](int i, double* to) {
    const Finding& own = pieces_[static_cast<size_t>(i)];
    const double numbers[n] = {own.angle,
                               own.place[0],
                               own.place[1],
                               own.place[2],
                               static_cast<double>(own.at),
                               static_cast<double>(own.first)};
    std::copy_n(numbers, n, to);
  });
  parts_.clear();
  for (int i = 0; i < cut_->n_pieces(); ++i) {
    const double* of = all.data() + n * i;
    const size_t part = static_cast<size_t>(cut_->piece(i).part);
    if (part >= parts_.size()) parts_.resize(part + 1);
    Finding& worst = parts_[part];
    const int first = static_cast<int>(of[5]);
    if (first >= 0) worst.first = worst.first < 0 ? first : std::min(worst.first, first);
    if (of[0] > worst.angle) worst = {of[0], {of[1], of[2], of[3]}, static_cast<int>(of[4]), worst.first};
  }
}

void RotationWatch::finish(const Problem& problem, RunResult& result) const {
  double turned = 0.0;
  for (size_t part = 0; part < parts_.size(); ++part) {
    const Finding& r = parts_[part];
    turned = std::max(turned, r.angle / degree);
    if (r.angle <= allowed) continue;
    result.warnings.push_back(fmt::format(
        "substructure '{}' turns by {:.3g} degrees at {}, {}{}: displacements are assumed small, which is valid to "
        "about {:g} degrees",
        problem.substructures[part]->name, r.angle / degree, in_mm(r.place), moments_[static_cast<size_t>(r.at)],
        r.first == r.at ? "" : "; too large since " + moments_[static_cast<size_t>(r.first)], limit::rotation));
  }
  if (turned > limit::rotation) result.figures.largest_rotation = turned;
}

}  // namespace dygita
