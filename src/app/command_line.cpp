#include "app/command_line.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "app/command_pages.hpp"

namespace dygita {

namespace {

void add_limits(CLI::App& command, double& time_limit, double& memory_limit, MeshLimits& meshes) {
  command.add_option("--time-limit", time_limit, "time (s) that the deck's own code may take")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--memory-limit", memory_limit, "memory (MB) that the deck's own data may take")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--mesh-time-limit", meshes.time, "time (s) that reading and meshing one file may take")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      .add_option("--trust-mesh", meshes.trusted,
                  "a mesh file that you trust: it may run programs and write files, as gmsh itself lets it")
      ->allow_extra_args(false)
      ->type_name("FILE");
}

void add_checkpoints(CLI::App& command, std::string& every) {
  command
      .add_option("--checkpoint-every", every,
                  "bring what was computed to the disk so often, as 30s, 5min or 1h; 0: never, a run that is killed "
                  "cannot be continued")
      ->capture_default_str()
      ->type_name("TIME");
}

void add_threads(CLI::App& command, int& threads) {
  command.add_option("--threads", threads, "number of threads (default: all)")->check(CLI::Range(1, 1024));
}

template <class Path>
void add_run_folder(CLI::App& command, Path& run) {
  command.add_option("RUN", run, "folder of a run, out/<problem>/<case>")->required()->type_name("DIR");
}

void add_deck_options(CLI::App& command, Command& asked) {
  command.add_option("DECK", asked.deck.path, "a deck")->required()->type_name("FILE.lua");
  command.add_option("--set", asked.settings, "another value for a parameter of the deck, as tighten=0.04*mm")
      ->allow_extra_args(false)
      ->type_name("NAME=VALUE");
  command
      .add_option("--solver", asked.deck.solver,
                  "solver of every problem in place of the deck's, as monolithic or 'latin{ tolerance = 1e-4 }'")
      ->allow_extra_args(false)
      ->type_name("SOLVER");
  add_limits(command, asked.deck.time_limit, asked.deck.memory_limit, asked.deck.meshes);
  command.add_flag("--quiet", asked.is_quiet, "no progress lines");
}

void add_run_options(CLI::App& command, Command& asked) {
  add_deck_options(command, asked);
  CLI::Option* repeats =
      command
          .add_option("--repeat", asked.repeats,
                      "a run.json: deck, parameters and solver are those of its run, deck and meshes must be the same, "
                      "tables are compared")
          ->type_name("FILE.json");
  command.get_option("DECK")->required(false);
  for (const char* option : {"--set", "--solver"}) repeats->excludes(command.get_option(option));
  command.add_option("--out", asked.deck.out, "folder of the results, out/<problem>/<case>")
      ->capture_default_str()
      ->type_name("DIR");
  add_threads(command, asked.deck.threads);
  command.add_flag("--no-frames", asked.has_no_frames, "no frames for ParaView; tables and run.json are written");
  command.add_flag("--no-state", asked.has_no_state, "no state file: the run cannot be continued later");
  add_checkpoints(command, asked.checkpoint_every);
}

void add_check_options(CLI::App& command, Command& asked) {
  add_deck_options(command, asked);
  command
      .add_option("--picture", asked.picture,
                  "draw parts, their named faces and the interfaces found: .svg, or .html to turn it")
      ->type_name("FILE");
}

void add_converge_options(CLI::App& command, Command& asked) {
  add_deck_options(command, asked);
  command
      .add_option(
          "--vary", asked.vary,
          "parameters to refine, with commas: size (halved each time), size/1.5, n*2 (a number of cells or steps)")
      ->required()
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAMES");
  command
      .add_option("--output", asked.outputs,
                  "figures to watch, with commas: shank.normal.max (or .min, .last, .mean), a spectrum by its name "
                  "(default: those of studies, and all spectra)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAMES");
  command
      .add_option("--to", asked.aim,
                  "how close to the limit, as 1% (of spectra its decibels): refines until it is met, and says the "
                  "cheapest setting that meets it")
      ->type_name("SHARE");
  command.add_option("--budget", asked.budget, "begin no run that would exceed this, as 90s, 10min or 2h")
      ->type_name("TIME");
  command.add_option("--out", asked.deck.out, "folder of the results, out/<deck>_converge")
      ->capture_default_str()
      ->type_name("DIR");
  add_threads(command, asked.deck.threads);
}

void add_continue_options(CLI::App& command, Command& asked) {
  ContinueOptions& options = asked.going_on;
  add_run_folder(command, options.run);
  command.add_option("--tolerance", options.tolerance, "iterate to this tolerance (static steps: a hundredth of it)")
      ->check(CLI::Range(1e-14, 0.1));
  command
      .add_option("--iterations", options.more_iterations,
                  "at most so many further iterations at each increment, after one that meets what is known")
      ->check(CLI::Range(1, 1000000));
  command.add_option("--until", asked.until, "extend the last dynamic step to this time, as 0.0004 or 0.4*ms")
      ->type_name("TIME");
  add_threads(command, options.threads);
  add_limits(command, options.time_limit, options.memory_limit, options.meshes);
  command.add_flag("--no-frames", asked.has_no_frames, "no frames for ParaView");
  command.add_flag("--no-state", asked.has_no_state, "no state file: the run cannot be continued once more");
  add_checkpoints(command, asked.checkpoint_every);
  command.add_flag("--quiet", asked.is_quiet, "no progress lines");
}

void add_srs_options(CLI::App& command, SrsCommand& asked) {
  command.add_option("SIGNAL", asked.signal, "time (s), then values; a column of step names is passed over")
      ->required()
      ->type_name("FILE.csv");
  CLI::Option* q =
      command.add_option("--q", asked.settings.q_factor, "Q, the amplification at resonance")->capture_default_str();
  command.add_option("--damping", asked.damping, "damping ratio, 1/(2 Q), in place of Q")
      ->check(CLI::Range(0.0, 0.99))
      ->excludes(q);
  std::string quantities;
  for (const std::string& name : srs_quantities()) quantities += (quantities.empty() ? "{" : ",") + name;
  command.add_option("--quantity", asked.quantity, "response of the oscillator")
      ->capture_default_str()
      ->type_name(quantities + "}");
  command.add_option("--from", asked.settings.from, "first frequency, Hz")->capture_default_str();
  command.add_option("--to", asked.settings.to, "highest frequency, Hz")->capture_default_str();
  command.add_option("--per-octave", asked.settings.per_octave, "frequencies per octave")->capture_default_str();
  command.add_option("--column", asked.column, "name of the column of values (default: the first)")->type_name("NAME");
  command.add_option("--out", asked.out, "file to write (default: standard output)")->type_name("FILE");
}

void add_report_options(CLI::App& command, ReportCommand& asked) {
  add_run_folder(command, asked.run);
  command
      .add_option(
          "--specification", asked.specifications,
          "frequency (Hz) and level (m/s^2, or g where its header says [g]), in place of the deck's: of a "
          "spectrum by its name; FILE.csv alone is of those that have one in the deck, or of all where none has")
      ->allow_extra_args(false)
      ->type_name("SPECTRUM=FILE.csv");
  command.add_option("--out", asked.out, "file to write (default: report.html in the folder)")->type_name("FILE");
}

void add_view_options(CLI::App& command, ViewCommand& asked) {
  add_run_folder(command, asked.run);
  command.add_option("--paraview", asked.program, "ParaView's program, a name or a path")
      ->capture_default_str()
      ->type_name("FILE");
}

OptionRow row_of(const CLI::Option& option) {
  OptionRow row;
  row.is_positional = option.get_positional();
  if (row.is_positional) row.names.push_back(option.get_single_name());
  for (const std::string& name : option.get_snames()) row.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) row.names.push_back("--" + name);
  const bool is_flag = option.get_items_expected_max() == 0;
  const std::string type = option.get_type_name();  // with what is checked: "FLOAT:POSITIVE"
  if (!is_flag) row.value = type.front() == '{' ? type : type.substr(0, type.find(':'));
  row.doc = option.get_description();
  row.by_default = option.get_default_str();
  row.is_repeated = option.get_items_expected_max() > 1;
  return row;
}

