// Frames of a run on disk: each rank writes what it has of the parts, rank 0 the rest and the lists.
#pragma once

#include "files/run_writer.hpp"
#include "run/unwritten.hpp"

namespace dygita {

class FrameFiles {
 public:
  // Collective. writer: rank 0's, null on the others.
  FrameFiles(RunWriter* writer, Unwritten& unwritten);
  // Collective. A frame that cannot be written, by whomever, ends the run after its increment.
  void write(const Frame& frame);

 private:
  FrameSummary summary_of_all(const Frame& frame) const;

  RunWriter* writer_;
  Unwritten& unwritten_;
  std::filesystem::path directory_;
  size_t n_frames_ = 0;
};

}  // namespace dygita
