#include "run/shared_result.hpp"

#include <cstring>
#include <sstream>

#include "base/error.hpp"
#include "base/log.hpp"
#include "ranks/ranks.hpp"

namespace dygita {

namespace {

// Writes on rank 0 what it reads on the others, in the same order.
class Archive {
 public:
  Archive() = default;
  explicit Archive(std::string bytes) : bytes_(std::move(bytes)), is_reading_(true) {}
  bool is_reading() const { return is_reading_; }
  const std::string& bytes() const { return bytes_; }

  template <class Number>
  requires std::is_arithmetic_v<Number>
  void operator()(Number& value) { copy(&value, sizeof value); }
  void operator()(std::string& text) {
    resize(text);
    copy(text.data(), text.size());
  }
  void operator()(Vec3& vector) { copy(vector.data(), 3 * sizeof(double)); }
  template <class Item>
  void operator()(std::vector<Item>& list) {
    resize(list);
    for (Item& item : list) (*this)(item);
  }
  template <class First, class Second>
  void operator()(std::pair<First, Second>& pair) {
    (*this)(pair.first);
    (*this)(pair.second);
  }
  template <class Key, class Value>
  void operator()(std::map<Key, Value>& map) {
    std::vector<std::pair<Key, Value>> items(map.begin(), map.end());
    (*this)(items);
    if (is_reading_) map = std::map<Key, Value>(items.begin(), items.end());
  }
  void operator()(Table& table) {
    (*this)(table.names);
    (*this)(table.units);
    (*this)(table.columns);
    (*this)(table.step);
    (*this)(table.converged);
  }
  void operator()(PartStress& peak) {
    (*this)(peak.part);
    (*this)(peak.von_mises);
    (*this)(peak.yield);
    (*this)(peak.time);
    (*this)(peak.step);
    (*this)(peak.place);
    (*this)(peak.above);
  }

 private:
  void copy(void* value, size_t n) {
    if (!is_reading_) {
      bytes_.append(static_cast<const char*>(value), n);
      return;
    }
    CHECK(at_ + n <= bytes_.size(), "a result that is shorter than itself");
    std::memcpy(value, bytes_.data() + at_, n);
    at_ += n;
  }
  template <class List>
  void resize(List& list) {
    size_t n = list.size();
    copy(&n, sizeof n);
    list.resize(n);
  }

  std::string bytes_;
  size_t at_ = 0;
  bool is_reading_ = false;
};

void run_through(Archive& archive, const Problem& problem, RunResult& result) {
  for (const OutputPtr& output : problem.outputs) {
    bool has_table = result.tables.contains(output.get());
    archive(has_table);
    if (!has_table) continue;
    Findings& findings = result.findings[output.get()];
    archive(result.tables[output.get()]);
    archive(findings.parts);
    archive(findings.values);
    archive(findings.band);
  }
  archive(result.stresses);
  archive(result.converged);
  archive(result.interrupted);
  archive(result.iterations);
  archive(result.mean_iterations);
  archive(result.seconds);
}

}  // namespace

void share_result(const Problem& problem, RunResult& result) {
  if (ranks::is_alone()) return;
  Archive archive;
  if (ranks::is_first()) run_through(archive, problem, result);
  Archive received(ranks::shared(archive.bytes()));
  if (!ranks::is_first()) run_through(received, problem, result);
}

void collect_warnings() {
  if (ranks::is_alone()) return;
  std::string own;
  if (!ranks::is_first())
    for (const std::string& warning : take_warnings()) own += warning + '\0';
  for (const std::string& of_rank : ranks::gathered(own)) {
    std::istringstream texts(of_rank);
    for (std::string text; std::getline(texts, text, '\0');) warn(text);
  }
}

void check_ranks(const Problem& problem) {
  if (ranks::is_alone()) return;
  const auto refuse = [&](const std::string& what) {
    throw InputError(problem.origin, "problem '" + problem.name + "': " + what + "\n    start dygita without mpirun");
  };
  if (problem.monolithic) refuse("solver.monolithic is one system of all substructures, which MPI ranks do not share");
  if (problem.explicit_dynamics)
    refuse("solver.explicit is one mesh of all substructures, which MPI ranks do not share");
}

}  // namespace dygita
