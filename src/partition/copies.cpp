#include "partition/copies.hpp"

#include <algorithm>

#include "ranks/neighbours.hpp"

namespace dygita {

namespace {

// Three numbers each from the rank of a copy to those of others.
class Passing {
 public:
  Passing(const Cut& cut, bool has_all, std::vector<Points>& fields) : cut_(cut), has_all_(has_all), fields_(fields) {}

  void add(const Copy& from, std::vector<int> to) {
    owner_.push_back(cut_.piece(from.piece).rank);
    readers_.push_back(std::move(to));
    values_.resize(values_.size() + 3);
    if (has(from)) Eigen::Map<Vec3>(values_.data() + values_.size() - 3) = at(from);
  }
  void exchange() {
    if (!has_all_) ranks::Neighbours(owner_, readers_, 3).exchange(values_.data());
  }
  // In the order in which they were added.
  Vec3 next() { return Eigen::Map<const Vec3>(values_.data() + 3 * next_++); }
  bool has(const Copy& copy) const { return has_all_ || cut_.is_here(copy.piece); }
  Points::ColXpr at(const Copy& copy) { return fields_[static_cast<size_t>(copy.piece)].col(copy.node); }
  int rank(const Copy& copy) const { return cut_.piece(copy.piece).rank; }

 private:
  const Cut& cut_;
  bool has_all_;
  std::vector<Points>& fields_;
  std::vector<int> owner_;
  std::vector<std::vector<int>> readers_;
  std::vector<double> values_;
  size_t next_ = 0;
};

// visit(owner, others) of every node on a cut of which a copy is here, or of all, in one order on all ranks.
template <class Visit>
void for_each_on_cuts(const Cut& cut, bool has_all, Visit&& visit) {
  for (int part = 0; part < cut.n_parts(); ++part) {
    const NodesOnCuts& on_cuts = cut.on_cuts(part);
    for (size_t i = 0; i < on_cuts.nodes().size(); ++i) {
      const Copy owner = cut.owner(part, on_cuts.nodes()[i]);
      const std::span<const Copy> others = on_cuts.others(i);
      const auto is_here = [&](const Copy& copy) { return cut.is_here(copy.piece); };
      if (has_all || is_here(owner) || std::any_of(others.begin(), others.end(), is_here)) visit(owner, others);
    }
  }
}

}  // namespace

void give_to_copies(const Cut& cut, bool has_all, std::vector<Points>& fields) {
  Passing passing(cut, has_all, fields);
  for_each_on_cuts(cut, has_all, [&](const Copy& owner, std::span<const Copy> others) {
    std::vector<int> readers;
    for (const Copy& other : others) readers.push_back(passing.rank(other));
    std::sort(readers.begin(), readers.end());
    readers.erase(std::unique(readers.begin(), readers.end()), readers.end());
    passing.add(owner, std::move(readers));
  });
  passing.exchange();
  for_each_on_cuts(cut, has_all, [&](const Copy&, std::span<const Copy> others) {
    const Vec3 value = passing.next();
    for (const Copy& other : others)
      if (passing.has(other)) passing.at(other) = value;
  });
}

void sum_on_owners(const Cut& cut, bool has_all, std::vector<Points>& fields) {
  Passing passing(cut, has_all, fields);
  for_each_on_cuts(cut, has_all, [&](const Copy& owner, std::span<const Copy> others) {
    for (const Copy& other : others) passing.add(other, {passing.rank(owner)});
  });
  passing.exchange();
  for_each_on_cuts(cut, has_all, [&](const Copy& owner, std::span<const Copy> others) {
    for (size_t i = 0; i < others.size(); ++i) {
      const Vec3 value = passing.next();
      if (passing.has(owner)) passing.at(owner) += value;
    }
  });
}

}  // namespace dygita
