#include "interfaces/interface_fields.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "base/log.hpp"

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

InterfaceFields::InterfaceFields(std::vector<FieldPart> parts, const std::vector<std::vector<Eigen::Index>>& sizes)
    : budget_(0.0) {
  std::vector<size_t> n_increments;
  for (const std::vector<Eigen::Index>& of_step : sizes) {
    begin_step({});
    n_increments.push_back(of_step.size());
    for (const Eigen::Index size : of_step) {
      Kept kept;
      kept.size = size;
      steps_.back().push_back(std::move(kept));
    }
  }
  parts_ = std::make_unique<FieldParts>(std::move(parts), std::move(n_increments));
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
           ": later cases start from the last stored fields; results are not affected");
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
  AssembledRuns all{static_cast<long>(size), {}};
  if (size > 0) all.runs.push_back({0, all.n_all});
  return read_some(i_step, increment, all, q);
}

bool InterfaceFields::read_some(size_t i_step, size_t increment, const AssembledRuns& asked, Vec& q) const {
  if (i_step >= steps_.size() || increment >= steps_[i_step].size()) return false;
  const Kept& kept = steps_[i_step][increment];
  if (kept.size != asked.n_all) return false;
  Vec found(asked.n_kept());
  if (parts_) {
    if (!parts_->read(i_step, increment, asked, found)) return false;
    q = std::move(found);
    return true;
  }
  long at = 0;
  for (const AssembledRuns::Run& run : asked.runs) {
    const auto n = static_cast<size_t>(run.n);
    if (kept.at < 0)
      found.segment(at, run.n) = kept.q.segment(run.first, run.n);
    else if (fseeko(file_.get(), kept.at + 8 * static_cast<std::int64_t>(run.first), SEEK_SET) != 0 ||
             std::fread(found.data() + at, sizeof(double), n, file_.get()) != n)
      return false;
    at += run.n;
  }
  q = std::move(found);
  return true;
}

}  // namespace dygita
