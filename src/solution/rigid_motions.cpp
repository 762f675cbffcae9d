#include "solution/rigid_motions.hpp"

#include <spdlog/fmt/fmt.h>

#include <map>
#include <set>

#include "base/log.hpp"
#include "law/law.hpp"
#include "numerics/pairs_below.hpp"
#include "solution/rigid_frame.hpp"

namespace dygita {

namespace {

std::string describe(const RigidMotion& motion) {
  const char* names[] = {"translation along x", "translation along y", "translation along z",
                         "rotation about x",    "rotation about y",    "rotation about z"};
  int largest = 0;
  motion.cwiseAbs().maxCoeff(&largest);
  return names[largest];
}

// Blocks of 6 x 6, of each body and of each two that a constraint joins.
using Blocks = std::map<std::pair<int, int>, Eigen::Matrix<double, 6, 6>>;

// Sum of squares of all constraints on the rigid motions of all substructures: 6 n x 6 n.
Blocks constraint_gram(const Problem& problem, const Exchange& exchange, const Conditions& conditions,
                       const std::vector<RigidFrame>& frames) {
  const int n = static_cast<int>(frames.size());
  Blocks gram;
  const auto block = [&gram](int i, int j) -> Eigen::Matrix<double, 6, 6>& {
    return gram.try_emplace({i, j}, Eigen::Matrix<double, 6, 6>::Zero()).first->second;
  };
  for (int part = 0; part < n; ++part) block(part, part);
  for (int part = 0; part < n; ++part) {
    const auto resisted = frames[part].resisted(*problem.substructures[part]);
    block(part, part) += resisted * resisted.transpose();
  }
  for (int part = 0; part < n; ++part)
    for (const auto& [node, held] : conditions.held[part])
      for (int j = 0; j < held.n; ++j) {
        const RigidMotion r = frames[part].row(*problem.substructures[part], node, held.directions.col(j));
        block(part, part) += r * r.transpose();
      }
  for (const Point& point : exchange.points) {
    const auto row_of = [&](int p, int d) {
      const Port& port = exchange.ports[p];
      return frames[port.part].row(*problem.substructures[port.part], port, point.frame.col(d));
    };
    const auto tie = [&](int p, int other, int d) {
      const RigidMotion a = row_of(p, d);
      const int i = exchange.ports[p].part;
      block(i, i) += a * a.transpose();
      if (other < 0) return;
      const RigidMotion b = row_of(other, d);
      const int j = exchange.ports[other].part;
      block(j, j) += b * b.transpose();
      block(i, j) -= a * b.transpose();
      block(j, i) -= b * a.transpose();
    };
    for (int d = 0; d < 3; ++d) {
      for (int p = point.first_port + 1; p < point.first_port_2; ++p) tie(p, point.first_port, d);
      for (int p = point.first_port_2 + 1; p < point.end_port; ++p) tie(p, point.first_port_2, d);
      if (!point.has_law[d]) continue;
      tie(point.first_port, point.is_wall ? -1 : point.first_port_2, d);
    }
  }
  return gram;
}

SparseMatrix scaled(const Blocks& gram, const Vec& weight) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& [at, block] : gram)
    for (int a = 0; a < 6; ++a)
      for (int b = 0; b < 6; ++b) {
        const int i = 6 * at.first + a, j = 6 * at.second + b;
        entries.emplace_back(i, j, weight[i] * block(a, b) * weight[j]);
      }
  const auto size = static_cast<int>(weight.size());
  SparseMatrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

// Interfaces of a part that carry nothing in a static step: "; interface 'gasket' does not in a static step".
std::string what_lets_go(const Problem& problem, const Substructure& part) {
  for (const InterfacePtr& interface : problem.interfaces)
    if ((interface->side_1.part.get() == &part || interface->side_2.part.get() == &part) &&
        !interface->law->takes_part(true))
      return ": interface." + interface->law->word() + " '" + interface->name + "' carries nothing in a static step";
  return "";
}

// What nothing resists and nothing loads, a line for each part.
void warn_of_unconstrained(const Problem& problem, const Step& step,
                           const std::map<int, std::vector<std::string>>& motions) {
  for (const auto& [part, all] : motions) {
    const std::string& name = problem.substructures[static_cast<size_t>(part)]->name;
    if (all.size() >= 6) {
      warn(
          fmt::format("static step '{}': substructure '{}' is unconstrained, no support and no interface holds it{}; "
                      "nothing loads it, it is left at zero",
                      step.name, name, what_lets_go(problem, *problem.substructures[static_cast<size_t>(part)])));
      continue;
    }
    const std::set<std::string> each(all.begin(), all.end());
    std::string text;
    for (const std::string& motion : each) text += (text.empty() ? "" : " and ") + motion;
    warn(fmt::format("static step '{}': {} of substructure '{}' {} unconstrained; nothing loads it, it is left at zero",
                     step.name, text, name, each.size() == 1 ? "is" : "are"));
  }
}

}  // namespace

