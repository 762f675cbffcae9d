#include "reference/merged_assembly.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <map>

#include "numerics/spd_inverse.hpp"
#include "step/shared_operators.hpp"

namespace dygita {

namespace {

// Dense matrices of this many rows take about 3 GB in all.
constexpr int most_rows = 6000;
// Share of the diagonal of K that stands in for the laws while a static system is factorised.
constexpr double reference_share = 0.1;

using Triplets = std::vector<Eigen::Triplet<double>>;

SparseMatrix sparse(int n_rows, int n_columns, const Triplets& entries) {
  SparseMatrix matrix(n_rows, n_columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// To the last bit.
bool are_equal(const SparseMatrix& a, const SparseMatrix& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && a.nonZeros() == b.nonZeros() &&
         std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.outerSize() + 1, b.outerIndexPtr()) &&
         std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr()) &&
         std::equal(a.valuePtr(), a.valuePtr() + a.nonZeros(), b.valuePtr());
}

// H = (S + G^T R G)^-1 and W = G H G^T, with S the Schur complement of the assembly without the reference.
void make_compliance(const Vec& reference, const std::string& what, AssemblyFactor& made) {
  const SparseMatrix& rows = made.g_of_unknowns;
  Factor& factor = *made.factor;
  const int n_rows = static_cast<int>(rows.rows()), n_interior = factor.n_interior(), n = factor.n_interface();
  made.softening = Vec::Zero(n_rows);
  Triplets entries;
  for (int i = 0; i < n_rows; ++i)
    for (SparseMatrix::InnerIterator entry(rows, i); entry; ++entry) {
      entries.emplace_back(i, made.position[entry.col()] - n_interior, entry.value());
      made.softening[i] += 0.5 * entry.value() * entry.value() * reference[entry.col()];
    }
  made.g = sparse(n_rows, n, entries);
  if (n == 0) return;
  Mat schur = factor.take_schur();
  for (int i = 0; i < n; ++i) schur(i, i) -= reference[factor.order()[n_interior + i]];
  for (int i = 0; i < n_rows; ++i)
    for (SparseMatrix::InnerIterator r(made.g, i); r; ++r)
      for (SparseMatrix::InnerIterator c(made.g, i); c; ++c)
        schur(r.col(), c.col()) += made.softening[i] * r.value() * c.value();
  made.inverse = inverse_spd(std::move(schur), what);
  mirror_lower(made.inverse);
  const Mat half = made.g * made.inverse;
  made.compliance = (made.g * Mat(half.transpose())).transpose();
}

}  // namespace

MergedAssembly::MergedAssembly(const StepModel& model, std::shared_ptr<const AssemblyFactor> before) : model_(&model) {
  for (size_t i = 0; i < model.pieces.size(); ++i) pieces_.push_back(&assembled_piece(model, static_cast<int>(i)));
  make_groups();
  number_unknowns();
  make_maps();
  made_ = factorise(make_rows(), before);
}

// A node of its own for every node of every substructure, but one for all copies that are tied.
void MergedAssembly::make_groups() {
  for (const AssembledPiece* piece : pieces_) node_of_.emplace_back(piece->op().unknowns().n_nodes(), -1);
  for (const Point& point : model_->exchange.points)
    for (const auto& [first, end] :
         {std::pair{point.first_port, point.first_port_2}, std::pair{point.first_port_2, point.end_port}}) {
      if (end - first < 2) continue;
      Node node;
      node.frame = point.frame;
      for (int p = first; p < end; ++p) {
        node.group.push_back(p);
        node_of_[model_->exchange.ports[p].part][model_->exchange.ports[p].node] = static_cast<int>(nodes_.size());
      }
      nodes_.push_back(std::move(node));
    }
}

void MergedAssembly::number_unknowns() {
  for (size_t part = 0; part < node_of_.size(); ++part)
    for (size_t i = 0; i < node_of_[part].size(); ++i) {
      int& index = node_of_[part][i];
      if (index < 0) {
        index = static_cast<int>(nodes_.size());
        nodes_.emplace_back();
      }
      Node& node = nodes_[index];
      if (node.first >= 0) continue;
      node.first = n_;
      if (node.group.empty()) {
        const FreeUnknowns& unknowns = pieces_[part]->op().unknowns();
        node.basis = unknowns.basis(static_cast<int>(i));
        node.n = unknowns.count(static_cast<int>(i));
      } else {
        for (int d = 0; d < 3; ++d)
          if (std::none_of(node.group.begin(), node.group.end(),
                           [&](int p) { return model_->exchange.ports[p].is_held[d]; }))
            node.basis.col(node.n++) = node.frame.col(d);
      }
      n_ += node.n;
      node_of_unknown_.insert(node_of_unknown_.end(), node.n, index);
    }
}

void MergedAssembly::make_maps() {
  for (size_t part = 0; part < node_of_.size(); ++part) {
    const FreeUnknowns& unknowns = pieces_[part]->op().unknowns();
    Triplets entries;
    for (int i = 0; i < static_cast<int>(node_of_[part].size()); ++i) {
      const Node& n = node(static_cast<int>(part), i);
      const Mat3 basis = unknowns.basis(i);
      for (int a = 0; a < unknowns.count(i); ++a)
        for (int b = 0; b < n.n; ++b)
          if (const double value = basis.col(a).dot(n.basis.col(b)); std::abs(value) > 1e-12)
            entries.emplace_back(unknowns.first(i) + a, n.first + b, value);
    }
    map_.push_back(sparse(unknowns.size(), n_, entries));
    matrix_.push_back(pieces_[part]->matrix());
    prescribed_.emplace_back(Vec::Zero(unknowns.size()));
    velocity_.emplace_back(Vec::Zero(unknowns.size()));
  }
}

// The law rows and G on the global unknowns: side 2 less side 1, along the directions of the point's frame.
SparseMatrix MergedAssembly::make_rows() {
  Triplets entries;
  int n_rows = 0;
  for (const Point& point : model_->exchange.points) {
    std::array<int, 3>& rows = rows_.emplace_back(std::array{-1, -1, -1});
    for (int d = 0; d < 3; ++d) {
      if (!point.has_law[d] || !point.is_active[d]) continue;
      std::map<int, double> jump;
      const auto add = [&](const Port& port, double sign) {
        port.for_each_node([&](int at, const Mat3& block) {
          const Node& n = node(port.part, at);
          for (int b = 0; b < n.n; ++b) jump[n.first + b] += sign * (block * n.basis.col(b)).dot(point.frame.col(d));
        });
      };
      add(model_->exchange.ports[point.first_port], -1.0);
      if (!point.is_wall) add(model_->exchange.ports[point.first_port_2], 1.0);
      std::erase_if(jump, [](const auto& entry) { return std::abs(entry.second) < 1e-9; });
      if (jump.empty()) continue;
      for (const auto& [unknown, value] : jump) entries.emplace_back(n_rows, unknown, value);
      rows[d] = n_rows++;
    }
  }
  if (n_rows > most_rows)
    throw InputError(
        model_->step->origin,
        fmt::format(
            "step '{}': solver.monolithic stores dense matrices of the unknowns of contact, plastic, shortened and "
            "released interfaces: there are {}, at most {} are allowed; use solver.latin, or a coarser mesh there",
            model_->step->name, n_rows, most_rows));
  held_rate_ = free_rate_ = Vec::Zero(n_rows);
  return sparse(n_rows, n_, entries);
}

SparseMatrix MergedAssembly::whole_matrix() const {
  SparseMatrix a(n_, n_);
  for (size_t part = 0; part < matrix_.size(); ++part) {
    const SparseMatrix transposed = map_[part].transpose();
    const SparseMatrix merged = matrix_[part] * map_[part];
    a += SparseMatrix(transposed * merged);
  }
  return a;
}

// N/m: what stands in for that of a body without cells, whose own is zero.
double MergedAssembly::usual_stiffness() const {
  double sum = 0.0, of_laws = 0.0;
  int n = 0;
  for (const SparseMatrix& matrix : matrix_)
    for (const double entry : matrix.diagonal().eval())
      if (entry > 0.0) sum += entry, ++n;
  if (n > 0) return sum / n;
  for (const Vec3& spring : law_springs(*model_)) of_laws = std::max(of_laws, spring.maxCoeff());
  return of_laws;
}

std::shared_ptr<const AssemblyFactor> MergedAssembly::factorise(
    SparseMatrix rows, const std::shared_ptr<const AssemblyFactor>& before) const {
  auto made = std::make_shared<AssemblyFactor>();
  made->matrix = whole_matrix();
  made->g_of_unknowns = std::move(rows);
  if (before && are_equal(before->matrix, made->matrix) && are_equal(before->g_of_unknowns, made->g_of_unknowns))
    return before;
  std::vector<char> is_interface(n_, 0);
  for (int i = 0; i < made->g_of_unknowns.outerSize(); ++i)
    for (SparseMatrix::InnerIterator entry(made->g_of_unknowns, i); entry; ++entry) is_interface[entry.col()] = 1;
  Vec reference = Vec::Zero(n_);
  SparseMatrix held = made->matrix;
  const double of_rigid = usual_stiffness();
  for (int i = 0; i < n_; ++i)
    if (is_interface[i] && model_->scheme.is_static) {
      double& diagonal = held.coeffRef(i, i);
      reference[i] = reference_share * (diagonal > 0.0 ? diagonal : of_rigid);
      diagonal += reference[i];
    }
  const std::string what = "the assembly in step '" + model_->step->name + "'";
  made->factor = std::make_unique<Factor>(held, node_of_unknown_, is_interface, what);
  made->position.resize(n_);
  for (int i = 0; i < n_; ++i) made->position[made->factor->order()[i]] = i;
  make_compliance(reference, what, *made);
  return made;
}

// What supports and prescribed motions give a node.
Vec3 MergedAssembly::held_velocity(int part, int i, const std::vector<double>& motions) const {
  Vec3 velocity = Vec3::Zero();
  const Node& n = node(part, i);
  if (n.group.empty()) {
    if (const Held* held = model_->conditions.at(part, i))
      for (int j = 0; j < held->n; ++j)
        for (const auto& [motion, factor] : held->motion[j])
          velocity += factor * motions[motion] * held->directions.col(j);
    return velocity;
  }
  for (int d = 0; d < 3; ++d)
    for (const int p : n.group)
      if (const Port& port = model_->exchange.ports[p]; port.is_held[d]) {
        velocity += model_->held_velocity(port, n.frame.col(d), motions) * n.frame.col(d);
        break;
      }
  return velocity;
}

Vec3 MergedAssembly::held_velocity(const Port& port, const std::vector<double>& motions) const {
  Vec3 velocity = Vec3::Zero();
  port.for_each_node([&](int at, const Mat3& block) { velocity += block * held_velocity(port.part, at, motions); });
  return velocity;
}

// What the shared unknowns do not say of a tied copy: motions of another copy's support, and the rate that closes a
// jump between copies (bodies tied while they move apart).
void MergedAssembly::prescribe(const std::vector<double>& motions, const std::vector<Points>& displacement) {
  for (const Node& n : nodes_) {
    if (n.group.empty()) continue;
    const auto displacement_of = [&](int p) -> Vec3 {
      return displacement[model_->exchange.ports[p].part].col(model_->exchange.ports[p].node);
    };
    const Port& any = model_->exchange.ports[n.group.front()];
    const Vec3 held = held_velocity(any.part, any.node, motions);
    Vec3 place = Vec3::Zero();
    for (int d = 0; d < 3; ++d) {
      double sum = 0.0;
      const int* holder = nullptr;
      for (const int& p : n.group) {
        sum += n.frame.col(d).dot(displacement_of(p));
        if (model_->exchange.ports[p].is_held[d]) holder = &p;
      }
      place += (holder ? n.frame.col(d).dot(displacement_of(*holder)) : sum / static_cast<double>(n.group.size())) *
               n.frame.col(d);
    }
    for (const int p : n.group) {
      const Port& port = model_->exchange.ports[p];
      Vec3 offset = displacement_of(p) - place;
      if (offset.norm() <= 1e-12 * place.norm()) offset.setZero();
      const FreeUnknowns& unknowns = pieces_[port.part]->op().unknowns();
      for (int a = 0; a < unknowns.count(port.node); ++a)
        prescribed_[port.part][unknowns.first(port.node) + a] =
            unknowns.basis(port.node).col(a).dot(held - offset / model_->scheme.dt);
    }
  }
}

void MergedAssembly::begin(const std::vector<double>& motions, const std::vector<Points>& displacement) {
  prescribe(motions, displacement);
  Vec sum = Vec::Zero(n_);
  for (size_t part = 0; part < map_.size(); ++part) {
    Vec rhs = pieces_[part]->right_hand_side();
    if (!prescribed_[part].isZero(0.0)) rhs -= matrix_[part] * prescribed_[part];
    sum += map_[part].transpose() * rhs;
  }
  rhs_.resize(n_);
  for (int i = 0; i < n_; ++i) rhs_[made_->position[i]] = sum[i];
  made_->factor->forward(rhs_);
  for (size_t i = 0; i < rows_.size(); ++i) {
    const Point& point = model_->exchange.points[i];
    for (int d = 0; d < 3; ++d) {
      if (rows_[i][d] < 0) continue;
      const Port& port_1 = model_->exchange.ports[point.first_port];
      Vec3 rate = -held_velocity(port_1, motions);
      if (!point.is_wall) rate += held_velocity(model_->exchange.ports[point.first_port_2], motions);
      held_rate_[rows_[i][d]] = point.frame.col(d).dot(rate);
    }
  }
  free_rate_ = held_rate_;
  const int n_interface = made_->factor->n_interface();
  if (n_interface == 0) return;
  Vec velocity(n_interface);
  multiply_symmetric(made_->inverse, rhs_.tail(n_interface), velocity);
  free_rate_ += made_->g * velocity;
}

void MergedAssembly::finish(const Vec& reduced_force) {
  Vec solved = rhs_;
  if (const int n_interface = made_->factor->n_interface(); n_interface > 0) {
    const Vec rhs = rhs_.tail(n_interface) - made_->g.transpose() * reduced_force;
    Vec velocity(n_interface);
    multiply_symmetric(made_->inverse, rhs, velocity);
    solved.tail(n_interface) = velocity;
  }
  made_->factor->backward(solved);
  Vec z(n_);
  for (int i = 0; i < n_; ++i) z[i] = solved[made_->position[i]];
  for (size_t part = 0; part < map_.size(); ++part) {
    velocity_[part] = map_[part] * z + prescribed_[part];
    pieces_[part]->set_velocity(velocity_[part]);
  }
}

// Force that the other substructures and the laws must put on a node for its substructure's own equation to hold.
Vec3 MergedAssembly::residual_force(const Port& port) const {
  const AssembledPiece& piece = *pieces_[port.part];
  const FreeUnknowns& unknowns = piece.op().unknowns();
  const Mat3 basis = unknowns.basis(port.node);
  Vec3 force = Vec3::Zero();
  for (int a = 0; a < unknowns.count(port.node); ++a) {
    const int i = unknowns.first(port.node) + a;
    force += (matrix_[port.part].row(i).dot(velocity_[port.part]) - piece.right_hand_side()[i]) * basis.col(a);
  }
  return force;
}

std::vector<Vec3> MergedAssembly::port_forces(const std::vector<Vec3>& point_force) const {
  const Exchange& exchange = model_->exchange;
  std::vector<Vec3> forces(exchange.ports.size(), Vec3::Zero());
  std::map<std::pair<int, int>, Vec3> of_laws;  // on nodes of groups that are under several laws, global axes
  for (size_t i = 0; i < exchange.points.size(); ++i) {
    const Point& point = exchange.points[i];
    for (const int side : {1, 2}) {
      const int first = side == 1 ? point.first_port : point.first_port_2;
      const int end = side == 1 ? point.first_port_2 : point.end_port;
      if (end - first != 1) continue;
      forces[first] = side == 1 ? point_force[i] : Vec3(-point_force[i]);
      const Port& port = exchange.ports[first];
      port.for_each_node([&](int at, const Mat3& block) {
        const auto [it, is_new] = of_laws.emplace(std::pair{port.part, at}, Vec3::Zero());
        it->second += block.transpose() * (point.frame * forces[first]);
      });
    }
  }
  for (size_t i = 0; i < exchange.points.size(); ++i) {
    const Point& point = exchange.points[i];
    for (const int side : {1, 2}) {
      const int first = side == 1 ? point.first_port : point.first_port_2;
      const int end = side == 1 ? point.first_port_2 : point.end_port;
      if (end - first < 2) continue;
      Vec3 left = side == 1 ? point_force[i] : Vec3(-point_force[i]);
      for (int p = first; p < end; ++p) {
        const Port& port = exchange.ports[p];
        Vec3 force = residual_force(port);
        if (const auto it = of_laws.find({port.part, port.node}); it != of_laws.end()) force -= it->second;
        forces[p] = point.frame.transpose() * force;
        for (int d = 0; d < 3; ++d) {
          if (port.is_held[d]) forces[p][d] = 0.0;
          left[d] -= forces[p][d];
        }
      }
      // What a held copy takes.
      for (int d = 0; d < 3; ++d)
        for (int p = end - 1; p >= first; --p)
          if (exchange.ports[p].is_held[d]) {
            forces[p][d] = left[d];
            break;
          }
    }
  }
  return forces;
}

double MergedAssembly::bytes() const {
  return made_->factor->bytes() + 8.0 * static_cast<double>(made_->inverse.size() + made_->compliance.size());
}

}  // namespace dygita
