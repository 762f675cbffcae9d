#include "mesh/mortar.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/parallel.hpp"
#include "mesh/facet_parts.hpp"
#include "mesh/sagitta.hpp"
#include "numerics/dense.hpp"

namespace dygita {

namespace {

constexpr double least_share = 0.499;    // of a point's function that must be covered: an edge along nodes covers half
constexpr double coarser = 1.3;          // of two sizes, to count as different
constexpr double fewer_points = 0.02;    // of the smaller number, likewise
constexpr double better_covered = 0.01;  // of two shares, likewise
constexpr double rounding = 1e-6;        // of the smallest edge: touching faces are not farther apart
constexpr double nothing = 1e-14;        // a weight
constexpr double on_the_spot = 1e-10;    // of a size: no offset between two places
constexpr double flat = 1e-9;            // of the largest: an inertia without a direction

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

// covered: m^2, of each part.
Census census_of(const FaceInSpace& face, const std::vector<double>& covered) {
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

std::pair<Census, Census> take_census(const FaceInSpace& one, const FaceInSpace& other, double reach) {
  const SegmentFinder finder(one, other, reach);
  std::vector<std::vector<Segment>> segments(one.parts.size());
  parallel_for(static_cast<int>(segments.size()), [&](int i) { segments[i] = finder.segments(i); });
  std::vector<double> of_one(one.parts.size(), 0.0), of_other(other.parts.size(), 0.0);
  for (size_t i = 0; i < segments.size(); ++i)
    for (const Segment& segment : segments[i]) {
      of_one[i] += segment.area;
      of_other[segment.other] += segment.area;
    }
  return {census_of(one, of_one), census_of(other, of_other)};
}

bool is_second_chosen(const Census& first, const Census& second, const MeetingOptions& options) {
  if (options.points != Carrier::coarser) return options.points == Carrier::second;
  if (std::max(first.size, second.size) >= coarser * std::min(first.size, second.size)) return second.size > first.size;
  // With more points than the other side has nodes, that side could not answer them all.
  if (std::abs(first.n_points - second.n_points) > fewer_points * std::min(first.n_points, second.n_points))
    return second.n_points < first.n_points;
  if (std::abs(first.coverage - second.coverage) > better_covered) return second.coverage > first.coverage;
  return options.is_second_softer;
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

Mat3 cross_matrix(const Vec3& a) {
  Mat3 m;
  m << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return m;
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

  // Enough of its function is covered.
  bool is_whole() const { return area >= least_share * full && area > 0.0; }
  void add(const Raw& other) {
    area += other.area;
    normal += other.normal;
    own.insert(own.end(), other.own.begin(), other.own.end());
    opposite.insert(opposite.end(), other.opposite.begin(), other.opposite.end());
  }
};

Mortar::Mortar(const PlacedFace& side_1, const PlacedFace& side_2, const MeetingOptions& options)
    : face_1_(side_1),
      face_2_(side_2),
      reach_(std::max(options.within, rounding * std::min(face_1_.smallest_edge(), face_2_.smallest_edge())) +
             sagitta_margin * (face_1_.sagitta() + face_2_.sagitta())) {
  const auto [first, second] = take_census(face_1_, face_2_, reach_);
  if (first.size == 0.0) return;
  couple_from(is_second_chosen(first, second, options));
  if (options.points == Carrier::coarser && !can_carry()) {
    std::vector<Coupling> coarser = couplings_;
    couple_from(!is_second_);
    if (!can_carry()) {
      couplings_ = std::move(coarser);
      is_second_ = !is_second_;
    }
  }
  ratio_ = is_second_ ? second.size / first.size : first.size / second.size;
  for (const Coupling& coupling : couplings_) covered_ += coupling.covered;
  find_facets(is_second_ ? side_2 : side_1, is_second_ ? side_1 : side_2);
}

void Mortar::couple_from(bool is_second) {
  is_second_ = is_second;
  couplings_ = couple(carrier(), other(), reach_);
}

// Fewer than four points, or points in a row, let the bodies tilt as the face does not.
bool Mortar::can_carry() const {
  constexpr size_t few = 4;
  constexpr double narrow = 0.25;  // of what is touched
  std::vector<int> whole, touched;
  const std::vector<Raw> raw = raw_points();
  for (size_t i = 0; i < raw.size(); ++i) {
    if (raw[i].opposite.empty()) continue;
    touched.push_back(static_cast<int>(i));
    if (raw[i].is_whole()) whole.push_back(static_cast<int>(i));
  }
  return whole.size() >= few &&
         width_of(carrier().x(Eigen::all, whole)) >= narrow * width_of(carrier().x(Eigen::all, touched));
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

// Where each node's point goes: to itself, to the neighbour that it is merged into, or nowhere (-1).
std::vector<int> Mortar::targets(const std::vector<Raw>& raw,
                                 const std::function<bool(const Vec3&)>& is_taken_away) const {
  const auto n = static_cast<int>(raw.size());
  std::vector<char> is_whole(n, 0), is_taken(n, 0);
  for (int i = 0; i < n; ++i) {
    is_taken[i] = is_taken_away && !raw[i].opposite.empty() && is_taken_away(carrier().x.col(i));
    is_whole[i] = !is_taken[i] && raw[i].is_whole();
  }
  // Areas that are alike but for rounding are equal, wherever the faces stand: in steps of about a millionth of the
  // largest, whose bounds no simple ratio of areas falls on.
  double largest = 0.0;
  for (const Raw& one : raw) largest = std::max(largest, one.area);
  const auto size_of = [&](int i) { return largest > 0.0 ? std::floor(723606.79775 * raw[i].area / largest) : 0.0; };
  // The better of two: whole ones first, then the larger; the lower number last, so that none goes in a circle.
  const auto is_better = [&](int a, int b) {
    return std::tuple(is_whole[a], !is_taken[a], size_of(a), -a) >
           std::tuple(is_whole[b], !is_taken[b], size_of(b), -b);
  };
  // Of whole ones as large as each other the nearest, else a face and its mirror image would have different points.
  const double edge2 = std::pow(carrier().smallest_edge(), 2);
  const auto is_better_for = [&](int i, int a, int b) {
    if (!is_whole[a] || !is_whole[b] || size_of(a) != size_of(b)) return is_better(a, b);
    const auto far = [&](int j) {
      return std::floor(7236.0679775 * (carrier().x.col(j) - carrier().x.col(i)).squaredNorm() / edge2);
    };
    return std::pair(-far(a), -a) > std::pair(-far(b), -b);
  };
  std::vector<int> best(n, -1);
  for (const Coupling& coupling : couplings_)
    for (const int i : coupling.points) {
      if (raw[i].opposite.empty()) continue;
      for (const int j : coupling.points)
        if (j != i && !raw[j].opposite.empty() && (best[i] < 0 || is_better_for(i, j, best[i]))) best[i] = j;
    }
  std::vector<int> target(n, -1);
  for (int i = 0; i < n; ++i) {
    if (raw[i].opposite.empty()) continue;
    const bool stays = is_whole[i] || best[i] < 0 || !is_better(best[i], i);
    target[i] = stays ? i : best[i];
  }
  for (int i = 0; i < n; ++i)
    while (target[i] >= 0 && target[target[i]] != target[i]) target[i] = target[target[i]];
  return target;
}

// Divides by the area; on the other side, whose mean place may be off, adds what makes it exact in rigid motions.
void Mortar::add_point(const Raw& raw, SideTrace& own, SideTrace& opposite, Facing& facing) const {
  std::vector<SideTrace::Share> of_own, of_opposite;
  Vec3 place = Vec3::Zero(), there = Vec3::Zero(), mean = Vec3::Zero();
  for (const auto& [node, weight] : raw.own) {
    const double share = weight / raw.area;
    place += share * carrier().x.col(node);
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
  const std::vector<int> target = targets(raw, is_taken_away);
  std::vector<int> point_of(raw.size(), -1), kept;
  for (size_t i = 0; i < raw.size(); ++i)
    if (target[i] == static_cast<int>(i)) {
      point_of[i] = static_cast<int>(kept.size());
      kept.push_back(static_cast<int>(i));
    }
  for (size_t i = 0; i < raw.size(); ++i) {
    if (target[i] < 0 || target[i] == static_cast<int>(i)) continue;
    raw[target[i]].add(raw[i]);
    point_of[i] = point_of[target[i]];
  }
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
  facing.n_merged = static_cast<int>(std::count_if(target.begin(), target.end(), [](int i) { return i >= 0; })) -
                    static_cast<int>(kept.size());
  return facing;
}

}  // namespace dygita
