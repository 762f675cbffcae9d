#include "base/progress.hpp"

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

namespace dygita {

namespace {

bool progress_enabled = true;
volatile std::sig_atomic_t interrupt_flag = 0;

void on_signal(int signal_number) {
  interrupt_flag = 1;
  std::signal(signal_number, SIG_DFL);
}

double seconds(std::chrono::steady_clock::duration d) { return std::chrono::duration<double>(d).count(); }

}  // namespace

void set_progress_enabled(bool enabled) { progress_enabled = enabled; }

void catch_interrupts() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

bool interrupt_requested() { return interrupt_flag != 0; }

void request_interrupt() { interrupt_flag = 1; }

void withdraw_interrupt() { interrupt_flag = 0; }

Progress::Progress(std::string label, int total)
    : label_(std::move(label)),
      total_(total),
      is_terminal_(isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()),
      last_(start_) {}

Progress::~Progress() {
  if (line_is_open_) std::fputs("\n", stderr);
}

void Progress::write(const std::string& text) {
  last_ = std::chrono::steady_clock::now();
  std::fputs((is_terminal_ ? "\r\033[K" + text : text + "\n").c_str(), stderr);
  std::fflush(stderr);
  line_is_open_ = is_terminal_;
}

void Progress::update(int done, const std::string& detail) {
  if (!progress_enabled) return;
  done_ = done;
  const int tenth = 10 * done / total_;
  if (is_terminal_ ? done != total_ && !is_due() : tenth == last_tenth_ && !is_due()) return;
  last_tenth_ = tenth;
  const double left = seconds(std::chrono::steady_clock::now() - start_) / done * (total_ - done);
  write(fmt::format("{}: {}/{}  {}  {:.0f} s left", label_, done, total_, detail, left));
}

bool Progress::is_due() const {
  constexpr double on_terminal = 0.1, in_log = 10.0;  // s
  return progress_enabled && seconds(std::chrono::steady_clock::now() - last_) >= (is_terminal_ ? on_terminal : in_log);
}

void Progress::tell(const std::string& detail) {
  if (!is_due()) return;
  write(fmt::format("{}: {}/{} after {:.0f} s  {}", label_, done_, total_,
                    seconds(std::chrono::steady_clock::now() - start_), detail));
}

}  // namespace dygita
