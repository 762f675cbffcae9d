#include "deck/repeat_run.hpp"

#include <spdlog/fmt/fmt.h>

#include "base/log.hpp"
#include "run/repetition.hpp"

namespace dygita {

DeckOutcome repeat_run(DeckOptions options, const std::filesystem::path& record) {
  Repetition repetition(record);
  if (options.path.empty()) options.path = repetition.deck();
  options.settings = repetition.settings();
  options.solver = repetition.solver();
  options.write_frames = options.write_frames && repetition.has_frames();
  options.write_state = options.write_state && repetition.has_state();
  options.from = repetition.from();
  std::error_code ignored;
  if (!std::filesystem::exists(options.path, ignored))
    throw InputError(
        fmt::format("the recorded deck '{}' is missing\n    dygita run DECK --repeat {} gives its path, or start "
                    "from the folder of that run",
                    options.path.string(), record.string()));
  DeckOutcome outcome = run_deck(
      options, {[&](const Problem& problem, const RunRequest& request) { return repetition.run(problem, request); },
                check_report});
  if (!repetition.is_done() && !outcome.interrupted)
    throw InputError(fmt::format("the deck no longer runs {}", repetition.label()));
  if (!repetition.differing().empty())
    outcome.differing = fmt::format(
        "deck, parameters and meshes match those of {}, but these tables differ (history files are not compared and "
        "may have changed): {}",
        repetition.label(), repetition.differing());
  return outcome;
}

}  // namespace dygita
