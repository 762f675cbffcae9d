#include "base/log.hpp"

#include <algorithm>
#include <cstdio>
#include <mutex>
#include <optional>
#include <regex>
#include <set>
#include <utility>

#include "base/kept_lines.hpp"
#include "base/names.hpp"
#include "base/task.hpp"
#include "base/warnings.hpp"

namespace dygita {

namespace {
std::mutex log_mutex;
std::vector<std::string> kept_warnings;
size_t n_serious = 0;  // of them, at the front
bool is_silent = false;
std::vector<std::string>* kept_lines = nullptr;

struct Waiting {
  KindOfWarning of;
  std::string message;
};
std::vector<Waiting> waiting;

struct Alike {
  std::set<std::string> said;  // without their numbers
  int n_unsaid = 0;
};
std::optional<Alike> alike;

// "spectrum 'a1' up to 1.5e-3 dB" as "spectrum 'a1' up to # dB": numbers in names stay.
std::string without_numbers(const std::string& text) {
  static const std::regex name_or_number(R"('[^']*'|[-+]?\d+(\.\d*)?(e[-+]?\d+)?)");
  std::string kept;
  auto rest = text.begin();
  for (std::sregex_iterator found(text.begin(), text.end(), name_or_number), none; found != none; ++found) {
    kept.append(rest, (*found)[0].first);
    kept += *(*found)[0].first == '\'' ? found->str() : "#";
    rest = (*found)[0].second;
  }
  return kept.append(rest, text.end());
}

// With the mutex held.
void keep(const std::string& message, bool is_serious) {
  if (std::find(kept_warnings.begin(), kept_warnings.end(), message) != kept_warnings.end()) return;
  kept_warnings.insert(
      is_serious ? kept_warnings.begin() + static_cast<std::ptrdiff_t>(n_serious++) : kept_warnings.end(), message);
  if (is_silent) return;
  if (alike && !is_serious && !alike->said.insert(without_numbers(message)).second) {
    ++alike->n_unsaid;
    return;
  }
  leave_progress_line();
  std::fputs(("warning: " + printable(message) + "\n").c_str(), stderr);
}

// The worst of a kind, and the subjects of the others.
std::string merged(std::vector<Waiting> kind) {
  constexpr size_t most_named = 5;
  std::stable_sort(kind.begin(), kind.end(), [](const Waiting& a, const Waiting& b) { return a.of.rank > b.of.rank; });
  if (kind.size() == 1) return kind.front().message;
  std::vector<std::string> others;
  for (const Waiting& one : kind)
    if (const std::string& subject = one.of.subject;
        subject != kind.front().of.subject && std::find(others.begin(), others.end(), subject) == others.end())
      others.push_back(subject);
  std::string text = fmt::format("{}\n    the worst of {} of this kind", kind.front().message, kind.size());
  for (size_t i = 0; i < std::min(others.size(), most_named); ++i)
    text += (i > 0 ? ", " : others.size() == 1 ? "; the other: " : "; the others: ") + others[i];
  return others.size() > most_named ? text + fmt::format(" and {} more", others.size() - most_named) : text;
}

void tell(bool is_serious) {
  std::vector<std::string> kinds;
  for (const Waiting& one : waiting)
    if (one.of.is_serious == is_serious && std::find(kinds.begin(), kinds.end(), one.of.kind) == kinds.end())
      kinds.push_back(one.of.kind);
  for (const std::string& kind : kinds) {
    std::vector<Waiting> all;
    for (const Waiting& one : waiting)
      if (one.of.kind == kind && one.of.is_serious == is_serious) all.push_back(one);
    keep(merged(all), is_serious);
  }
}
}  // namespace

void say(const std::string& line) {
  const std::scoped_lock lock(log_mutex);
  if (is_silent) return;
  if (kept_lines) return kept_lines->push_back(line);
  leave_progress_line();
  std::fputs((printable(line) + "\n").c_str(), stdout);
  std::fflush(stdout);
}

void keep_lines(std::vector<std::string>* there) {
  const std::scoped_lock lock(log_mutex);
  kept_lines = there;
}

void warn(const std::string& message) {
  const std::scoped_lock lock(log_mutex);
  keep(message, false);
}

void warn(const std::string& message, const KindOfWarning& of) {
  const std::scoped_lock lock(log_mutex);
  const auto is_same = [&](const Waiting& one) { return one.message == message; };
  if (std::none_of(waiting.begin(), waiting.end(), is_same)) waiting.push_back({of, message});
}

void tell_warnings() {
  const std::scoped_lock lock(log_mutex);
  for (const bool is_serious : {true, false}) tell(is_serious);
  waiting.clear();
}

SayAlikeOnce::SayAlikeOnce() {
  const std::scoped_lock lock(log_mutex);
  alike.emplace();
}

SayAlikeOnce::~SayAlikeOnce() {
  const std::scoped_lock lock(log_mutex);
  alike.reset();
}

int SayAlikeOnce::n_unsaid() const {
  const std::scoped_lock lock(log_mutex);
  return alike ? alike->n_unsaid : 0;
}

void be_silent() {
  const std::scoped_lock lock(log_mutex);
  is_silent = true;
}

std::vector<std::string> take_warnings() {
  tell_warnings();
  const std::scoped_lock lock(log_mutex);
  n_serious = 0;
  return std::exchange(kept_warnings, {});
}

}  // namespace dygita
