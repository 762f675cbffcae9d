// Does what the command line asks: messages, exit codes. The only file that ends the program, but for
// base/watchdog.cpp.
#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>

#include "app/check_command.hpp"
#include "app/command_line.hpp"
#include "base/log.hpp"
#include "base/names.hpp"
#include "base/progress.hpp"
#include "base/task.hpp"
#include "base/warnings.hpp"
#include "deck/repeat_run.hpp"
#include "ranks/ranks.hpp"

namespace {

using namespace dygita;

// A name of a million characters says no more than its beginning.
std::string shortened(const std::string& message) {
  constexpr size_t longest = 20000, shown = 2000;
  if (message.size() <= longest) return message;
  return message.substr(0, shown) + " ... " + message.substr(message.size() - shown);
}

void say_error(const std::string& message) {
  std::fflush(stdout);
  std::fprintf(stderr, "%s\n", printable(shortened(message)).c_str());
}

int say_error(const char* message, int code) {
  if (ranks::is_first()) say_error(message);
  return code;
}

// An error of one rank ends all.
int fail(const char* message, int code) {
  tell_warnings();
  if (!ranks::is_alone()) ranks::stop_all(message, code);
  return say_error(message, code);
}

constexpr const char* nothing_solved =
    "stopped; nothing was solved, meshes that were finished are kept: start it again";

// What is left of an ensemble that was stopped and does not write its members.
std::string lost(int members) {
  const std::string solved = members == 0   ? "no member had come to its end"
                             : members == 1 ? "one member had come to its end and is lost"
                                            : fmt::format("{} members had come to their ends and are lost", members);
  return "stopped in an ensemble: " + solved +
         "\n    run{ members = true } writes each, and dygita continue goes on from them";
}

int exit_code(const DeckOutcome& outcome, const char* when_stopped) {
  if (outcome.interrupted && outcome.lost_members) return say_error(lost(*outcome.lost_members).c_str(), stopped);
  if (outcome.interrupted && task_was_interrupted() && outcome.n_written == 0)
    return say_error(nothing_solved, stopped);
  if (outcome.interrupted) return say_error(when_stopped, stopped);
  for (const std::string& name : outcome.not_converged) say_error(("not converged: " + name).c_str(), not_converged);
  if (!outcome.differing.empty()) return say_error(outcome.differing.c_str(), not_converged);
  return outcome.not_converged.empty() ? done : not_converged;
}

int go_on(Command& asked) {
  if (!asked.until.empty()) asked.going_on.until = parse_quantity("--until", asked.until);
  asked.going_on.write_frames = !asked.has_no_frames;
  asked.going_on.write_state = !asked.has_no_state;
  asked.going_on.checkpoint_every = parse_interval("--checkpoint-every", asked.checkpoint_every);
  if (ranks::is_first()) set_progress_enabled(!asked.is_quiet);
  catch_interrupts();
  return exit_code(continue_run(asked.going_on), "stopped");
}

int run_or_check(Command& asked, bool solves) {
  for (const std::string& text : asked.settings) asked.deck.settings.push_back(parse_setting(text));
  asked.deck.write_frames = !asked.has_no_frames;
  asked.deck.write_state = !asked.has_no_state;
  asked.deck.checkpoint_every = parse_interval("--checkpoint-every", asked.checkpoint_every);
  if (ranks::is_first()) set_progress_enabled(!asked.is_quiet);
  catch_interrupts();
  const char* when_stopped = solves ? "stopped; the results so far are written" : nothing_solved;
  if (!ranks::is_alone() && !asked.repeats.empty())
    throw InputError("dygita run --repeat: cannot run on several MPI ranks\n    start it without mpirun");
  if (!ranks::is_first()) asked.deck.write_files = false;
  if (!asked.repeats.empty()) return exit_code(repeat_run(asked.deck, asked.repeats), when_stopped);
  if (asked.deck.path.empty()) throw InputError("dygita run: which deck? dygita run DECK.lua, or --repeat run.json");
  const Engine engine{run_problem, CheckWithPicture(asked.picture)};
  const DeckOutcome outcome = solves ? run_deck(asked.deck, engine) : check_deck(asked.deck, engine);
  if (outcome.n_runs == 0 && !outcome.interrupted) return wrong_input;  // the deck's warning says so
  return exit_code(outcome, when_stopped);
}

int converge_deck(Command& asked) {
  for (const std::string& text : asked.settings) asked.deck.settings.push_back(parse_setting(text));
  set_progress_enabled(!asked.is_quiet);
  catch_interrupts();
  ConvergeOptions options{asked.deck, {}, asked.outputs};
  for (const std::string& text : asked.vary) options.variations.push_back(parse_variation(text));
  if (!asked.aim.empty()) options.aim = parse_share("--to", asked.aim);
  if (!asked.budget.empty()) options.budget = parse_duration("--budget", asked.budget);
  const ConvergeOutcome outcome = converge(options, {run_problem, check_report});
  if (outcome.interrupted) return say_error("stopped", stopped);
  return outcome.is_met && outcome.is_whole ? done : not_converged;
}

// The name of an unknown command, which CLI11 would only call missing.
void check_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    known.push_back(command->get_name());
    if (known.back() == argv[1]) return;
  }
  throw InputError(std::string("no command '") + argv[1] + "'\n    " + did_you_mean(argv[1], known));
}

