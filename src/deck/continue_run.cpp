#include "deck/continue_run.hpp"

#include <spdlog/fmt/fmt.h>

#include <fstream>
#include <iterator>

#include "base/log.hpp"

namespace dygita {

namespace {

bool is_same_text(const RunState& state) {
  std::ifstream file(state.deck_path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (text.rfind("\xEF\xBB\xBF", 0) == 0) text.erase(0, 3);
  if (text.rfind("#!", 0) == 0) text.replace(0, 2, "--");
  return file.good() || file.eof() ? text == state.deck_text : false;
}

}  // namespace

DeckOutcome continue_run(const ContinueOptions& options) {
  Continuation continuation(options);
  const RunState& state = continuation.state();
  if (const std::string text = continuation.idle(); !text.empty()) {
    say(text);
    return {};
  }
  continuation.check_until();
  if (!is_same_text(state))
    warn(fmt::format("deck '{}' has changed since the run or is gone: the run continues with the text that it kept",
                     state.deck_path));
  DeckOptions deck;
  deck.path = state.deck_path;
  deck.text = state.deck_text;
  deck.settings = state.settings;
  deck.solver = state.solver;
  deck.threads = options.threads;
  deck.time_limit = options.time_limit;
  deck.memory_limit = options.memory_limit;
  deck.write_frames = options.write_frames;
  deck.write_state = options.write_state;
  deck.is_study = false;
  DeckOutcome outcome = run_deck(
      deck, {[&](const Problem& problem, const RunRequest& request) { return continuation.run(problem, request); },
             check_report});
  if (!continuation.is_done() && !outcome.interrupted)
    throw InputError(
        fmt::format("the deck does not run problem '{}', case '{}' any more", state.problem, state.case_name));
  if (continuation.ends_early()) {
    say("the deck has further cases that have not been computed: it ends here");
    outcome.interrupted = false;
  }
  std::erase_if(outcome.not_converged, [&](const std::string& label) {
    return label != fmt::format("problem '{}', case '{}'", state.problem, state.case_name);
  });
  return outcome;
}

}  // namespace dygita
