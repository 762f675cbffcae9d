#include "run/frame_files.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

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

namespace {

// The value, of all ranks' values none of which is negative, that n others exceed: its bits, which increase with it,
// are halved in on, so that no rank is sent what others have.
double exceeded_by_of_all(size_t n, const std::vector<double>& own) {
  std::uint64_t below = 0, above = std::bit_cast<std::uint64_t>(std::numeric_limits<double>::max());
  while (below < above) {
    const std::uint64_t middle = below + (above - below) / 2;
    const auto value = std::bit_cast<double>(middle);
    const auto n_more = std::count_if(own.begin(), own.end(), [&](double x) { return x > value; });
    if (ranks::sums({static_cast<double>(n_more)})[0] <= static_cast<double>(n))
      above = middle;
    else
      below = middle + 1;
  }
  return std::bit_cast<double>(below);
}

}  // namespace

FrameSummary FrameFiles::summary_of_all(const Frame& frame) const {
  FrameSummary summary = summary_of(frame);
  if (ranks::is_alone()) return summary;
  summary.displacement = ranks::largest(summary.displacement);
  const std::vector<double> own = stresses_of(frame);
  const auto n_all = static_cast<size_t>(ranks::sums({static_cast<double>(own.size())})[0]);
  summary.von_mises = n_all > 0 ? exceeded_by_of_all(n_exceeding(n_all), own) : 0.0;
  return summary;
}

}  // namespace dygita
