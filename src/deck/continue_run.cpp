#include "deck/continue_run.hpp"

#include <spdlog/fmt/fmt.h>

#include "base/log.hpp"
#include "deck/deck_text.hpp"
#include "ranks/ranks.hpp"

namespace dygita {

DeckOutcome continue_run(const ContinueOptions& options) {
  Continuation continuation(options);
  const RunState& state = continuation.state();
  if (const std::string text = continuation.idle(); !text.empty()) {
    say(text);
    return {};
  }
  continuation.check_until();
  if (read_deck_text(state.deck_path) != state.deck_text)
    warn(fmt::format("deck '{}' has changed since the run or is missing: the run continues with its stored text",
                     state.deck_path));
  DeckOptions deck;
  deck.path = state.deck_path;
  deck.text = state.deck_text;
  deck.settings = state.settings;
  deck.solver = state.solver;
  deck.threads = options.threads;
  deck.time_limit = options.time_limit;
  deck.memory_limit = options.memory_limit;
  deck.meshes = options.meshes;
  deck.write_files = ranks::is_first();
  deck.write_frames = options.write_frames && continuation.has_frames();
  deck.write_state = options.write_state;
  deck.checkpoint_every = options.checkpoint_every;
  deck.out = continuation.out();
  deck.is_study = continuation.resumes() && continuation.is_in_its_place();  // its table, where the run was to make one
  DeckOutcome outcome = run_deck(
      deck, {[&](const Problem& problem, const RunRequest& request) { return continuation.run(problem, request); },
             check_report});
  if (!continuation.is_done() && !outcome.interrupted)
    throw InputError(fmt::format("the deck no longer runs problem '{}', case '{}'", state.problem, state.case_name));
  if (continuation.ends_early()) {
    say("the deck has further cases that have not been computed; execution ends here");
    outcome.interrupted = false;
  }
  if (continuation.resumes()) return outcome;
  std::erase_if(outcome.not_converged, [&](const std::string& label) {
    return label != fmt::format("problem '{}', case '{}'", state.problem, state.case_name);
  });
  return outcome;
}

}  // namespace dygita
