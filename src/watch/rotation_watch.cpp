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
    smallest_cell_.push_back(cut_->is_here(i) ? gradient_length(*cut_->piece(i).body->mesh) : 0.0);
}

// Where displacements differ by too little for any gradient that would be noted, none is computed.
void RotationWatch::accept(const Instant& instant) {
  if (!shows_motion(instant)) return;
  const int now = static_cast<int>(moments_.size());
  moments_.push_back(time_of(instant));
  for (int i = 0; i < cut_->n_pieces(); ++i) {
    if (!cut_->is_here(i)) continue;
    const Points displacement = instant.piece_displacement(i);
    const Vec3 range = displacement.rowwise().maxCoeff() - displacement.rowwise().minCoeff();
    Findings& worst = pieces_[static_cast<size_t>(i)];
    const double gradient = std::min(std::max(1.0, worst.turned.value / allowed) * std::tan(allowed),
                                     std::max(limit::strain, worst.strained.value));
    const double least = gradient * smallest_cell_[static_cast<size_t>(i)];
    if (range.norm() < least) continue;
    const Substructure& body = *cut_->piece(i).body;
    const CellDeformation found = largest_deformation(*body.mesh, displacement, least);
    const auto note = [&](const CellExtreme& now_is, double most, Finding& finding) {
      if (!(now_is.value > finding.value)) return;
      const bool is_first = finding.first < 0 && now_is.value > most;
      finding = {now_is.value, now_is.place + body.place, now, is_first ? now : finding.first};
    };
    note(found.rotation, allowed, worst.turned);
    note(found.strain, limit::strain, worst.strained);
  }
}

void RotationWatch::write(const Finding& finding, double* to) {
  const double numbers[n_numbers] = {finding.value,
                                     finding.place[0],
                                     finding.place[1],
                                     finding.place[2],
                                     static_cast<double>(finding.at),
                                     static_cast<double>(finding.first)};
  std::copy_n(numbers, n_numbers, to);
}

void RotationWatch::take(const double* from, Finding& worst) {
  const int first = static_cast<int>(from[5]);
  if (first >= 0) worst.first = worst.first < 0 ? first : std::min(worst.first, first);
  if (from[0] > worst.value) worst = {from[0], {from[1], from[2], from[3]}, static_cast<int>(from[4]), worst.first};
}

void RotationWatch::settle() {
  if (!cut_) return;
  constexpr int n = 2 * n_numbers;
  const std::vector<double> all = of_all_pieces(*cut_, n, [&](int i, double* to) {
    write(pieces_[static_cast<size_t>(i)].turned, to);
    write(pieces_[static_cast<size_t>(i)].strained, to + n_numbers);
  });
  parts_.clear();
  for (int i = 0; i < cut_->n_pieces(); ++i) {
    const size_t part = static_cast<size_t>(cut_->piece(i).part);
    if (part >= parts_.size()) parts_.resize(part + 1);
    take(all.data() + n * i, parts_[part].turned);
    take(all.data() + n * i + n_numbers, parts_[part].strained);
  }
}

std::string RotationWatch::told(const Substructure& part, const Finding& finding, const std::string& what) const {
  return fmt::format(
      "substructure '{}' {} at {}, {}{}", part.name, what, in_mm(finding.place),
      moments_[static_cast<size_t>(finding.at)],
      finding.first == finding.at ? "" : "; too large since " + moments_[static_cast<size_t>(finding.first)]);
}

void RotationWatch::finish(const Problem& problem, RunResult& result) const {
  double turned = 0.0;
  for (size_t i = 0; i < parts_.size(); ++i) {
    const auto& [turn, strain] = parts_[i];
    const Substructure& part = *problem.substructures[i];
    turned = std::max(turned, turn.value / degree);
    if (turn.value > allowed)
      result.warnings.push_back(
          told(part, turn, fmt::format("turns by {:.3g} degrees", turn.value / degree)) +
          fmt::format(": displacements are assumed small, which is valid to about {:g} degrees", limit::rotation));
    if (strain.value > limit::strain)
      result.warnings.push_back(
          told(part, strain, fmt::format("is strained by {:.3g} %", 100.0 * strain.value)) +
          fmt::format(": strains are assumed small, which is valid to some {:g} %; was a unit of a "
                      "load or a modulus the wrong one?",
                      100.0 * limit::strain));
  }
  if (turned > limit::rotation) result.figures.largest_rotation = turned;
}

}  // namespace dygita
