#include "persistence/checkpoint_file.hpp"

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <limits>

#include "base/error.hpp"
#include "base/log.hpp"
#include "base/plain_file.hpp"
#include "persistence/record_chain.hpp"
#include "persistence/state_coder.hpp"
#include "ranks/ranks.hpp"

namespace dygita {

namespace {

constexpr char checkpoint_magic[] = "DYGITACP";  // 8 bytes
constexpr std::uint32_t checkpoint_version = 1;
constexpr size_t buffer_bytes = size_t{1} << 20;

template <class Coder>
void code_missed(Coder& code, Missed& missed) {
  code_number(code, missed.increment), code_number(code, missed.iterations);
  code(missed.indicator), code(missed.tolerance), code_number(code, missed.is_falling);
  bool has_halving = missed.halving.has_value();
  double halving = missed.halving.value_or(0.0);
  code_number(code, has_halving), code(halving);
  if (has_halving) missed.halving = halving;
}

// A file of several names, as in a backup by hard links, is copied, so that the others keep what they have.
void leave_other_names(const std::filesystem::path& path) {
  namespace fs = std::filesystem;
  std::error_code error, ignored;
  if (fs::hard_link_count(path, error) <= 1 || error) return;
  const fs::path copy = path.string() + ".tmp";
  fs::remove(copy, ignored);
  if (fs::copy_file(path, copy, error)) fs::rename(copy, path, error);
  if (error)
    throw InputError(
        fmt::format("'{}' is a second name of another file, and cannot be copied: {}", path.string(), error.message()));
}

bool is_sound(const TrailEntry& entry) {
  return entry.runs.fit(entry.q.size()) &&
         (entry.uncorrected.size() == 0 || entry.uncorrected.size() == entry.q.size());
}

template <class Coder>
void code_entry(Coder& code, TrailEntry& entry) {
  code_vector(code, entry.q), code_vector(code, entry.uncorrected), code_vector(code, entry.shortening);
  std::string moved(entry.moved.begin(), entry.moved.end());
  code(moved);
  entry.moved.assign(moved.begin(), moved.end());
  code(entry.eta), code(entry.size), code(entry.force_size);
  int flags = (entry.is_solved ? 1 : 0) + (entry.is_assembled ? 2 : 0) + (entry.runs.is_whole() ? 0 : 4);
  code_number(code, entry.iterations), code_number(code, flags);
  entry.is_solved = (flags & 1) != 0;
  entry.is_assembled = (flags & 2) != 0;
  bool is_missed = entry.missed.has_value();
  code_number(code, is_missed);
  if (is_missed) {
    if (!entry.missed) entry.missed.emplace();
    code_missed(code, *entry.missed);
  }
  if ((flags & 4) == 0) return;
  code_runs(code, entry.runs);
  if (std::is_same_v<Coder, Decoder> && !is_sound(entry)) throw InputError("an entry does not fit together");
}

template <class Coder>
void code_identity(Coder& code, CheckpointIdentity& identity, std::string& state) {
  int flags = (identity.has_start ? 1 : 0) + (identity.has_frames ? 0 : 2) + (identity.from.empty() ? 0 : 4);
  code(state), code(identity.kernels), code(identity.purpose), code_number(code, flags);
  identity.has_start = (flags & 1) != 0;
  identity.has_frames = (flags & 2) == 0;
  if ((flags & 4) != 0) code(identity.from);
}

}  // namespace

std::string bytes_of(const CheckpointIdentity& identity) {
  Encoder encoder;
  CheckpointIdentity coded = identity;
  std::string state = identity_bytes(identity.state);
  code_identity(encoder, coded, state);
  return encoder.bytes;
}

CheckpointIdentity checkpoint_identity_of(std::string bytes) {
  CheckpointIdentity identity;
  std::string state;
  Decoder decoder(std::move(bytes));
  code_identity(decoder, identity, state);
  identity.state = state_of_identity(std::move(state));
  return identity;
}

CheckpointFile::CheckpointFile(std::filesystem::path path, const CheckpointIdentity& identity, double every)
    : path_(std::move(path)),
      buffer_(new char[buffer_bytes]),
      identity_(identity),
      every_(every),
      flushed_(Clock::now()),
      synced_(flushed_),
      is_leaving_(true) {
  const std::string temporary = path_.string() + ".tmp";
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);  // a link there would lead to a file of somebody's
  errno = 0;
  file_.reset(std::fopen(temporary.c_str(), "w+bx"));
  remove_parts(parts_folder(path_));  // they go with what is there
  const std::string header = bytes_of(identity);
  head_ = sum_ = chained_sum(0, header);
  if (file_) std::setvbuf(file_.get(), buffer_.get(), _IOFBF, buffer_bytes);
  if (!file_ || !put(file_.get(), checkpoint_magic, 8) || !put(file_.get(), &checkpoint_version, 4) ||
      !put(file_.get(), &byte_order, 4) || !put_record(file_.get(), header, sum_) || std::fflush(file_.get()) != 0 ||
      std::rename(temporary.c_str(), path_.c_str()) != 0) {
    const std::string why = reason_not_written(errno);
    if (file_) std::filesystem::remove(temporary, ignored);
    throw InputError(fmt::format("cannot write '{}': {}", path_.string(), why));
  }
  entries_at_ = ftello(file_.get());
}

