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
      start_(std::chrono::steady_clock::now()) {}

Progress::~Progress() {
  if (line_is_open_) std::fputs("\n", stderr);
}

void Progress::update(int done, const std::string& detail) {
  if (!progress_enabled) return;
  const auto now = std::chrono::steady_clock::now();
  const bool is_last = done == total_;
  const double left = seconds(now - start_) / done * (total_ - done);
  const std::string text = fmt::format("{}: {}/{}  {}  {:.0f} s left", label_, done, total_, detail, left);
  if (is_terminal_) {
    if (!is_last && seconds(now - last_) < 0.1) return;
    last_ = now;
    std::fputs(("\r\033[K" + text).c_str(), stderr);
    std::fflush(stderr);
    line_is_open_ = true;
  } else if (const int tenth = 10 * done / total_; tenth > last_tenth_) {
    last_tenth_ = tenth;
    std::fputs((text + "\n").c_str(), stderr);
  }
}

}  // namespace dygita
