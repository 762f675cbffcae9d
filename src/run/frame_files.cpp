#include "run/frame_files.hpp"

#include <algorithm>
#include <functional>

#include "base/error.hpp"
#include "ranks/ranks.hpp"

namespace dygita {

FrameFiles::FrameFiles(RunWriter* writer, Unwritten& unwritten)
    : writer_(writer),
      unwritten_(unwritten),
      directory_(ranks::shared(writer ? std::filesystem::absolute(writer->directory()).string() : std::string())) {}

void FrameFiles::write(const Frame& frame) {
  std::string error;
  try {
    if (writer_ && unwritten_.is_empty()) writer_->begin_frame(frame);
    if (!writer_) write_parts(frame, n_frames_, directory_);
  } catch (const InputError& what) {
    error = what.what();
  }
  ++n_frames_;
  const FrameSummary summary = summary_of_all(frame);
  const std::vector<std::string> errors = ranks::gathered(error);
  if (!writer_ || !unwritten_.is_empty()) return;
  unwritten_.attempt_frame([&] {
    for (const std::string& of_rank : errors)
      if (!of_rank.empty()) throw InputError(of_rank);
    writer_->end_frame(frame, summary);
  });
}

// Of what each rank has, rank 0 needs no more than the largest of all.
FrameSummary FrameFiles::summary_of_all(const Frame& frame) const {
  FrameSummary summary = summary_of(frame);
  if (ranks::is_alone()) return summary;
  summary.displacement = ranks::largest(summary.displacement);
  std::vector<double> own = stresses_of(frame);
  const size_t n = n_exceeding(static_cast<size_t>(ranks::sums({static_cast<double>(own.size())})[0]));
  const size_t kept = std::min(own.size(), n + 1);
  std::partial_sort(own.begin(), own.begin() + static_cast<long>(kept), own.end(), std::greater<>());
  own.resize(kept);
  std::vector<double> all = own;
  for (int rank = 1; rank < ranks::count(); ++rank) {
    const std::vector<double> others = ranks::to_first(rank, own);
    if (ranks::is_first()) all.insert(all.end(), others.begin(), others.end());
  }
  if (ranks::is_first()) summary.von_mises = exceeded_by(n, all);
  return summary;
}

}  // namespace dygita
