// The command line as a table: its commands, their options and the exit codes. What is parsed, --help, the completions
// of shells and the man page are all made from it.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "app/report_command.hpp"
#include "app/srs_command.hpp"
#include "app/view_command.hpp"
#include "deck/continue_run.hpp"
#include "deck/converge.hpp"
#include "deck/deck.hpp"
#include "foreign/imported_deck.hpp"

namespace dygita {

enum ExitCode { done = 0, not_converged = 1, wrong_input = 2, failed = 3, broken = 4, stopped = 130 };

struct ExitMeaning {
  ExitCode code;
  const char* meaning;
};

const std::vector<ExitMeaning>& exit_meanings();

// What a command line asks for.
struct Command {
  DeckOptions deck;
  std::vector<std::string> settings;
  SrsCommand srs;
  ReportCommand report;
  ViewCommand view;
  ContinueOptions going_on;
  ImportOptions importing;
  std::vector<std::string> vary, outputs;
  std::string aim, budget;
  std::string until, picture, repeats, checkpoint_every = "3min";
  bool is_quiet = false, has_no_frames = false, has_no_state = false, is_for_editors = false;
};

// Declares commands and options, which write into `asked`. Hidden options print the pages of command_pages.hpp.
void declare_commands(CLI::App& app, Command& asked);

}  // namespace dygita
