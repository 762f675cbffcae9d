// A progress line on a terminal, a plain line now and then in a log; and the user's wish to stop.
#pragma once

#include <chrono>
#include <string>

namespace dygita {

class Progress {
 public:
  // `label` names the work ("shock"); `total` is its number of increments.
  Progress(std::string label, int total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Says that `done` of `total` increments are finished; `detail` is free text ("t = 12.0 us, 5 iterations").
  // On a terminal the line is rewritten at most ten times a second; in a log a line at each tenth of the work, and
  // where that takes long every ten seconds.
  void update(int done, const std::string& detail);
  // The same of what goes on within the increment at hand: would a line be written now, and one.
  bool is_due() const;
  void tell(const std::string& detail);

 private:
  void write(const std::string& text);

  std::string label_;
  int total_;
  int done_ = 0, last_tenth_ = 0;
  bool is_terminal_;
  bool line_is_open_ = false;
  std::chrono::steady_clock::time_point start_, last_;
};

// Silences progress (dygita run --quiet, tests).
void set_progress_enabled(bool enabled);

// Makes SIGINT and SIGTERM set a flag instead of killing: the solver stops after the increment at hand and
// everything asked for is written up to there. A second signal kills.
void catch_interrupts();
bool interrupt_requested();
// The same from within, and back: for what ends a run that is not the user.
void request_interrupt();
void withdraw_interrupt();

}  // namespace dygita
