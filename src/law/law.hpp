// An interface law: every duty that a user of laws has. Knows no mesh and no substructure.
//
// Each law is one file in laws/, which ends with its entry in the table of laws; nothing else names it. Every duty is
// pure virtual: a law that forgets one does not compile. A law turns the search problem  rate = s - Y F  into the force
// F and its own state at the end (manual, interface laws).
#pragma once

#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "law/law_fwd.hpp"
#include "law/penalty_form.hpp"
#include "law/point.hpp"

namespace dygita {

// An argument of a law, as the deck gave it.
struct LawParameter {
  std::string name, unit;  // unit: SI; empty for numbers without and for yes or no
  std::variant<double, bool> value;
};

// A few words on a law for the report: "yields at {}", with a number where the braces are.
struct LawRemark {
  std::string text;
  double value = 0.0;
  std::string unit;  // SI
};

// What follows from the displacements of the two sides alone, since the law's state does not have it.
enum class Followed { nothing, slip_between_touches, opening_and_slip };

// What outputs can tell of a point beside its force.
struct Shown {
  bool gap = false;              // it keeps a gap of its own: it opens, and may penetrate
  bool slip = false;             // its state has a slip
  bool plastic_opening = false;  // it yields
  bool states = false;           // its points are open, stick or slide (yield)
  Followed followed = Followed::nothing;
};

// The largest normal traction that a law can carry, and what to say to who asks for more.
struct TensionLimit {
  double traction = std::numeric_limits<double>::infinity();  // Pa
  std::string why;   // "it yields at {} without hardening", with the force where the braces are
  std::string cure;  // "give it 'hardening'"; empty: there is none
};

class Law {
 public:
  virtual ~Law() = default;

  // The word of the deck: interface.<word>.
  virtual std::string word() const = 0;
  virtual std::vector<LawParameter> parameters() const = 0;
  virtual std::vector<LawRemark> remarks() const = 0;
  virtual Shown shown() const = 0;

  // Are the sides one body, as long as no load acts on the interface? Such ties form groups (manual, groups).
  virtual bool is_tie() const = 0;
  // Do interfaces of equal parameters that lie side by side act as one law at the nodes they share?
  virtual bool joins_its_like() const = 0;
  // Can a load shorten it, as a nut does?
  virtual bool can_be_tightened() const = 0;
  virtual TensionLimit tension_limit() const = 0;
  // Can its nodes do without mass in dynamic steps (manual, eq. S7)?
  virtual bool allows_massless_nodes() const = 0;

  // Does it carry a force in this direction (0 normal, 1 and 2 tangents) in steps of this kind? Others have no unknown.
  // In a static step these are the directions in which it holds a part.
  virtual bool acts_on(int direction, bool is_static) const = 0;
  // What it keeps of its own at a point.
  virtual std::vector<MemoryEntry> memory() const = 0;
  // Fields of its state before anything has happened, where they are not those of LawState.
  virtual void set_initial(LawState& state) const = 0;
  // Force of the increment (N), a pure function of the trial and the state at its start; zero where y is, unless the
  // rate is given there and the law makes a force of it.
  virtual Vec3 force(const Trial& trial, const Increment& increment, const LawState& start) const = 0;
  // State at the end of the increment, once `force` is accepted.
  virtual LawState advance(const Trial& trial, const Increment& increment, const LawState& start,
                           const Vec3& force) const = 0;
  // What a release leaves of its own memory: nothing of what it has stored.
  virtual void let_go(LawState& state) const = 0;
  // Its sides begin to part at this rate (m/s), since they could not be joined without yielding (manual, eq. S5b).
  virtual void begin_to_part(LawState& state, double rate) const = 0;
  // What became of the increment's energy at a point of this area (m^2).
  virtual Work work(const LawState& start, const LawState& end, const Increment& increment, double area) const = 0;
  // Opening (m) that outputs show.
  virtual double opening(const LawState& state) const = 0;
  // Small motions about a state (manual, eq. D1); ties_sliding: points at the limit of friction stick.
  virtual Tangent tangent(const LawState& state, bool ties_sliding) const = 0;
  virtual ExplicitForm explicit_form() const = 0;

  // State before anything has happened.
  LawState initial() const {
    LawState state;
    state.memory = LawMemory(memory());
    set_initial(state);
    return state;
  }
  // Does it act on any direction in steps of this kind?
  bool takes_part(bool is_static) const {
    return acts_on(0, is_static) || acts_on(1, is_static) || acts_on(2, is_static);
  }
};

// A law of the table: its word, the arguments that it takes, all of them (law_arguments.hpp says which need not be
// given), and how it is made of them.
struct LawEntry {
  std::string word;
  std::vector<std::string> arguments;
  LawPtr (*make)(const LawArguments& arguments);
};

// Every law there is: one entry for each file of laws/, in the order of their names. CMake writes this function.
const std::vector<LawEntry>& law_table();

// A law of an entry with every argument 1 that must be given, to ask what holds for all of them.
LawPtr example_of(const LawEntry& entry);

// The law of a word; CHECKs that there is one, and that the arguments are those it takes.
LawPtr make_law(const std::string& word, const LawArguments& arguments = {});

// Its parameter "friction"; 0 where it has none.
double friction_of(const Law& law);

}  // namespace dygita
