#include "base/progress.hpp"

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <string_view>
#include <utility>

#include "base/kept_lines.hpp"
#include "base/task.hpp"

namespace dygita {

namespace {

volatile std::sig_atomic_t progress_enabled = 1, interrupt_flag = 0;
std::atomic<bool> interrupts_are_heeded = true, was_interrupted = false, line_is_open = false;
std::mutex task_mutex;
Task* at_task = nullptr;  // begun last of those that go on, with the mutex held

constexpr double on_terminal = 0.1, in_log = 10.0;  // s, between two lines

void on_signal(int signal_number) {
  interrupt_flag = 1;
  std::signal(signal_number, SIG_DFL);
  constexpr std::string_view heard = "stopping; a second signal ends at once\n";
  if (progress_enabled && write(STDERR_FILENO, heard.data(), heard.size()) < 0) return;
}

void write_line(const std::string& text, bool is_terminal) {
  std::fputs((is_terminal ? "\r\033[K" + text : text + "\n").c_str(), stderr);
  std::fflush(stderr);
  line_is_open = is_terminal;
}

double seconds(std::chrono::steady_clock::duration d) { return std::chrono::duration<double>(d).count(); }

}  // namespace

void set_progress_enabled(bool enabled) { progress_enabled = enabled ? 1 : 0; }

bool is_progress_enabled() { return progress_enabled != 0; }

void leave_progress_line() {
  if (line_is_open.exchange(false)) std::fputs("\r\033[K", stderr);
}

void heed_interrupt() {
  const std::scoped_lock lock(task_mutex);
  if (!at_task) return;
  if (interrupt_requested() && interrupts_are_heeded && at_task->may_end_) throw Interrupted();
  const std::scoped_lock its(at_task->mutex_);
  at_task->write_if_due();
}

Interrupted::Interrupted() { was_interrupted = true; }

bool task_was_interrupted() { return was_interrupted; }

void set_interrupts_heeded(bool heeded) { interrupts_are_heeded = heeded; }

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
  if (line_is_open_ && line_is_open.exchange(false)) std::fputs("\n", stderr);
}

void Progress::write(const std::string& text) {
  last_ = std::chrono::steady_clock::now();
  write_line(text, is_terminal_);
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
  return progress_enabled && seconds(std::chrono::steady_clock::now() - last_) >= (is_terminal_ ? on_terminal : in_log);
}

void Progress::tell(const std::string& detail) {
  if (!is_due()) return;
  write(fmt::format("{}: {}/{} after {:.0f} s  {}", label_, done_, total_,
                    seconds(std::chrono::steady_clock::now() - start_), detail));
}

Task::Task(std::string label, int total, Interrupts interrupts)
    : around_(nullptr),
      label_(std::move(label)),
      total_(total),
      may_end_(interrupts == Interrupts::end_it),
      is_terminal_(isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()),
      last_(start_) {
  const std::scoped_lock lock(task_mutex);
  around_ = std::exchange(at_task, this);
}

// Not always the last one ends first: ranks may be threads of one process.
Task::~Task() {
  const std::scoped_lock lock(task_mutex);
  Task** link = &at_task;
  while (*link != this) link = &(*link)->around_;
  *link = around_;
  leave_progress_line();
}

void Task::done(const std::string& what) {
  {
    const std::scoped_lock lock(mutex_);
    ++done_;
    doing_ = what;
    write_if_due();
  }
  heed_interrupt();
}

void Task::tell(const std::string& doing) {
  {
    const std::scoped_lock lock(mutex_);
    doing_ = doing;
    write_if_due();
  }
  heed_interrupt();
}

void Task::write_if_due() {
  const auto now = std::chrono::steady_clock::now();
  if (!progress_enabled || seconds(now - last_) < (is_terminal_ ? on_terminal : in_log)) return;
  last_ = now;
  const double taken = seconds(now - start_);
  std::string text = label_ + (total_ > 0 ? fmt::format(": {}/{}  {}", done_, total_, doing_) : ": " + doing_);
  text += done_ > 0 ? fmt::format("  {:.0f} s left", taken / done_ * (total_ - done_))
                    : fmt::format("  after {:.0f} s", taken);
  write_line(text, is_terminal_);
}

}  // namespace dygita
