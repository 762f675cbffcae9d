#include "run/side_by_side.hpp"

#include <algorithm>
#include <chrono>

#include "base/kept_lines.hpp"
#include "base/log.hpp"
#include "base/progress.hpp"
#include "base/turns.hpp"
#include "ranks/ranks.hpp"
#include "run/passes.hpp"
#include "step/shared_operators.hpp"

namespace dygita {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Of up to sixteen: the line of progress is that of the first that goes on.
class Batch {
 public:
  Batch(int first, int n, const std::function<void(int)>& run, std::vector<double>& seconds)
      : first_(first), run_(run), seconds_(seconds), lines_(static_cast<size_t>(n)), is_over_(lines_.size(), 0) {}

  void run() {
    std::vector<std::function<void()>> all;
    for (int i = 0; i < static_cast<int>(lines_.size()); ++i) all.emplace_back([this, i] { run_one(i); });
    const Clock::time_point start = Clock::now();
    Turns::run(
        all, [this](int i) { enter(i); }, [this](int i) { leave(i); });
    double own = 0.0;
    for (size_t i = 0; i < lines_.size(); ++i) own += seconds_[static_cast<size_t>(first_) + i];
    const double shared = (seconds_since(start) - own) / static_cast<double>(lines_.size());
    for (size_t i = 0; i < lines_.size(); ++i) seconds_[static_cast<size_t>(first_) + i] += shared;
  }

 private:
  // What it has said is lost with an error, which tells more.
  void run_one(int i) {
    struct Over {
      char& it;
      ~Over() { it = 1; }
    } const over{is_over_[static_cast<size_t>(i)]};
    run_(first_ + i);
    keep_lines(nullptr);
    for (const std::string& line : lines_[static_cast<size_t>(i)]) say(line);
  }
  void enter(int i) {
    const auto ahead = std::find(is_over_.begin(), is_over_.end(), 0);
    set_progress_enabled(shows_progress_ && ahead - is_over_.begin() == i);
    keep_lines(&lines_[static_cast<size_t>(i)]);
    start_ = Clock::now();
  }
  void leave(int i) {
    seconds_[static_cast<size_t>(first_ + i)] += seconds_since(start_);
    keep_lines(nullptr);
    set_progress_enabled(shows_progress_);
  }

  const int first_;
  const std::function<void(int)>& run_;
  std::vector<double>& seconds_;
  std::vector<std::vector<std::string>> lines_;
  std::vector<char> is_over_;
  const bool shows_progress_ = is_progress_enabled();
  Clock::time_point start_;
};

}  // namespace

bool can_run_together(const Problem& problem, const OperatorsOfMembers& shared) {
  const std::vector<double> passes = pass_tolerances(problem);
  return ranks::is_alone() && std::all_of(passes.begin(), passes.end(), [&](double tolerance) {
           const auto found = shared.find(tolerance);
           return found != shared.end() && found->second->have_all();
         });
}

std::vector<double> run_together(int n, const std::function<void(int)>& run) {
  std::vector<double> seconds(static_cast<size_t>(n), 0.0);
  const int n_batches = (n + most_together - 1) / most_together;
  for (int i = 0; i < n_batches; ++i) {
    const int first = i * n / n_batches, end = (i + 1) * n / n_batches;
    Batch(first, end - first, run, seconds).run();
  }
  return seconds;
}

}  // namespace dygita
