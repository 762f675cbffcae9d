#include "meeting/mortar.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.hpp"
#include "meeting/facet_parts.hpp"
#include "meeting/sagitta.hpp"
#include "numerics/cross_matrix.hpp"
#include "numerics/dense.hpp"

namespace dygita {

namespace {

constexpr double least_share = 0.05;    // of a point's function that must be covered
constexpr double fewer_points = 0.02;   // of two numbers of points, of the smaller, to count as different
constexpr double lies_within = 0.99;    // of the area of the facets that take part: the face lies within the other
constexpr double enough_points = 64.0;  // of a face: they carry what a finer one would, nearly
constexpr double many_more = 1.5;       // of two numbers of points
constexpr double rounding = 1e-6;       // of the smallest edge: touching faces are not farther apart
constexpr double nothing = 1e-14;       // a weight
constexpr double on_the_spot = 1e-10;   // of a size: no offset between two places
constexpr double flat = 1e-9;           // of the largest: an inertia without a direction

// A side of the overlap by itself.
struct Census {
  double size = 0.0, coverage = 0.0;  // m, median side of the parts that take part; covered share of these
  double n_points = 0.0;              // nodes of which enough is covered
};

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<long>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Census take_census(const FaceInSpace& face, const FaceInSpace& other, double reach) {
  const SegmentFinder finder(face, other, reach);
  std::vector<double> covered(face.parts.size(), 0.0);  // m^2, of each part
  parallel_for(static_cast<int>(covered.size()), [&](int i) {
    for (const Segment& segment : finder.segments(i)) covered[i] += segment.area;
  });
  std::vector<double> sizes, of_node(face.nodes.size(), 0.0), all_of_node(face.nodes.size(), 0.0);
  double sum = 0.0, touched = 0.0;
  for (size_t i = 0; i < face.parts.size(); ++i) {
    const FaceInSpace::Part& part = face.parts[i];
    const FacetPart& shape = facet_parts(face.types[part.facet]).parts[part.k];
    for (int a = 0; a < shape.n; ++a) {
      const int node = face.facets[part.facet][shape.nodes[a]];
      of_node[node] += covered[i];
      all_of_node[node] += part.area;
    }
    if (covered[i] == 0.0) continue;
    sizes.push_back(std::sqrt(part.area));
    sum += covered[i];
    touched += part.area;
  }
  Census census{median(sizes), touched > 0.0 ? sum / touched : 0.0, 0.0};
  for (size_t i = 0; i < of_node.size(); ++i)
    if (of_node[i] > 0.0 && of_node[i] >= least_share * all_of_node[i]) census.n_points += 1.0;
  return census;
}

// Points on a face that lies within the other see all of the mesh that moves there. Else each face has points where it
// is covered; the fewer they are, the fewer patterns of forces meet a side that cannot answer them, if they are enough
// to carry what there is.
bool is_second_chosen(const Census& first, const Census& second, const MeetingOptions& options) {
  if (options.points != Carrier::automatic) return options.points == Carrier::second;
  const bool is_first_within = first.coverage >= lies_within, is_second_within = second.coverage >= lies_within;
  if (is_first_within != is_second_within) {
    const Census &inner = is_second_within ? second : first, &outer = is_second_within ? first : second;
    const bool is_outer_enough = outer.n_points >= enough_points && inner.n_points > many_more * outer.n_points;
    return is_second_within != is_outer_enough;
  }
  if (std::abs(first.n_points - second.n_points) > fewer_points * std::min(first.n_points, second.n_points))
    return (second.n_points < first.n_points) != options.is_layer;
  return options.is_second_preferred;
}

using Weights = std::vector<std::pair<int, double>>;  // (node, weight), by node

// Sums entries of one node; zeros stay, since the nodes count in eq. J4.
void gather(Weights& weights) {
  std::stable_sort(weights.begin(), weights.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  size_t n = 0;
  for (size_t i = 0; i < weights.size(); ++i) {
    if (n > 0 && weights[n - 1].first == weights[i].first)
      weights[n - 1].second += weights[i].second;
    else
      weights[n++] = weights[i];
  }
  weights.resize(n);
}

// Inverse on what an inertia does not leave free.
Mat3 pseudo_inverse(const Mat3& inertia) {
  const EigenPairs eigen = symmetric_eigen(inertia);
  Mat3 inverse = Mat3::Zero();
  for (int i = 0; i < 3; ++i)
    if (eigen.values[i] > flat * eigen.values[2])
      inverse += eigen.vectors.col(i) * eigen.vectors.col(i).transpose() / eigen.values[i];
  return inverse;
}

}  // namespace

double width_of(const Points& x) {
  if (x.cols() < 2) return 0.0;
  const Points arms = x.colwise() - Vec3(x.rowwise().mean());
  return std::sqrt(std::max(0.0, principal_axes(arms * arms.transpose()).values[1]) / static_cast<double>(x.cols()));
}

struct Mortar::Raw {
  double area = 0.0, full = 0.0;
  Vec3 normal = Vec3::Zero();
  Weights own, opposite;