CheckpointFile::CheckpointFile(std::filesystem::path path, double every)
    : path_(std::move(path)),
      buffer_(new char[buffer_bytes]),
      every_(every),
      flushed_(Clock::now()),
      synced_(flushed_) {
  require_file(path_);
  if (std::filesystem::is_symlink(path_))  // to be written to, as the run continues
    throw InputError(fmt::format("'{}' is a link, and not a checkpoint of dygita", path_.string()));
  leave_other_names(path_);
  file_.reset(std::fopen(path_.c_str(), "r+b"));
  if (!file_) throw InputError(fmt::format("cannot read '{}': {}", path_.string(), std::strerror(errno)));
  std::setvbuf(file_.get(), buffer_.get(), _IOFBF, buffer_bytes);
  try {
    read_header();
    entries_at_ = ftello(file_.get());
  } catch (const InputError& error) {
    throw InputError(fmt::format("'{}' cannot be used: {}\n    run the deck again", path_.string(), error.what()));
  }
  parts_.emplace(path_, head_);
  scan();
}

CheckpointFile::~CheckpointFile() {
  if (is_leaving_ && !has_failed_) std::fflush(file_.get());
}

void CheckpointFile::read_header() {
  char found[8];
  std::uint32_t version = 0, order = 0;
  const auto get = [&](void* data, size_t bytes) {
    if (std::fread(data, 1, bytes, file_.get()) != bytes) throw InputError("it is truncated");
  };
  get(found, 8), get(&version, 4), get(&order, 4);
  if (std::memcmp(found, checkpoint_magic, 8) != 0) throw InputError("it is not a checkpoint of dygita");
  if (order != byte_order) throw InputError("it comes from a machine with another byte order");
  if (version != checkpoint_version)
    throw InputError(
        fmt::format("it has version {} of the format, this program reads version {}", version, checkpoint_version));
  std::string header;
  std::uint64_t sum = 0;
  if (!get_record(file_.get(), sum_, header, sum)) throw InputError("its header is truncated or damaged");
  head_ = sum_ = sum;
  at_ = ftello(file_.get());
  identity_ = checkpoint_identity_of(std::move(header));
}

// Where several ranks have left it, all of its unknowns are there.
bool CheckpointFile::is_complete(const std::string& payload, std::uint64_t number) const {
  TrailEntry entry;
  try {
    Decoder decoder(payload);
    code_entry(decoder, entry);
  } catch (const InputError&) {
    return true;  // `take` says what is wrong with it
  }
  return entry.runs.is_whole() || static_cast<long>(entry.q.size()) + parts_->n_unknowns(number) == entry.runs.n_all;
}

void CheckpointFile::scan() {
  const std::int64_t begin = at_;
  const std::uint64_t first = sum_;
  std::string payload;
  for (std::uint64_t sum = 0; get_record(file_.get(), sum_, payload, sum) &&
                              is_complete(payload, number_ + static_cast<std::uint64_t>(n_left_));
       ++n_left_)
    sum_ = sum;
  at_ = begin;
  sum_ = first;
}

bool CheckpointFile::leads(long n) {
  if (is_leaving_) return false;
  if (n <= n_left_) return true;
  n_left_ = 0;
  is_leaving_ = true;
  if (parts_) parts_->cut(number_);
  parts_.reset();
  std::fflush(file_.get());
  if (ftruncate(fileno(file_.get()), at_) != 0 || fseeko(file_.get(), at_, SEEK_SET) != 0) fail("cut");
  return false;
}

