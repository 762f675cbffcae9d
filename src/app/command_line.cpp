#include "app/command_line.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>

#include "app/command_pages.hpp"
#include "base/plain_file.hpp"

namespace dygita {

namespace {

void add_limits(CLI::App& command, double& time_limit, double& memory_limit, MeshLimits& meshes) {
  constexpr double most_kept = 1e9;
  meshes.cache = most_kept;
  command.add_flag_callback(
      "--no-cache", [&meshes] { meshes.cache = 0.0; },
      "mesh every CAD file anew and keep no mesh in the folder .dygita beside the deck");
  command.add_option("--time-limit", time_limit, "time limit (s) of deck code")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      .add_option("--memory-limit", memory_limit,
                  "memory limit (MB) of deck data, and size limit of a file that is read")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--mesh-time-limit", meshes.time, "time limit (s) for reading and meshing one file")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command
      .add_option("--trust-mesh", meshes.trusted,
                  "trust this mesh file: it may run programs and write files, as in gmsh itself")
      ->allow_extra_args(false)
      ->type_name("FILE");
}

// Of a command without a deck.
void add_file_limit(CLI::App& command) {
  command
      .add_option_function<double>(
          "--memory-limit", [](const double& limit) { set_file_limit(limit * (1 << 20)); },
          "size limit (MB) of a file that is read")
      ->check(CLI::PositiveNumber)
      ->default_str("1024");
}

void add_checkpoints(CLI::App& command, std::string& every) {
  command
      .add_option("--checkpoint-every", every,
                  "interval between checkpoints, as 30s, 5min or 1h; 0: none, so that a killed run cannot be continued")
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
  command.add_option("--set", asked.settings, "override a parameter of the deck, as tighten=0.04*mm")
      ->allow_extra_args(false)
      ->type_name("NAME=VALUE");
  command
      .add_option("--solver", asked.deck.solver,
                  "replace the solver of every problem, as monolithic or 'latin{ tolerance = 1e-4 }'")
      ->allow_extra_args(false)
      ->type_name("SOLVER");
  add_limits(command, asked.deck.time_limit, asked.deck.memory_limit, asked.deck.meshes);
  command.add_flag("--quiet", asked.is_quiet, "no progress lines");
}

void add_run_options(CLI::App& command, Command& asked) {
  add_deck_options(command, asked);
  CLI::Option* repeats = command
                             .add_option("--repeat", asked.repeats,
                                         "repeat the run of this run.json with its deck, parameters and solver, and "
                                         "compare the tables; deck and meshes must be unchanged")
                             ->type_name("FILE.json");
  command.get_option("DECK")->required(false);
  for (const char* option : {"--set", "--solver"}) repeats->excludes(command.get_option(option));
  command.add_option("--out", asked.deck.out, "folder of the results, out/<problem>/<case>")
      ->capture_default_str()
      ->type_name("DIR");
  command
      .add_option("--from", asked.deck.from,
                  "start static steps from those of an earlier run, out/<problem>/<case>: a finished tightening serves "
                  "other shocks")
      ->excludes(repeats)
      ->type_name("DIR")
      ->check(CLI::Validator(
          [](std::string& given) { return std::string(given.empty() ? "the folder has no name" : ""); }, "", "folder"));
  add_threads(command, asked.deck.threads);
  command.add_flag("--no-frames", asked.has_no_frames, "write no frames for ParaView, only tables and run.json");
  command.add_flag("--no-state", asked.has_no_state, "write no state file; the run cannot be continued later");
  add_checkpoints(command, asked.checkpoint_every);
}

void add_check_options(CLI::App& command, Command& asked) {
  add_deck_options(command, asked);
  add_threads(command, asked.deck.threads);
  command
      .add_option("--picture", asked.picture,
                  "draw parts, named faces and interfaces: .svg, or .html for a view that rotates")
      ->type_name("FILE");
}

void add_converge_options(CLI::App& command, Command& asked) {
  add_deck_options(command, asked);
  command
      .add_option(
          "--vary", asked.vary,
          "comma-separated parameters to refine: size (halved each time), size/1.5, n*2 (a number of cells or steps)")
      ->required()
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAMES");
  command
      .add_option("--output", asked.outputs,
                  "comma-separated quantities: shank.normal.max (or .min, .last, .mean), a spectrum by its name "
                  "(default: those of studies, and all spectra)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAMES");
  command
      .add_option("--to", asked.aim,
                  "target distance from the limit, as 1% (for spectra in dB): refine until it is met and report the "
                  "cheapest setting that meets it")
      ->type_name("SHARE");
  command.add_option("--budget", asked.budget, "time budget: start no run that would exceed it, as 90s, 10min or 2h")
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
                  "limit of further iterations per increment, after the one that restores the stored solution")
      ->check(CLI::Range(1, 1000000));
  command.add_option("--until", asked.until, "extend the last dynamic step to this time, as 0.0004 or 0.4*ms")
      ->type_name("TIME");
  add_threads(command, options.threads);
  add_limits(command, options.time_limit, options.memory_limit, options.meshes);
  command.add_flag("--no-frames", asked.has_no_frames, "no frames for ParaView");
  command.add_flag("--no-state", asked.has_no_state, "write no state file; the run cannot be continued again");
  add_checkpoints(command, asked.checkpoint_every);
  command.add_flag("--quiet", asked.is_quiet, "no progress lines");
}

void add_srs_options(CLI::App& command, SrsCommand& asked) {
  command.add_option("SIGNAL", asked.signal, "time (s), then values; a column of step names is ignored")
      ->required()
      ->type_name("FILE.csv");
  CLI::Option* q =
      command.add_option("--q", asked.settings.q_factor, "Q, the amplification at resonance")->capture_default_str();
  command.add_option("--damping", asked.damping, "damping ratio, 1/(2 Q), instead of Q")
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
  add_file_limit(command);
}

void add_report_options(CLI::App& command, ReportCommand& asked) {
  add_run_folder(command, asked.run);
  command
      .add_option("--specification", asked.specifications,
                  "replace the deck's specification by a table of frequency (Hz) and level (m/s^2, or g if its header "
                  "says [g]): of the named spectrum, or with FILE.csv alone of those that have one in the deck, or of "
                  "all if none has")
      ->allow_extra_args(false)
      ->type_name("SPECTRUM=FILE.csv");
  command.add_option("--out", asked.out, "file to write (default: report.html in the folder)")->type_name("FILE");
  add_file_limit(command);
}

void add_view_options(CLI::App& command, ViewCommand& asked) {
  add_run_folder(command, asked.run);
  command.add_option("--paraview", asked.program, "ParaView executable, a name or a path")
      ->capture_default_str()
      ->type_name("FILE");
}

void add_import_options(CLI::App& command, ImportOptions& asked) {
  command.add_option("FILE", asked.file, "a model of Abaqus or CalculiX (.inp) or Nastran (.bdf, .nas, .dat, .fem)")
      ->required()
      ->type_name("FILE");
  command
      .add_option("--units", asked.units, "units of the file: length, mass or force, time, as 'm kg s' or 'in lbf s'")
      ->capture_default_str()
      ->type_name("UNITS");
  command.add_option("--skip", asked.skip, "comma-separated types of elements to leave out, as S4R")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("TYPES");
  add_file_limit(command);
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
      {not_converged,
       "computed and written, but some increments did not converge, or the energy balance is open by more than 20 %"},
      {wrong_input, "the deck, a mesh or the command line is wrong; the message says where"},
      {failed, "the computation failed"},
      {broken, "a bug: please report it with the deck"},
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
                          "continue a run: resume it after a stop, tighten its tolerance or extend it in time"),
      asked);
  add_check_options(*app.add_subcommand("check", "check a deck and report what it would compute, without solving"),
                    asked);
  add_converge_options(
      *app.add_subcommand("converge", "refine a deck repeatedly: orders of convergence, limits, the cheapest setting"),
      asked);
  add_srs_options(*app.add_subcommand("srs", "shock response spectrum of a CSV file"), asked.srs);
  add_import_options(*app.add_subcommand("import", "print a deck that says what a file of another program says"),
                     asked.importing);
  app.add_subcommand("schema", "the reference of the deck language, as Markdown")
      ->add_flag("--lua", asked.is_for_editors, "print definitions for editors, which then complete and check decks");
  add_report_options(*app.add_subcommand("report", "rewrite report.html of a run"), asked.report);
  add_view_options(*app.add_subcommand("view", "open a run in ParaView: deformed, coloured, cut"), asked.view);
  add_hidden_pages(app);
}

}  // namespace dygita
