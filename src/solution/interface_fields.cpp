#include "solution/interface_fields.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "base/log.hpp"

namespace dygita {

InterfaceFields::InterfaceFields(std::FILE* file, const std::vector<std::vector<Place>>& steps)
    : budget_(0.0), file_(file) {
  for (const std::vector<Place>& places : steps) {
    begin_step();
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

}  // namespace dygita