  bool is_covered() const { return !opposite.empty() && area > 0.0; }
  Vec3 place(const Points& x) const {
    Vec3 sum = Vec3::Zero();
    for (const auto& [node, weight] : own) sum += weight / area * x.col(node);
    return sum;
  }
  void add(const Raw& other, double share) {
    area += share * other.area;
    normal += share * other.normal;
    for (const auto& [node, weight] : other.own) own.emplace_back(node, share * weight);
    for (const auto& [node, weight] : other.opposite) opposite.emplace_back(node, share * weight);
  }
};

Mortar::Mortar(const PlacedFace& side_1, const PlacedFace& side_2, const MeetingOptions& options)
    : face_1_(side_1),
      face_2_(side_2),
      reach_(std::max(options.within, rounding * std::min(face_1_.smallest_edge(), face_2_.smallest_edge())) +
             sagitta_margin * (face_1_.sagitta() + face_2_.sagitta())) {
  const Census first = take_census(face_1_, face_2_, reach_), second = take_census(face_2_, face_1_, reach_);
  if (first.size == 0.0) return;
  is_second_ = is_second_chosen(first, second, options);
  couplings_ = couple(carrier(), other(), reach_);
  ratio_ = is_second_ ? second.size / first.size : first.size / second.size;
  for (const Coupling& coupling : couplings_) covered_ += coupling.covered;
  find_facets(is_second_ ? side_2 : side_1, is_second_ ? side_1 : side_2);
}

void Mortar::find_facets(const PlacedFace& carrier, const PlacedFace& other) {
  std::vector<char> takes_part_here(carrier.facets.size(), 0), takes_part_there(other.facets.size(), 0);
  for (const Coupling& coupling : couplings_)
    for (const Coupling::Other& of : coupling.others) takes_part_here[coupling.facet] = takes_part_there[of.facet] = 1;
  for (size_t i = 0; i < carrier.facets.size(); ++i)
    if (takes_part_here[i]) of_carrier_.push_back(carrier.facets[i]);
  for (size_t i = 0; i < other.facets.size(); ++i)
    if (takes_part_there[i]) of_other_.push_back(other.facets[i]);
}

// Of each node of the carrier.
std::vector<Mortar::Raw> Mortar::raw_points() const {
  std::vector<Raw> raw(carrier().nodes.size());
  for (const Coupling& coupling : couplings_)
    for (size_t i = 0; i < coupling.points.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      Raw& point = raw[coupling.points[i]];
      point.full += coupling.full_areas[row];
      if (coupling.others.empty()) continue;
      point.area += coupling.areas[row];
      point.normal += coupling.normals.col(row);
      const std::vector<int>& nodes = carrier().facets[coupling.facet];
      for (size_t a = 0; a < nodes.size(); ++a)
        if (const double weight = coupling.own(row, static_cast<Eigen::Index>(a)); weight != 0.0)
          point.own.emplace_back(nodes[a], weight);
      for (const Coupling::Other& of : coupling.others)
        for (size_t a = 0; a < other().facets[of.facet].size(); ++a)
          point.opposite.emplace_back(other().facets[of.facet][a], of.values(row, static_cast<Eigen::Index>(a)));
    }
  parallel_for(static_cast<int>(raw.size()), [&](int i) {
    gather(raw[i].own);
    gather(raw[i].opposite);
  });
  return raw;
}

// Points of each node's facets that face something.
std::vector<std::vector<int>> Mortar::neighbours(const std::vector<Raw>& raw) const {
  std::vector<std::vector<int>> near(raw.size());
  for (const Coupling& coupling : couplings_)
    for (const int i : coupling.points)
      for (const int j : coupling.points)
        if (i != j && raw[i].is_covered() && raw[j].is_covered()) near[i].push_back(j);
  for (std::vector<int>& of_node : near) {
    std::sort(of_node.begin(), of_node.end());
    of_node.erase(std::unique(of_node.begin(), of_node.end()), of_node.end());
  }
  return near;
}

// How many neighbours lie between a node and the nearest whose point stays, 0 for those that stay; -1: no point.
// Where no point of a connected region would stay, the largest do.
std::vector<int> Mortar::distances(const std::vector<Raw>& raw, const std::vector<std::vector<int>>& near,
                                   const std::function<bool(const Vec3&)>& is_taken_away) const {
  std::vector<int> distance(raw.size(), -1), reached;
  const auto spread = [&] {
    for (size_t k = 0; k < reached.size(); ++k)
      for (const int j : near[reached[k]])
        if (distance[j] < 0) {
          distance[j] = distance[reached[k]] + 1;
          reached.push_back(j);
        }
    reached.clear();
  };
  // A node at the rim of what its facets cover has its point further in.
  const auto goes = [&](size_t i) {
    return is_taken_away &&
           (is_taken_away(raw[i].place(carrier().x)) || is_taken_away(carrier().x.col(static_cast<Eigen::Index>(i))));
  };
  for (size_t i = 0; i < raw.size(); ++i)
    if (raw[i].is_covered() && raw[i].area >= least_share * raw[i].full && !goes(i)) {
      distance[i] = 0;
      reached.push_back(static_cast<int>(i));
    }
  spread();
  for (size_t i = 0; i < raw.size(); ++i) {
    if (distance[i] >= 0 || !raw[i].is_covered()) continue;
    std::vector<int> region{static_cast<int>(i)};
    double largest = 0.0;
    std::vector<char> is_in(raw.size(), 0);
    is_in[i] = 1;
    for (size_t k = 0; k < region.size(); ++k) {
      largest = std::max(largest, raw[region[k]].area);
      for (const int j : near[region[k]])
        if (!std::exchange(is_in[j], 1)) region.push_back(j);
    }
    for (const int j : region)
      if (raw[j].area >= (1.0 - 1e-6) * largest) {
        distance[j] = 0;
        reached.push_back(j);
      }
    spread();
  }
  return distance;
}

// Gives the functions of points that do not stay to neighbours that are nearer to one that does, by their areas: all of
// them, so that no order of the nodes and no axis decides. Returns for each node where most of its point has gone.
std::vector<int> Mortar::merge(const std::function<bool(const Vec3&)>& is_taken_away, std::vector<Raw>& raw) const {
  const std::vector<std::vector<int>> near = neighbours(raw);
  const std::vector<int> distance = distances(raw, near, is_taken_away);
  std::vector<double> areas(raw.size());
  std::vector<int> order, heir(raw.size(), -1);
  for (size_t i = 0; i < raw.size(); ++i) {
    areas[i] = raw[i].area;
    if (distance[i] > 0) order.push_back(static_cast<int>(i));
    if (distance[i] == 0) heir[i] = static_cast<int>(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return distance[a] > distance[b]; });
  for (const int i : order) {
    double sum = 0.0;
    for (const int j : near[i])
      if (distance[j] == distance[i] - 1) sum += areas[j];
    for (const int j : near[i])
      if (distance[j] == distance[i] - 1) {
        raw[j].add(raw[i], areas[j] / sum);
        if (heir[i] < 0 || areas[j] > areas[heir[i]]) heir[i] = j;
      }
  }
  for (size_t i = 0; i < heir.size(); ++i)
    while (heir[i] >= 0 && distance[heir[i]] > 0) heir[i] = heir[heir[i]];
  return heir;
}

// Divides by the area; on the other side, whose mean place may be off, adds what makes it exact in rigid motions.
void Mortar::add_point(const Raw& raw, SideTrace& own, SideTrace& opposite, Facing& facing) const {
  std::vector<SideTrace::Share> of_own, of_opposite;
  Vec3 there = Vec3::Zero(), mean = Vec3::Zero();
  const Vec3 place = raw.place(carrier().x);
  for (const auto& [node, weight] : raw.own) {
    const double share = weight / raw.area;
    if (std::abs(share) > nothing) of_own.push_back({carrier().nodes[node], share});
  }
  if (of_own.size() == 1) of_own[0].weight = 1.0;
  double size = 0.0;
  for (const auto& [node, weight] : raw.opposite) {
    there += weight / raw.area * other().x.col(node);
    mean += other().x.col(node) / static_cast<double>(raw.opposite.size());
  }
  Mat3 inertia = Mat3::Zero();
  for (const auto& [node, weight] : raw.opposite) {
    const Vec3 arm = other().x.col(node) - mean;
    inertia += arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose();
    size = std::max(size, arm.norm());
  }
  const Vec3 offset = place - there;
  const bool turns = offset.norm() > on_the_spot * size;
  for (const auto& [node, weight] : raw.opposite) {
    const double share = weight / raw.area;
    if (turns)
      of_opposite.push_back({other().nodes[node], share, other().x.col(node) - mean});
    else if (std::abs(share) > nothing)
      of_opposite.push_back({other().nodes[node], share});
  }
  own.add(of_own);
  opposite.add(of_opposite, turns ? Mat3(-cross_matrix(offset) * pseudo_inverse(inertia)) : Mat3(Mat3::Zero()));
  const Eigen::Index i = own.n_points() - 1;
  const double sign = is_second_ ? -1.0 : 1.0;
  facing.normals.col(i) = sign * raw.normal.normalized();
  facing.areas[i] = raw.area;
  facing.places.col(i) = place;
  facing.gaps[i] = (is_second_ ? Vec3(place - there) : Vec3(there - place)).dot(facing.normals.col(i));
}

Facing Mortar::facing(const std::function<bool(const Vec3&)>& is_taken_away) const {
  std::vector<Raw> raw = raw_points();
  const std::vector<int> heir = merge(is_taken_away, raw);
  std::vector<int> point_of(raw.size(), -1), kept;
  for (size_t i = 0; i < raw.size(); ++i)
    if (heir[i] == static_cast<int>(i)) {
      point_of[i] = static_cast<int>(kept.size());
      kept.push_back(static_cast<int>(i));
    }
  for (size_t i = 0; i < raw.size(); ++i)
    if (heir[i] >= 0) point_of[i] = point_of[heir[i]];
  Facing facing;
  const auto n = static_cast<Eigen::Index>(kept.size());
  facing.normals = facing.places = Points(3, n);
  facing.areas = facing.gaps = Vec(n);
  SideTrace own, opposite;
  for (const int i : kept) {
    gather(raw[i].own);
    gather(raw[i].opposite);
    add_point(raw[i], own, opposite, facing);
  }
  facing.side_1 = is_second_ ? opposite : own;
  facing.side_2 = is_second_ ? own : opposite;
  facing.facets_1 = facets_1();
  facing.facets_2 = facets_2();
  for (const Facet& facet : of_carrier_) {
    Facet drawn = facet;
    int any = -1;  // nodes of parts that nothing faces have no point
    for (int& node : drawn.nodes()) {
      node = point_of[std::lower_bound(carrier().nodes.begin(), carrier().nodes.end(), node) - carrier().nodes.begin()];
      any = std::max(any, node);
    }
    for (int& node : drawn.nodes())
      if (node < 0) node = any;
    if (any >= 0) facing.facets.push_back(drawn);
  }
  facing.carrier = is_second_ ? 2 : 1;
  facing.size_ratio = ratio_;
  facing.sagitta = std::max(face_1_.sagitta(), face_2_.sagitta());
  facing.n_merged = static_cast<int>(std::count_if(heir.begin(), heir.end(), [](int i) { return i >= 0; })) -
                    static_cast<int>(kept.size());
  return facing;
}

}  // namespace dygita
