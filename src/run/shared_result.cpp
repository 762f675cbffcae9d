#include "run/shared_result.hpp"

#include <spdlog/fmt/fmt.h>

#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <sstream>

#include "base/error.hpp"
#include "base/fnv1a.hpp"
#include "base/log.hpp"
#include "law/law.hpp"
#include "model/load.hpp"
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
    (*this)(peak.is_index);
    (*this)(peak.largest);
    (*this)(peak.allowed);
    (*this)(peak.time);
    (*this)(peak.step);
    (*this)(peak.place);
    (*this)(peak.above);
    (*this)(peak.ply);
    (*this)(peak.mode);
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

namespace {

// What a rank has read, and what that is called.
struct ReadPart {
  const char* what;
  Fnv1a digest = {};

  void add(double value) { digest.add(std::bit_cast<std::uint64_t>(value)); }
  template <class Values>
  void add_all(const Values& values) {
    for (const double value : values) add(value);
  }
};

// What the deck's function fails at, the run tells when it comes to it.
double value_or_nothing(const History& history, double t) {
  try {
    return history.value(t);
  } catch (const InputError&) {
    return std::numeric_limits<double>::infinity();
  }
}

std::vector<ReadPart> read_parts(const Problem& problem) {
  constexpr int n_instants = 32;
  ReadPart parts{"substructures"}, joints{"interfaces"}, supports{"supports"}, steps{"steps"};
  for (const SubstructurePtr& part : problem.substructures) {
    parts.digest.add(part->name);
    parts.digest.add(part->mesh->digest);
    const Elastic& m = part->material;
    parts.add_all(m.key());
    parts.add_all(std::array{m.damping.mass, m.damping.stiffness});
    parts.add_all(part->place);
    parts.add_all(part->velocity);
  }
  for (const InterfacePtr& joint : problem.interfaces) {
    for (const std::string& text : {joint->name, joint->side_1.label(), joint->side_2.label(), joint->law->word()})
      joints.digest.add(text);
    for (const LawParameter& parameter : joint->law->parameters())
      joints.add(std::visit([](auto value) { return static_cast<double>(value); }, parameter.value));
  }
  for (const SupportPtr& support : problem.supports) {
    supports.digest.add(support->name);
    for (const FaceOrRegion& on : support->on)
      supports.digest.add(std::visit([](const auto& place) { return place.label(); }, on));
  }
  for (const StepPtr& step : problem.steps) {
    steps.digest.add(step->name);
    steps.add_all(std::array{double(step->increments), step->duration, step->dt});
    for (const LoadPtr& load : step->loads) {
      steps.digest.add(load->path);
      for (const Target& target : load->on) steps.digest.add(label(target));
      for (const auto& value : load->values)
        for (int i = 0; value && i <= n_instants; ++i)
          steps.add(value_or_nothing(value->history, (step->is_static ? 1.0 : step->duration) * i / n_instants));
    }
  }
  return {parts, joints, supports, steps};
}

}  // namespace

void check_ranks_agree(const Problem& problem) {
  if (ranks::is_alone()) return;
  const std::vector<ReadPart> read = read_parts(problem);
  std::string own;
  for (const ReadPart& part : read) own += part.digest.hexadecimal();
  const std::string of_first = ranks::shared(own);
  const size_t length = own.size() / read.size();
  for (size_t i = 0; i < read.size(); ++i)
    if (ranks::any(own.compare(i * length, length, of_first, i * length, length) != 0))
      throw InputError(
          problem.origin,
          fmt::format("problem '{}': MPI ranks have read different {} from the deck, in number, order "
                      "or value\n    a deck must be reproducible: do not rely on the order of pairs() over a table "
                      "whose keys are objects, nor keep values between calls of a function of time",
                      problem.name, read[i].what));
}

}  // namespace dygita
