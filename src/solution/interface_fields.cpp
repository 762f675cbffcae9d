#include "solution/interface_fields.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "base/log.hpp"
#include "ranks/ranks.hpp"

namespace dygita {

InterfaceFields::InterfaceFields(std::FILE* file, const std::vector<std::vector<Place>>& steps)
    : budget_(0.0), file_(file) {
  for (const std::vector<Place>& places : steps) {
    begin_step({});
    for (const Place& place : places) {
      Kept kept;
      kept.at = place.at;
      kept.size = place.size;
      steps_.back().push_back(std::move(kept));
      file_end_ = std::max(file_end_, place.at + 8 * static_cast<std::int64_t>(place.size));
    }
  }
}

void InterfaceFields::append(const Vec& q) {
  if (has_failed_) return;
  Kept kept;
  kept.size = q.size();
  const double bytes = 8.0 * static_cast<double>(q.size());
  if (in_memory_ + bytes <= budget_) {
    kept.q = q;
    in_memory_ += bytes;
  } else {
    kept.at = file_end_;
    if (!write(q)) {
      has_failed_ = true;
      warn("the interface fields cannot be written to " + std::filesystem::temp_directory_path().string() +
           ": later cases start from what was kept until here, the results are not touched");
      return;
    }
  }
  steps_.back().push_back(std::move(kept));
}

bool InterfaceFields::write(const Vec& q) {
  if (!file_) {
    std::string name = (std::filesystem::temp_directory_path() / "dygita_fields_XXXXXX").string();
    const int descriptor = mkstemp(name.data());
    if (descriptor < 0) return false;
    unlink(name.c_str());
    file_.reset(fdopen(descriptor, "w+b"));
    if (!file_) {
      close(descriptor);
      return false;
    }
  }
  const auto n = static_cast<size_t>(q.size());
  if (fseeko(file_.get(), file_end_, SEEK_SET) != 0 || std::fwrite(q.data(), sizeof(double), n, file_.get()) != n ||
      std::fflush(file_.get()) != 0)
    return false;
  file_end_ += static_cast<std::int64_t>(n * sizeof(double));
  return true;
}

bool InterfaceFields::read(size_t i_step, size_t increment, Eigen::Index size, Vec& q) const {
  if (i_step >= steps_.size() || increment >= steps_[i_step].size()) return false;
  const Kept& kept = steps_[i_step][increment];
  if (kept.size != size) return false;
  if (kept.at < 0 || size == 0) {
    q = kept.q;
    return true;
  }
  Vec from_file(size);
  const auto n = static_cast<size_t>(size);
  if (fseeko(file_.get(), kept.at, SEEK_SET) != 0 || std::fread(from_file.data(), sizeof(double), n, file_.get()) != n)
    return false;
  q = std::move(from_file);
  return true;
}

std::shared_ptr<const InterfaceFields> whole_on_first(const std::shared_ptr<const InterfaceFields>& kept,
                                                      double memory_bytes) {
  if (ranks::is_alone() || !kept) return kept;
  auto whole = std::make_shared<InterfaceFields>(memory_bytes);
  for (size_t s = 0; s < kept->n_steps(); ++s) {
    whole->begin_step();
    const AssembledRuns& runs = kept->runs(s);
    std::vector<double> of_runs;
    for (const AssembledRuns::Run& run : runs.runs)
      of_runs.insert(of_runs.end(), {static_cast<double>(run.first), static_cast<double>(run.n)});
    std::vector<AssembledRuns> of_ranks;
    for (int rank = 0; rank < ranks::count(); ++rank) {
      const std::vector<double> numbers = ranks::to_first(rank, of_runs);
      AssembledRuns& of_rank = of_ranks.emplace_back();
      for (size_t i = 0; i < numbers.size(); i += 2)
        of_rank.runs.push_back({static_cast<long>(numbers[i]), static_cast<long>(numbers[i + 1])});
    }
    const auto n_increments = -ranks::largest(-static_cast<double>(kept->n_increments(s)));
    for (size_t i = 0; i < static_cast<size_t>(n_increments); ++i) {
      Vec own, all(ranks::is_first() ? runs.n_all : 0);
      kept->read(s, i, kept->size(s, i), own);
      for (int rank = 0; rank < ranks::count(); ++rank) {
        const std::vector<double> brought = ranks::to_first(rank, {own.begin(), own.end()});
        if (ranks::is_first())
          of_ranks[static_cast<size_t>(rank)].place(
              Eigen::Map<const Vec>(brought.data(), static_cast<Eigen::Index>(brought.size())), all);
      }
      if (ranks::is_first()) whole->append(all);
    }
  }
  return ranks::is_first() ? whole : nullptr;
}

}  // namespace dygita
