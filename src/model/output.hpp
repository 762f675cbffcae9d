// An output of a problem: every duty that checks, runs, files, the record, the report and studies have of one.
//
// Each output is one file in src/recording/outputs/, which ends with its entry in the table of outputs; nothing else
// names it. A duty that every output has is pure virtual: an output that forgets one does not compile. What duties are
// made of (recorders, tables) belongs to the floors above and is only named here.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "model/model.hpp"

namespace dygita {

struct Findings;
struct Frame;
class ModelArguments;
class Recorder;
struct RunEnd;
struct Table;

struct Column {
  std::string name, unit;  // "normal", "N"; without a unit ""
};
using Columns = std::vector<Column>;

// What the run record states of an output, in order, whatever its format.
struct Note;
using Notes = std::vector<Note>;
struct Note {
  std::string name;
  std::variant<std::string, double, int, std::vector<std::string>, std::vector<double>, Notes> value;
};

// Notes that several outputs have: "on", a list of labels (nothing where it is on nothing), and "direction".
void note_targets(const std::vector<Target>& on, Notes& notes);
void note_direction(const std::optional<Vec3>& direction, Notes& notes);

// A column as the one number by which cases of a study are compared.
struct StudyFigure {
  enum class Of { largest, last, mean, lowest };  // largest modulus
  std::string column;
  Of of;
};

// What a spectrum can be taken of.
struct HistoryKind {
  std::string quantity;  // "acceleration"
  bool has_direction = false;
};

using FrameSink = std::function<void(const Frame&)>;

class Output : public Named {
 public:
  // One that takes no name is called by its word; a problem has one of it at most.
  explicit Output(const ModelArguments& arguments);
  virtual ~Output() = default;

  const std::string word;  // "history", of output.history
  const bool is_named;

  std::string known_as() const;  // "output.history 'above'"

  // Throws InputError where it makes no sense in the problem.
  virtual void check(const Problem& problem) const = 0;
  // Of its table, `time` or `frequency` first; none: it has no table.
  virtual Columns columns() const = 0;
  // Beside its name, word and file.
  virtual Notes record(const Table& table, const Findings& findings) const = 0;
  virtual std::vector<StudyFigure> study_figures() const = 0;
  // Watches the run for it; null: it is made of what others have recorded. Frames go to `sink`, which may be empty.
  virtual std::unique_ptr<Recorder> recorder(const Problem& problem, const FrameSink& sink) const = 0;

  // Makes what it tells once all recorders are done: its table where it has no recorder, findings.
  virtual void conclude(const RunEnd&, Table&, Findings&) const {}
  // Findings that go with a table of nan, where nothing is computed.
  virtual void hollow(const Table&, Findings&) const {}
  // Says what is allowed but hardly meant.
  virtual void doubt(const Problem&) const {}
  // Hz, that time step and mesh are to carry for it; none: it asks for none.
  virtual std::optional<double> highest_frequency() const { return std::nullopt; }
  virtual std::optional<HistoryKind> history() const { return std::nullopt; }
  // Does it show nothing but a motion that the deck prescribes, in every dynamic step?
  virtual bool is_prescribed(const Problem&) const { return false; }
  // Interfaces and walls whose points the report maps.
  virtual std::vector<Target> mapped() const { return {}; }
  // Do passes over the run go on until it converges (solver.latin{ spectra })?
  virtual bool settles() const { return false; }
  // How far it has moved since the pass before, dB; its findings then tell of that.
  virtual double settle(const Table&, const Table&, Findings&) const { return 0.0; }
};

}  // namespace dygita
