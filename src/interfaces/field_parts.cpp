#include "interfaces/field_parts.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>

namespace dygita {

namespace {

constexpr int most_open = 200;  // files; a process may have a thousand

}  // namespace

FieldParts::FieldParts(std::vector<FieldPart> parts, std::vector<size_t> n_increments)
    : parts_(std::move(parts)), descriptors_(parts_.size(), -1) {
  for (const FieldPart& part : parts_) {
    std::vector<std::int64_t>& starts = start_.emplace_back();
    std::int64_t at = part.begin;
    for (size_t s = 0; s < n_increments.size(); ++s) {
      starts.push_back(at);
      at += 8 * static_cast<std::int64_t>(part.runs[s].n_kept()) * static_cast<std::int64_t>(n_increments[s]);
    }
  }
}

FieldParts::~FieldParts() { close_all(); }

void FieldParts::close_all() {
  for (int& descriptor : descriptors_)
    if (descriptor >= 0) {
      close(descriptor);
      descriptor = -1;
    }
  n_open_ = 0;
}

bool FieldParts::get(size_t part, const Place& place) {
  int& descriptor = descriptors_[part];
  if (descriptor < 0) {
    if (n_open_ >= most_open) close_all();
    descriptor = open(parts_[part].file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return false;
    ++n_open_;
  }
  char* to = reinterpret_cast<char*>(place.to);
  for (std::int64_t done = 0, bytes = 8 * static_cast<std::int64_t>(place.n); done < bytes;) {
    const ssize_t n = pread(descriptor, to + done, static_cast<size_t>(bytes - done), place.at + done);
    if (n <= 0) return false;
    done += n;
  }
  return true;
}

bool FieldParts::read(size_t i_step, size_t increment, const AssembledRuns& asked, Vec& q) {
  q.resize(asked.n_kept());
  for (size_t p = 0; p < parts_.size(); ++p) {
    const AssembledRuns& kept = parts_[p].runs[i_step];
    std::int64_t at =
        start_[p][i_step] + 8 * static_cast<std::int64_t>(kept.n_kept()) * static_cast<std::int64_t>(increment);
    auto first = asked.runs.begin();  // that does not end before the run of this part
    long before = 0;                  // unknowns asked for before it
    for (const AssembledRuns::Run& run : kept.runs) {
      const long end = run.first + run.n;
      for (; first != asked.runs.end() && first->first + first->n <= run.first; ++first) before += first->n;
      long to = before;
      for (auto one = first; one != asked.runs.end() && one->first < end; to += one->n, ++one) {
        const long from = std::max(one->first, run.first), n = std::min(one->first + one->n, end) - from;
        if (!get(p, {at + 8 * (from - run.first), n, q.data() + to + (from - one->first)})) return false;
      }
      at += 8 * run.n;
    }
  }
  return true;
}

}  // namespace dygita