// Paths are relative to where a rank was started: each would write its share of the results elsewhere.
void refuse_folders_of_their_own() {
  const std::vector<std::string> folders = ranks::gathered(std::filesystem::current_path().string());
  std::string apart;
  for (size_t rank = 1; rank < folders.size() && apart.empty(); ++rank)
    if (folders[rank] != folders[0])
      apart = fmt::format("rank 0 was started in {} and rank {} in {}", folders[0], rank, folders[rank]);
  apart = ranks::shared(apart);
  if (!apart.empty()) throw InputError(apart + "\n    start all ranks in one folder: mpirun --wdir FOLDER");
}

// Under mpirun: who speaks, and what several ranks do together.
void join_ranks(int argc, char** argv) {
  ranks::start([](const std::string& message) { say_error(message); });
  if (ranks::is_alone()) return;
  const std::string_view command = argc < 2 ? "" : argv[1];
  if (command != "run" && command != "continue")
    throw InputError(fmt::format(
        "dygita {}: cannot run on several MPI ranks\n    mpirun starts only dygita run and dygita continue", command));
  refuse_folders_of_their_own();
  set_interrupts_heeded(false);
  if (ranks::is_first()) return;
  be_silent();
  set_progress_enabled(false);
}

int command_line(int argc, char** argv) {
  CLI::App app;
  Command asked;
  declare_commands(app, asked);
  check_command(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? done : wrong_input;
  }
  if (app.got_subcommand("run")) return run_or_check(asked, true);
  if (app.got_subcommand("check")) return run_or_check(asked, false);
  if (app.got_subcommand("continue")) return go_on(asked);
  if (app.got_subcommand("converge")) return converge_deck(asked);
  if (app.got_subcommand("import")) std::fputs(imported_deck(asked.importing).c_str(), stdout);
  if (app.got_subcommand("srs")) write_srs(asked.srs);
  if (app.got_subcommand("report")) write_report(asked.report);
  if (app.got_subcommand("view")) start_view(asked.view);
  if (app.got_subcommand("schema"))
    std::fputs((asked.is_for_editors ? deck_definitions() : deck_reference()).c_str(), stdout);
  return done;
}

}  // namespace

int main(int argc, char** argv) {
  prepare_process(argv);
  try {
    join_ranks(argc, argv);
    const int code = command_line(argc, argv);
    tell_warnings();
    ranks::finish();
    return code;
  } catch (const InputError& error) {
    return fail(error.what(), wrong_input);
  } catch (const NumericalError& error) {
    return fail(error.what(), failed);
  } catch (const std::bad_alloc&) {
    return fail("not enough memory on this machine; dygita check reports what a problem needs", failed);
  } catch (const std::exception& error) {
    return fail(error.what(), broken);
  }
}