bool is_floating(const Substructure& part, const std::unordered_map<int, Held>& held) {
  const RigidFrame frame(extent_of(part));
  Eigen::Matrix<double, 6, 6> gram = Eigen::Matrix<double, 6, 6>::Zero();
  double scale = 0.0;
  for (const auto& [node, conditions] : held)
    for (int j = 0; j < conditions.n; ++j) {
      const RigidMotion r = frame.row(part, node, conditions.directions.col(j));
      gram += r * r.transpose();
      scale += 1.0;
    }
  const auto resisted = frame.resisted(part);
  gram += resisted * resisted.transpose();
  scale += static_cast<double>(resisted.cols());
  if (scale == 0.0) return true;
  return symmetric_eigen(gram).values[0] < 1e-8 * scale;
}

void pin_free_motions(const Problem& problem, const Step& step, const Exchange& exchange,
                      const std::vector<Points>& force, Conditions& conditions) {
  const int n = static_cast<int>(problem.substructures.size());
  std::vector<RigidFrame> frames;
  for (const SubstructurePtr& part : problem.substructures) frames.emplace_back(extent_of(*part));
  const Blocks gram = constraint_gram(problem, exchange, conditions, frames);
  // Each body's scale: how often it is constrained; a motion nothing resists has a vanishing eigenvalue.
  Vec weight(6 * n);
  for (int i = 0; i < n; ++i)
    weight.segment<6>(6 * i).setConstant(1.0 / std::sqrt(std::max(1.0, gram.at({i, i}).trace())));
  const EigenPairs eigen = pairs_below(scaled(gram, weight), 1e-9);
  std::set<std::pair<int, int>> on_interface;
  for (const Port& port : exchange.ports)
    port.for_each_node([&](int node, const Mat3&) { on_interface.emplace(port.part, node); });

  std::map<int, std::vector<std::string>> unconstrained;  // by part
  std::vector<Vec> free_motions;
  for (Eigen::Index m = 0; m < eigen.values.size(); ++m)
    free_motions.push_back(weight.cwiseProduct(eigen.vectors.col(m)));
  while (!free_motions.empty()) {
    // The part that moves most, and where it moves most away from interfaces and supports.
    Vec& motion = free_motions.back();
    int part = 0;
    double largest = 0.0;
    for (int i = 0; i < n; ++i)
      if (motion.segment<6>(6 * i).norm() > largest) {
        largest = motion.segment<6>(6 * i).norm();
        part = i;
      }
    double work = 0.0, scale = 0.0;
    for (int i = 0; i < n; ++i) {
      work += frames[i].displacements(motion.segment<6>(6 * i), *problem.substructures[i]).cwiseProduct(force[i]).sum();
      scale += force[i].colwise().norm().sum() * largest;
    }
    const std::string what = fmt::format("static step '{}': {} of substructure '{}'", step.name,
                                         describe(motion.segment<6>(6 * part)), problem.substructures[part]->name);
    if (std::abs(work) > 1e-7 * scale && scale > 0.0)
      throw InputError(step.origin, what + " is loaded, but no support and no interface holds it" +
                                        what_lets_go(problem, *problem.substructures[part]));
    unconstrained[part].push_back(describe(motion.segment<6>(6 * part)));
    const Substructure& body = *problem.substructures[part];
    // Rather where no support and no interface is: what a pin adds to them is theirs no more.
    constexpr double at_support = 1e-2, at_interface = 1e-3;
    int best_node = -1;
    Vec3 best_direction = Vec3::Zero();
    double best = 0.0;
    for (int node = 0; node < body.mesh->n_nodes(); ++node) {
      if (body.mesh->condensed && body.mesh->condensed->follower(node)) continue;  // it has no unknowns
      Vec3 u = frames[part].value(motion.segment<6>(6 * part), body, node);
      const auto held = conditions.held[part].find(node);
      const bool is_held = held != conditions.held[part].end() && held->second.n > 0;
      if (is_held && held->second.n == 3) continue;
      if (is_held) u = held->second.free_basis() * (held->second.free_basis().transpose() * u);
      int axis = 0;
      const double reach = u.cwiseAbs().maxCoeff(&axis) * (is_held ? at_support : 1.0) *
                           (on_interface.count({part, node}) ? at_interface : 1.0);
      if (reach <= best) continue;
      best = reach;
      best_node = node;
      best_direction = Vec3::Unit(axis);
      if (is_held)
        best_direction =
            (held->second.free_basis() * (held->second.free_basis().transpose() * best_direction)).normalized();
    }
    CHECK(best_node >= 0, "no node can be pinned against a free rigid motion");
    Held& held = conditions.held[part][best_node];
    held.directions.col(held.n) = held.given.col(held.n) = best_direction;
    ++held.n;
    // What is left of the other free motions once this one is pinned.
    const auto at_pin = [&](const Vec& z) {
      return best_direction.dot(frames[part].value(z.segment<6>(6 * part), body, best_node));
    };
    const Vec pinned = motion;
    free_motions.pop_back();
    for (Vec& other : free_motions) other -= at_pin(other) / at_pin(pinned) * pinned;
  }
  warn_of_unconstrained(problem, step, unconstrained);
}

}  // namespace dygita
