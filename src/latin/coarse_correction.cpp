#include "latin/coarse_correction.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "base/parallel.hpp"
#include "model/extent.hpp"
#include "partition/all_pieces.hpp"

namespace dygita {

bool needs_coarse_correction(const StepModel& model) {
  if (model.scheme.is_static) return true;
  return std::any_of(model.cut->pieces().begin(), model.cut->pieces().end(),
                     [&](const CutPiece& piece) { return crossings(*piece.body, model.scheme.dt) > 0.3; });
}

// Sides of points with several ports; those that a support holds move with it and have no coarse motion.
std::vector<CoarseCorrection::Side> CoarseCorrection::find_sides(const StepModel& model, const Vec& k) {
  std::vector<Side> sides;
  for (size_t i = 0; i < model.exchange.points.size(); ++i) {
    const Point& point = model.exchange.points[i];
    for (const auto& [first, end] :
         {std::pair{point.first_port, point.first_port_2}, std::pair{point.first_port_2, point.end_port}})
      for (int d = 0; d < 3; ++d) {
        const bool has_law = point.is_active[d] && point.has_law[d];
        Side side;
        double sum = 0.0;
        bool is_held = false;
        for (int p = first; p < end; ++p) {
          const Port& port = model.exchange.ports[p];
          is_held = is_held || port.is_held[d];
          const int unknown = model.assembled_unknown(port, d);
          if (unknown < 0) continue;
          side.push_back({unknown, p, static_cast<int>(i), d, k[unknown], !has_law});
          sum += k[unknown];
        }
        if (is_held || side.size() < 2) continue;
        for (Tied& tied : side) tied.share /= sum;
        sides.push_back(std::move(side));
      }
  }
  return sides;
}

// A rigid motion of a substructure counts at a tied node with its share of k there, so that all together move the
// assembly as one.
void CoarseCorrection::make_shapes(const StepModel& model, const Vec& k, const std::vector<Side>& sides) {
  const std::vector<Port>& ports = model.exchange.ports;
  const size_t n = model.pieces.size();
  const auto place = [&](const Tied& tied) {
    const Port& port = ports[tied.port];
    const Substructure& part = *model.cut->piece(port.piece).body;
    if (port.trace && !part.mesh->has_cells())  // a rigid face has all its points at one node
      return Vec3((*model.surfaces)[static_cast<size_t>(port.side / 2)].facing.places.col(port.point));
    return Vec3(part.mesh->nodes.col(port.piece_node) + part.place);
  };
  // Middle and reach of the tied nodes of each piece: who has it knows them all.
  std::vector<Vec3> centre(n, Vec3::Zero());
  std::vector<double> count(n, 0.0), length(n, 0.0);
  for (const Side& side : sides)
    for (const Tied& tied : side) {
      centre[ports[tied.port].piece] += place(tied);
      ++count[ports[tied.port].piece];
    }
  const std::vector<double> centres = of_all_pieces(*model.cut, 3, [&](int i, double* to) {
    Eigen::Map<Vec3>{to} = centre[static_cast<size_t>(i)] / std::max(count[static_cast<size_t>(i)], 1.0);
  });
  for (size_t i = 0; i < n; ++i) centre[i] = Eigen::Map<const Vec3>(centres.data() + 3 * i);
  for (const Side& side : sides)
    for (const Tied& tied : side) {
      double& reach = length[ports[tied.port].piece];
      reach = std::max(reach, (place(tied) - centre[ports[tied.port].piece]).norm());
    }
  length = of_all_pieces(*model.cut, 1, [&](int i, double* to) { *to = length[static_cast<size_t>(i)]; });

  struct Entry {
    int row, motion;
    double value;
  };
  std::vector<std::vector<Entry>> entries(n);
  for (const Side& side : sides)
    for (const Tied& tied : side) {
      const int own = ports[tied.port].piece;
      if (!model.cut->is_here(own)) continue;
      Local& local = pieces_[own];
      const int row = static_cast<int>(local.tied.size());
      local.tied.push_back(tied.unknown);
      local.balances.push_back(tied.balances);
      for (const Tied& other : side) {
        const int moving = ports[other.port].piece;
        const Vec3 direction = model.exchange.points[other.point].frame.col(other.direction);
        const Vec3 turn =
            ((place(other) - centre[moving]) / (length[moving] > 0.0 ? length[moving] : 1.0)).cross(direction);
        for (int a = 0; a < 3; ++a) {
          entries[own].push_back({row, 6 * moving + a, other.share * direction[a]});
          entries[own].push_back({row, 6 * moving + 3 + a, other.share * turn[a]});
        }
      }
    }
  for (const int i : model.here) {
    Local& local = pieces_[i];
    std::map<int, int> columns;
    for (const Entry& entry : entries[i]) columns[entry.motion] = 0;
    for (auto& [motion, column] : columns) {
      column = static_cast<int>(local.motions.size());
      local.motions.push_back(motion);
    }
    local.shape = Mat::Zero(local.tied.size(), local.motions.size());
    for (const Entry& entry : entries[i]) local.shape(entry.row, columns[entry.motion]) += entry.value;
    local.k.resize(local.tied.size());
    for (size_t r = 0; r < local.tied.size(); ++r) local.k[r] = local.balances[r] ? k[local.tied[r]] : 0.0;
  }
  complete_motions(*model.cut);
}

// Which coarse motions reach each piece is known everywhere.
void CoarseCorrection::complete_motions(const Cut& cut) {
  if (ranks::is_alone()) return;
  const std::vector<double> n_motions =
      of_all_pieces(cut, 1, [&](int i, double* to) { *to = static_cast<double>(pieces_[i].motions.size()); });
  const std::vector<int> sizes(n_motions.begin(), n_motions.end());
  std::vector<double> all;
  for (size_t i = 0; i < pieces_.size(); ++i) {
    pieces_[i].motions.resize(static_cast<size_t>(sizes[i]), 0);
    all.insert(all.end(), pieces_[i].motions.begin(), pieces_[i].motions.end());
  }
  segments_of(cut, sizes).complete(all.data());
  const double* motion = all.data();
  for (Local& local : pieces_)
    for (int& own : local.motions) own = static_cast<int>(*motion++);
}

Mat CoarseCorrection::respond(const Piece& piece, int offset, Local& local) {
  const int n_tied = static_cast<int>(local.tied.size());
  if (n_tied == 0) return {};
  std::vector<char> is_tied(piece.n_rows(), 0);
  for (const int unknown : local.tied) is_tied[unknown - offset] = 1;
  for (int r = 0; r < piece.n_rows(); ++r)
    if (!is_tied[r]) local.rest.push_back(offset + r);
  std::vector<int> columns;
  for (const int unknown : local.tied) columns.push_back(unknown - offset);
  const Mat compliance = piece.row_compliance(columns);
  Mat tied(n_tied, n_tied), rest(local.rest.size(), n_tied);
  for (int c = 0; c < n_tied; ++c) {
    for (int r = 0; r < n_tied; ++r) tied(r, c) = compliance(columns[r], c);
    for (size_t r = 0; r < local.rest.size(); ++r) rest(r, c) = compliance(local.rest[r] - offset, c);
  }
  local.data = tied.llt().solve(local.shape);
  local.answer = rest * local.data;
  const Mat stiffness = local.shape.transpose() * (local.data - local.k.asDiagonal() * local.shape);
  return 0.5 * (stiffness + stiffness.transpose());
}

namespace {

std::vector<const void*> operators_of(const StepModel& model) {
  std::vector<const void*> operators;
  for (const auto& piece : model.pieces) operators.push_back(piece->shared_key());
  return operators;
}

}  // namespace

bool CoarseCorrection::serves(const StepModel& model, const Vec& k) const {
  return ranks::is_alone() && k_ == k && operators_ == operators_of(model) &&
         std::find(operators_.begin(), operators_.end(), nullptr) == operators_.end() && sides_ == find_sides(model, k);
}

CoarseCorrection::CoarseCorrection(const StepModel& model, const Vec& k)
    : sides_(find_sides(model, k)), k_(k), operators_(operators_of(model)) {
  const std::vector<Side>& sides = sides_;
  if (!ranks::any(!sides.empty())) return;
  const int n = static_cast<int>(model.pieces.size());
  pieces_.resize(n);
  make_shapes(model, k, sides);
  std::vector<Mat> share(n);
  parallel_for(static_cast<int>(model.here.size()), [&](int at) {
    const int i = model.here[at];
    share[i] = respond(*model.pieces[i], model.offset[i], pieces_[i]);
  });
  complete_shares(model, share);
  here_ = model.here;
  for (int i = 0; i < n; ++i) {
    for (std::vector<int>* unknowns : {&pieces_[i].tied, &pieces_[i].rest})
      for (int& unknown : *unknowns) unknown = model.near.at(unknown);
  }
  std::vector<int> sizes;
  for (const Local& local : pieces_) sizes.push_back(static_cast<int>(local.motions.size()));
  of_amounts_ = segments_of(*model.cut, sizes);
  first_.assign(1, 0);
  for (const int n_motions : sizes) first_.push_back(first_.back() + n_motions);
  amounts_.resize(static_cast<size_t>(first_.back()));
  Mat stiffness = Mat::Zero(6 * n, 6 * n);
  for (int i = 0; i < n; ++i)
    for (int c = 0; c < share[i].cols(); ++c)
      for (int r = 0; r < share[i].rows(); ++r)
        stiffness(pieces_[i].motions[r], pieces_[i].motions[c]) += share[i](r, c);
  // Motions that are the same at all ties (of two bodies tied to nothing else) are told apart by this alone; what is
  // not tied at all is at rest.
  for (int i = 0; i < 6 * n; ++i) stiffness(i, i) = stiffness(i, i) > 0.0 ? stiffness(i, i) * (1.0 + 1e-9) : 1.0;
  factor_.compute(stiffness);
  if (factor_.info() != Eigen::Success) pieces_.clear();  // the iteration goes without
  amount_.resize(6 * n);
}

// Those of pieces elsewhere.
void CoarseCorrection::complete_shares(const StepModel& model, std::vector<Mat>& share) const {
  if (ranks::is_alone()) return;
  std::vector<int> sizes;
  Eigen::Index n = 0;
  for (size_t i = 0; i < share.size(); ++i) {
    const auto c = static_cast<Eigen::Index>(pieces_[i].motions.size());
    if (!model.cut->is_here(static_cast<int>(i))) share[i].resize(c, c);
    sizes.push_back(static_cast<int>(c * c));
    n += c * c;
  }
  Vec all(n);
  n = 0;
  for (const Mat& own : share) all.segment(n, own.size()) = own.reshaped(), n += own.size();
  segments_of(*model.cut, sizes).complete(all.data());
  n = 0;
  for (Mat& own : share) own.reshaped() = all.segment(n, own.size()), n += own.size();
}

void CoarseCorrection::correct(Vec& q, Vec& velocity) {
  for (const int i : here_) {
    Local& local = pieces_[i];
    local.force.resize(local.tied.size());
    for (size_t r = 0; r < local.tied.size(); ++r)
      local.force[r] = local.balances[r] ? q[local.tied[r]] - local.k[r] * velocity[local.tied[r]] : 0.0;
    local.amount.noalias() = local.shape.transpose() * local.force;
    std::copy(local.amount.begin(), local.amount.end(), amounts_.begin() + first_[i]);
  }
  of_amounts_.complete(amounts_.data());
  amount_.setZero();
  for (size_t i = 0; i < pieces_.size(); ++i)
    for (size_t c = 0; c < pieces_[i].motions.size(); ++c) amount_[pieces_[i].motions[c]] -= amounts_[first_[i] + c];
  factor_.solveInPlace(amount_);
  const auto add = [](Local& local, const Mat& columns, const std::vector<int>& unknowns, Vec& to) {
    local.change.noalias() = columns * local.amount;
    for (size_t r = 0; r < unknowns.size(); ++r) to[unknowns[r]] += local.change[r];
  };
  for (const int i : here_) {
    Local& local = pieces_[i];
    if (local.data.size() == 0) continue;  // not tied
    for (size_t c = 0; c < local.motions.size(); ++c) local.amount[c] = amount_[local.motions[c]];
    add(local, local.data, local.tied, q);
    add(local, local.shape, local.tied, velocity);
    add(local, local.answer, local.rest, velocity);
  }
}

}  // namespace dygita
