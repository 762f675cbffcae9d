// The command line: what is asked, messages, exit codes. The only file that ends the program.
//
// 0 done   1 not converged   2 wrong deck, mesh or command line   3 the computation failed   4 error in this program
// 130 stopped by the user
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <new>

#include "app/report_command.hpp"
#include "app/srs_command.hpp"
#include "base/names.hpp"
#include "base/progress.hpp"
#include "deck/continue_run.hpp"
#include "deck/deck.hpp"

namespace {

using namespace dygita;

enum ExitCode { done = 0, not_converged = 1, wrong_input = 2, failed = 3, broken = 4, stopped = 130 };

struct Command {
  DeckOptions deck;
  std::vector<std::string> settings;
  SrsCommand srs;
  ReportCommand report;
  ContinueOptions going_on;
  std::string until;
  bool is_quiet = false, has_no_frames = false, has_no_state = false;
};

int say_error(const char* message, int code) {
  std::fflush(stdout);
  std::fprintf(stderr, "%s\n", message);
  return code;
}

void add_deck_options(CLI::App& command, Command& asked) {
  command.add_option("DECK", asked.deck.path, "a deck, a Lua file")->required();
  command
      .add_option("--set", asked.settings, "NAME=VALUE: another value of a parameter of the deck, as tighten=0.04*mm")
      ->allow_extra_args(false);
  command
      .add_option("--solver", asked.deck.solver,
                  "solver of every problem in place of the deck's, as monolithic or 'latin{ tolerance = 1e-4 }'")
      ->allow_extra_args(false);
  command.add_option("--time-limit", asked.deck.time_limit, "s of processor time of the deck's own code")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--memory-limit", asked.deck.memory_limit, "MB of the deck's own data")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_flag("--quiet", asked.is_quiet, "no progress");
}

void add_srs_options(CLI::App& command, SrsCommand& asked) {
  command.add_option("SIGNAL", asked.signal, "a CSV: time (s), then values; a column of step names is passed over")
      ->required();
  CLI::Option* q =
      command.add_option("--q", asked.settings.q_factor, "Q, the amplification at resonance")->capture_default_str();
  command.add_option("--damping", asked.damping, "damping ratio, 1/(2 Q), in place of Q")
      ->check(CLI::Range(0.0, 0.99))
      ->excludes(q);
  command
      .add_option("--quantity", asked.quantity,
                  "absolute_acceleration, relative_displacement or pseudo_velocity of the oscillator")
      ->capture_default_str();
  command.add_option("--from", asked.settings.from, "first frequency, Hz")->capture_default_str();
  command.add_option("--to", asked.settings.to, "last frequency, Hz")->capture_default_str();
  command.add_option("--per-octave", asked.settings.per_octave, "frequencies per octave")->capture_default_str();
  command.add_option("--column", asked.column, "name of the column of values (default: the first)");
  command.add_option("--out", asked.out, "file to write (default: standard output)");
}

void add_report_options(CLI::App& command, ReportCommand& asked) {
  command.add_option("RUN", asked.run, "folder of a run, out/<problem>/<case>")->required();
  command.add_option("--specification", asked.specification,
                     "CSV of frequency (Hz) and level (m/s^2, or g where its header says [g]): of all spectra, in "
                     "place of the deck's");
  command.add_option("--out", asked.out, "file to write (default: report.html in the folder)");
}

void add_continue_options(CLI::App& command, Command& asked) {
  ContinueOptions& options = asked.going_on;
  command.add_option("RUN", options.run, "folder of a run, out/<problem>/<case>")->required();
  command.add_option("--tolerance", options.tolerance, "iterate to this tolerance (static steps: a hundredth of it)")
      ->check(CLI::Range(1e-14, 0.1));
  command
      .add_option("--iterations", options.more_iterations,
                  "at most so many iterations more at each increment, after one that meets what is known")
      ->check(CLI::Range(1, 1000000));
  command.add_option("--until", asked.until, "extend the last dynamic step to this time, as 0.0004 or 0.4*ms");
  command.add_option("--threads", options.threads, "threads (default: all)")->check(CLI::Range(1, 1024));
  command.add_option("--time-limit", options.time_limit, "s of processor time of the deck's own code")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--memory-limit", options.memory_limit, "MB of the deck's own data")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_flag("--no-frames", asked.has_no_frames, "no frames for ParaView");
  command.add_flag("--no-state", asked.has_no_state, "keep nothing to continue from once more");
  command.add_flag("--quiet", asked.is_quiet, "no progress");
}

int exit_code(const DeckOutcome& outcome, const char* when_stopped) {
  if (outcome.interrupted) return say_error(when_stopped, stopped);
  for (const std::string& name : outcome.not_converged) say_error(("not converged: " + name).c_str(), not_converged);
  return outcome.not_converged.empty() ? done : not_converged;
}

int go_on(Command& asked) {
  if (!asked.until.empty()) asked.going_on.until = parse_quantity("--until", asked.until);
  asked.going_on.write_frames = !asked.has_no_frames;
  asked.going_on.write_state = !asked.has_no_state;
  set_progress_enabled(!asked.is_quiet);
  catch_interrupts();
  return exit_code(continue_run(asked.going_on), "stopped");
}

int run_or_check(Command& asked, bool solves) {
  for (const std::string& text : asked.settings) asked.deck.settings.push_back(parse_setting(text));
  asked.deck.write_frames = !asked.has_no_frames;
  asked.deck.write_state = !asked.has_no_state;
  set_progress_enabled(!asked.is_quiet);
  catch_interrupts();
  const Engine engine{run_problem, check_report};
  return exit_code(solves ? run_deck(asked.deck, engine) : check_deck(asked.deck, engine),
                   "stopped; what was computed so far is written");
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

int command_line(int argc, char** argv) {
  CLI::App app("Dygita: shock propagation through bolted assemblies");
  app.require_subcommand(1);
  app.set_version_flag("--version", "dygita " + version());
  Command asked;
  CLI::App* run = app.add_subcommand("run", "compute a deck");
  add_deck_options(*run, asked);
  run->add_option("--out", asked.deck.out, "folder of the results, out/<problem>/<case>")->capture_default_str();
  run->add_option("--threads", asked.deck.threads, "threads (default: all)")->check(CLI::Range(1, 1024));
  run->add_flag("--no-frames", asked.has_no_frames, "no frames for ParaView; tables and run.json are written");
  run->add_flag("--no-state", asked.has_no_state, "no state file: the run cannot be continued later");
  CLI::App* going_on = app.add_subcommand("continue", "continue a run: to a tighter tolerance, or further in time");
  add_continue_options(*going_on, asked);
  CLI::App* check = app.add_subcommand("check", "declare and check a deck, say what it would compute, solve nothing");
  add_deck_options(*check, asked);
  CLI::App* srs = app.add_subcommand("srs", "shock response spectrum of a CSV file");
  add_srs_options(*srs, asked.srs);
  CLI::App* schema = app.add_subcommand("schema", "the reference of the deck language, as Markdown");
  CLI::App* report = app.add_subcommand("report", "write report.html of a run once more");
  add_report_options(*report, asked.report);

  check_command(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? done : wrong_input;
  }
  if (run->parsed() || check->parsed()) return run_or_check(asked, run->parsed());
  if (going_on->parsed()) return go_on(asked);
  if (srs->parsed()) {
    write_srs(asked.srs);
  } else if (report->parsed()) {
    write_report(asked.report);
  } else if (schema->parsed()) {
    std::fputs(deck_reference().c_str(), stdout);
  }
  return done;
}

}  // namespace

int main(int argc, char** argv) {
  prepare_process(argv);
  try {
    return command_line(argc, argv);
  } catch (const InputError& error) {
    return say_error(error.what(), wrong_input);
  } catch (const NumericalError& error) {
    return say_error(error.what(), failed);
  } catch (const std::bad_alloc&) {
    return say_error("not enough memory on this machine; dygita check tells what a problem needs", failed);
  } catch (const std::exception& error) {
    return say_error(error.what(), broken);
  }
}
