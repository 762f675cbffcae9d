// An output that does nothing, to test what asks for one.
#pragma once

#include "model/given_arguments.hpp"
#include "recording/recorder.hpp"

namespace dygita {

class OutputDouble : public Output {
 public:
  using Output::Output;

  void check(const Problem&) const override {}
  Columns columns() const override { return {{"time", "s"}, {"nothing", ""}}; }
  Notes record(const Table&, const Findings&) const override { return {}; }
  std::vector<StudyFigure> study_figures() const override { return {}; }
  std::unique_ptr<Recorder> recorder(const Problem&, const FrameSink&) const override { return nullptr; }
};

// output.double, with a name or, where that is empty, one of a kind.
inline std::shared_ptr<OutputDouble> output_double(const std::string& name, int line) {
  GivenArguments arguments("output.double", {"deck.lua", line});
  if (!name.empty()) arguments.words["name"] = name;
  return std::make_shared<OutputDouble>(arguments);
}

}  // namespace dygita
