// output.energy: the balance of the whole (manual, energies).
#include "recording/output_table.hpp"
#include "recording/recorder.hpp"

namespace dygita {

namespace {

class EnergyRecorder : public TableRecorder {
 public:
  explicit EnergyRecorder(const Columns& columns) : TableRecorder(columns) {}

  void begin_step(const Instant& instant) override {
    if (!instant.is_static() || instant.i_step == 0) accept(instant);
  }
  void accept(const Instant& instant) override {
    const Energies& e = instant.state.energies;
    add_row(instant, instant.time(),
            {e.kinetic, e.strain, e.loads, e.friction, e.plastic, e.damping, e.scheme, e.balance(), e.stored});
  }
};

class EnergyOutput final : public Output {
 public:
  using Output::Output;

  void check(const Problem&) const override {}

  Columns columns() const override {
    Columns columns = {{"time", "s"}};
    for (const char* term :
         {"kinetic", "strain", "loads", "friction", "plastic", "damping", "scheme", "balance", "stored"})
      columns.push_back({term, "J"});
    return columns;
  }

  Notes record(const Table&, const Findings&) const override { return {}; }
  std::vector<StudyFigure> study_figures() const override { return {}; }

  std::unique_ptr<Recorder> recorder(const Problem&, const FrameSink&) const override {
    return std::make_unique<EnergyRecorder>(columns());
  }
};

}  // namespace

namespace outputs {
OutputEntry energy() { return {"energy", new_output<EnergyOutput>, {Display::As::energy, "", 0}}; }
}  // namespace outputs

}  // namespace dygita
