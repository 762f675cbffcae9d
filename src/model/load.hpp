// A load of a step: every duty that checks, solvers and records have of one.
//
// Each load is one file in loads/, which ends with its entry in the table of loads; nothing else names it. Every duty
// is pure virtual: a load that forgets one does not compile. What a load does is told as effects (effects.hpp).
#pragma once

#include "model/arguments.hpp"
#include "model/effects.hpp"

namespace dygita {

// What is wrong with a load in a step, as it follows on its name ("load.velocity" + " acts in ..."), and the cure.
struct Complaint {
  std::string text, hint;
};

class Load {
 public:
  using Values = std::vector<std::optional<TimeValue>>;
  Load(const ModelArguments& arguments, Values given);
  virtual ~Load() = default;

  const std::string path;  // "load.pressure"
  const Origin origin;
  const std::vector<Target> on;  // empty: on every substructure
  const Values values;           // one, or one along each of x, y, z where given

  std::string word() const { return path.substr(path.find('.') + 1); }
  bool has_axes() const { return values.size() == 3; }

  // What it acts on, in the deck's words, and whether a target is such a thing.
  virtual std::string acts_on() const = 0;
  virtual bool can_act_on(const Target& target) const = 0;
  // Needs no target: is on every substructure.
  virtual bool is_everywhere() const = 0;
  // Of its values, SI.
  virtual const char* unit() const = 0;
  // Why it cannot be in this step; none: it can. All values that it needs are given.
  virtual std::optional<Complaint> complaint(const Step& step) const = 0;
  // What it does. Two effects of one name on one place are one value given twice.
  virtual std::vector<Effect> effects() const = 0;
  // An output of the run that it is made of; none: it is known before.
  virtual OutputPtr made_of() const { return nullptr; }
  // What else it is made of, for the record of a run: "direction", three numbers.
  using Settings = std::vector<std::pair<std::string, std::vector<double>>>;
  virtual Settings settings() const = 0;

 protected:
  // Of a value: "load.traction y", "load.pressure".
  std::string name_of(size_t i) const;
  // Forces for each value that is given, on each face or region: `unit` answers them for the i-th value being one.
  std::vector<Effect> nodal_forces(const std::function<Points(const LoadedNodes&, size_t i)>& unit) const;
};

// The arguments of a value, or of one along each of x, y, z.
Load::Values one_value(const ModelArguments& arguments, const char* key);
Load::Values axis_values(const ModelArguments& arguments);

std::optional<Complaint> static_only(const Step& step, const std::string& hint);
std::optional<Complaint> dynamic_only(const Step& step, const std::string& hint);

bool is_face(const Target& target);
bool is_place(const Target& target);  // a face or a region
FaceOrRegion place(const Target& target);

// A load of the table: its word and how it is made of its arguments.
struct LoadEntry {
  std::string word;
  LoadPtr (*make)(const ModelArguments& arguments);
};

template <class T>
LoadPtr new_load(const ModelArguments& arguments) {
  return std::make_shared<const T>(arguments);
}

// Every load there is: one entry for each file of loads/, in the order of their names. CMake writes this function.
const std::vector<LoadEntry>& load_table();

// The load of arguments.word(); CHECKs that there is one. Throws InputError where arguments contradict each other.
LoadPtr make_load(const ModelArguments& arguments);

}  // namespace dygita
