// The checkpoint of a run that has not come to its end: what `dygita continue` goes over again after the run was
// stopped or killed (manual, "The checkpoint").
#pragma once

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "persistence/checkpoint_part.hpp"
#include "persistence/state_file.hpp"
#include "step/trail.hpp"

namespace dygita {

inline constexpr const char* checkpoint_file_name = own_file::checkpoint;

// Whose checkpoint it is.
struct CheckpointIdentity {
  RunState state;          // without fields
  std::string kernels;     // "avx512", "avx2" or "generic"
  std::string purpose;     // what a continued run was asked for; empty: a run of the deck
  bool has_start = false;  // the iteration started from another case's fields
  bool has_frames = true;  // else --no-frames
  std::string from;        // folder of the run that its static steps started from; empty: none
};

// As bytes, and back. Throws InputError (damaged).
std::string bytes_of(const CheckpointIdentity& identity);
CheckpointIdentity checkpoint_identity_of(std::string bytes);

// Entries are appended, each with a checksum that continues from the one before; what a crash has cut off is dropped
// when the file is read. Entries reach the system within a second, and the disk every so often. Of several ranks the
// others leave their shares beside it (checkpoint_part.hpp): an entry counts where all are there.
class CheckpointFile final : public Trail {
 public:
  // Begins a new one in the place of whatever is there. every: s between two times that it is brought to the disk.
  // Throws InputError with the system's reason.
  CheckpointFile(std::filesystem::path path, const CheckpointIdentity& identity, double every);
  // Goes on with one. Throws InputError: none, another version or machine, damaged before its first entry.
  CheckpointFile(std::filesystem::path path, double every);
  ~CheckpointFile() override;

  const CheckpointIdentity& identity() const { return identity_; }
  const std::filesystem::path& path() const { return path_; }
  std::uint64_t head() const { return head_; }  // told apart from others by it
  bool leads(long n) override;
  long n_left() const override { return n_left_; }
  bool has_entries() const { return n_left_ > 0 || has_foreseen_; }
  TrailEntry take() override;
  void leave(const TrailEntry& entry) override;
  void note_difference() override;
  // Brings everything to the disk.
  void sync();
  // So many entries are to come in all: says in advance what they need and cannot have. What is kept stays below half
  // of the space that is free now, so that the results find room.
  void expect(long entries) { expected_ = entries; }

 private:
  using Clock = std::chrono::steady_clock;
  void read_header();
  void scan();
  void complete(TrailEntry& entry);
  bool is_complete(const std::string& payload, std::uint64_t number) const;
  void fail(const char* what);
  void foresee(std::int64_t bytes_of_entry);
  void stop_growing();

  std::filesystem::path path_;
  OpenFile file_;
  std::unique_ptr<char[]> buffer_;
  CheckpointIdentity identity_;
  std::optional<CheckpointParts> parts_;  // of a checkpoint that is read
  std::uint64_t head_ = 0, number_ = 0;   // number of the next entry
  long n_left_ = 0;                       // entries to be taken
  long expected_ = 0;                     // in all; 0: nobody told
  double room_ = 0.0;                     // bytes that it may still take, once that is foreseen
  bool has_foreseen_ = false;
  std::int64_t entries_at_ = 0;  // where the first one is, bytes
  std::int64_t at_ = 0;          // where the next one is taken or left, bytes
  std::uint64_t sum_ = 0;        // of the entry before it
  double every_;
  Clock::time_point flushed_, synced_;
  bool is_leaving_ = false, has_failed_ = false, has_differed_ = false;
};

}  // namespace dygita