TrailEntry CheckpointFile::take() {
  TrailEntry entry;
  std::string payload;
  std::uint64_t sum = 0;
  if (fseeko(file_.get(), at_, SEEK_SET) != 0 || !get_record(file_.get(), sum_, payload, sum))
    throw InputError(fmt::format("'{}' has changed while the run replayed it", path_.string()));
  sum_ = sum;
  at_ = ftello(file_.get());
  --n_left_;
  Decoder decoder(std::move(payload));
  code_entry(decoder, entry);
  if (!entry.runs.is_whole()) complete(entry);
  if (!entry.q.allFinite() || !entry.uncorrected.allFinite())
    throw InputError(
        fmt::format("'{}' holds numbers that are not finite: it is damaged\n    run the deck again", path_.string()));
  ++number_;
  return entry;
}

// With what the other ranks have left of it.
void CheckpointFile::complete(TrailEntry& entry) {
  Vec q = Vec::Zero(entry.runs.n_all), uncorrected = Vec::Zero(entry.uncorrected.size() > 0 ? entry.runs.n_all : 0);
  entry.runs.place(entry.q, q);
  if (uncorrected.size() > 0) entry.runs.place(entry.uncorrected, uncorrected);
  entry.q = std::move(q);
  entry.uncorrected = std::move(uncorrected);
  entry.runs = {};
  parts_->add_to(number_, entry);
}

void CheckpointFile::leave(const TrailEntry& entry) {
  if (!is_leaving_) leads(1);
  ++number_;
  if (has_failed_) return;
  Encoder encoder;
  TrailEntry coded = entry;
  code_entry(encoder, coded);
  sum_ = chained_sum(sum_, encoder.bytes);
  errno = 0;
  if (!put_record(file_.get(), encoder.bytes, sum_)) return fail("written");
  const auto bytes = static_cast<std::int64_t>(encoder.bytes.size()) + 16;
  if (!has_foreseen_) foresee(bytes);
  room_ -= static_cast<double>(bytes);
  if (room_ < 0.0) return stop_growing();
  const auto now = Clock::now();
  if (now - flushed_ >= std::chrono::seconds(1)) {
    flushed_ = now;
    if (std::fflush(file_.get()) != 0) return fail("written");
  }
  if (std::chrono::duration<double>(now - synced_).count() >= every_) sync();
}

void CheckpointFile::sync() {
  if (has_failed_) return;
  synced_ = flushed_ = Clock::now();
  if (std::fflush(file_.get()) != 0 || fdatasync(fileno(file_.get())) != 0) fail("written");
}

void CheckpointFile::foresee(std::int64_t bytes_of_entry) {
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(path_.parent_path(), error);
  // Other ranks keep about as much.
  const double room = error ? std::numeric_limits<double>::infinity() : 0.5 * static_cast<double>(space.available);
  room_ = room / ranks::count();
  has_foreseen_ = true;
  const double all = ranks::count() * static_cast<double>(expected_) * static_cast<double>(bytes_of_entry);
  if (all <= room) return;
  warn(
      fmt::format("the checkpoint '{}' needs about {:.3g} GB, and {:.3g} GB are free: checkpointing stops at half the "
                  "free space, and a run stopped later resumes from there; --checkpoint-every 0 writes no checkpoint, "
                  "--no-state neither checkpoint nor state, which needs as much",
                  path_.string(), all / 1e9, static_cast<double>(space.available) / 1e9));
}

void CheckpointFile::stop_growing() {
  std::fflush(file_.get());
  has_failed_ = true;
  warn(
      fmt::format("the checkpoint '{}' has filled half of the free space and stops growing; the rest is reserved for "
                  "results\n    the run continues; if stopped, it resumes from here",
                  path_.string()));
}

// The results are not touched: the run continues without.
void CheckpointFile::fail(const char* what) {
  const int reason = errno;
  has_failed_ = true;
  // What the disk has left belongs to the results.
  std::error_code error;
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(path_, error));
  const auto kept = entries_at_ + std::max<std::int64_t>(0, (size - entries_at_) / 2);  // without its header it is none
  const bool is_cut = reason == ENOSPC && !error && ftruncate(fileno(file_.get()), kept) == 0;
  warn(fmt::format("the checkpoint '{}' cannot be {}: {}{}\n    the run continues; if stopped, it resumes from {}",
                   path_.string(), what, reason_not_written(reason),
                   is_cut ? "; half of its space is released for results" : "", is_cut ? "there" : "here"));
}

void CheckpointFile::note_difference() {
  if (has_differed_) return;
  has_differed_ = true;
  warn(
      "recomputed increments differ in their last digits (different processor, library or program version): the "
      "results are equally accurate, but not bit for bit those of an uninterrupted run");
}

}  // namespace dygita
