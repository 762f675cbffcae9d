// What another rank than the first leaves of each increment: its share of a checkpoint, in a file of its own beside it
// (<checkpoint>.parts/<rank>). Any number of ranks resumes from all of them.
#pragma once

#include <chrono>
#include <filesystem>
#include <vector>

#include "persistence/open_file.hpp"
#include "persistence/state_coder.hpp"
#include "step/trail.hpp"

namespace dygita {

std::filesystem::path parts_folder(const std::filesystem::path& checkpoint);

// A rank's share of an entry: number of the entry in the run, runs of unknowns and their q, moved pieces.
struct EntryShare {
  std::uint64_t number = 0;
  AssembledRuns runs;
  Vec q, uncorrected;
  std::vector<std::uint64_t> moved;
};

// Of one run: `head` is that of its checkpoint (CheckpointFile::head).
class CheckpointPart final : public Trail {
 public:
  // every: s between two times that it is brought to the disk. Nothing is made yet.
  CheckpointPart(const std::filesystem::path& checkpoint, int rank, std::uint64_t head, double every);
  ~CheckpointPart() override;
  bool leads(long) override { return false; }
  long n_left() const override { return 0; }
  TrailEntry take() override;
  void leave(const TrailEntry& entry) override;
  void note_difference() override {}

 private:
  void open();
  void fail(const std::string& reason);

  std::filesystem::path path_;
  std::uint64_t head_, sum_ = 0, number_ = 0;
  double every_;
  OpenFile file_;
  std::chrono::steady_clock::time_point flushed_, synced_;
  double room_ = 0.0;  // bytes that it may still take
  bool has_failed_ = false;
};

// The parts that a run has left, as the first rank reads them.
class CheckpointParts {
 public:
  // Those of the checkpoint with this head; what a crash has cut off, and parts of another, do not count.
  CheckpointParts(const std::filesystem::path& checkpoint, std::uint64_t head);
  // Unknowns of an entry that parts have.
  long n_unknowns(std::uint64_t number) const;
  // Puts the shares of an entry into it. Throws InputError where they cannot be read.
  void add_to(std::uint64_t number, TrailEntry& entry);
  // Nothing from this entry on stays.
  void cut(std::uint64_t number);

 private:
  struct Record {
    std::uint64_t number, before;  // before: sum of the record before it
    std::int64_t at;
    long n_unknowns;
  };
  struct Part {
    OpenFile file;
    std::vector<Record> records;  // numbers increase
    std::int64_t end = 0;
  };
  static const Record* find(const Part& part, std::uint64_t number);
  std::vector<Part> parts_;
};

}  // namespace dygita