CommandRow row_of(const CLI::App& command) {
  CommandRow row{command.get_name(), command.get_description(), {}};
  for (const CLI::Option* option : command.get_options())
    if (!option->get_group().empty()) row.options.push_back(row_of(*option));
  return row;
}

std::vector<CommandRow> rows_of(const CLI::App& app) {
  std::vector<CommandRow> rows = {row_of(app)};
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    rows.push_back(row_of(*command));
  return rows;
}

// What the build prints into files that are installed.
void add_hidden_pages(CLI::App& app) {
  app.add_option_function<std::string>(
         "--completion",
         [&app](const std::string& shell) {
           std::fputs(completion_script(rows_of(app), shell).c_str(), stdout);
           throw CLI::Success();
         },
         "completion script of a shell")
      ->group("");
  app.add_flag_callback(
         "--man",
         [&app] {
           std::vector<std::pair<int, std::string>> exits;
           for (const ExitMeaning& exit : exit_meanings()) exits.emplace_back(exit.code, exit.meaning);
           std::fputs(man_page(rows_of(app), exits, version()).c_str(), stdout);
           throw CLI::Success();
         },
         "the man page, in roff")
      ->group("");
}

}  // namespace

const std::vector<ExitMeaning>& exit_meanings() {
  static const std::vector<ExitMeaning> meanings = {
      {done, "done"},
      {not_converged, "computed and written, but some increments did not converge"},
      {wrong_input, "the deck, a mesh or the command line is wrong; the message says where"},
      {failed, "the computation failed"},
      {broken, "an error in the program: please report it with the deck"},
      {stopped, "stopped by the user"}};
  return meanings;
}

void declare_commands(CLI::App& app, Command& asked) {
  app.description("Dygita: shock propagation through bolted assemblies");
  app.set_help_flag("-h,--help", "print this help");
  app.require_subcommand(1);
  app.set_version_flag("--version", "dygita " + version(), "print the version");
  add_run_options(*app.add_subcommand("run", "compute a deck"), asked);
  add_continue_options(
      *app.add_subcommand("continue",
                          "continue a run: where it was stopped or killed, to a tighter tolerance, or further in time"),
      asked);
  add_check_options(*app.add_subcommand("check", "declare and check a deck, say what it would compute, solve nothing"),
                    asked);
  add_converge_options(
      *app.add_subcommand("converge", "run a deck ever finer: orders of convergence, limits, the cheapest setting"),
      asked);
  add_srs_options(*app.add_subcommand("srs", "shock response spectrum of a CSV file"), asked.srs);
  app.add_subcommand("schema", "the reference of the deck language, as Markdown")
      ->add_flag("--lua", asked.is_for_editors, "definitions for editors instead, which then complete and check decks");
  add_report_options(*app.add_subcommand("report", "write report.html of a run again"), asked.report);
  add_view_options(*app.add_subcommand("view", "open a run in ParaView: deformed, coloured, cut"), asked.view);
  add_hidden_pages(app);
}

}  // namespace dygita
