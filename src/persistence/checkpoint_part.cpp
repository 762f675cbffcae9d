#include "persistence/checkpoint_part.hpp"

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <numeric>

#include "base/error.hpp"
#include "base/log.hpp"
#include "base/plain_file.hpp"
#include "persistence/record_chain.hpp"
#include "ranks/ranks.hpp"

namespace dygita {

namespace fs = std::filesystem;

namespace {

constexpr char part_magic[] = "DYGITACQ";  // 8 bytes

template <class Coder>
void code_share(Coder& code, EntryShare& share) {
  code(share.number);
  code_runs(code, share.runs);
  code_vector(code, share.q), code_vector(code, share.uncorrected);
  code_list(code, share.moved, [&](auto& piece) { code(piece); });
}

bool is_sound(const EntryShare& share) {
  return share.runs.fit(share.q.size()) &&
         (share.uncorrected.size() == 0 || share.uncorrected.size() == share.q.size());
}

std::string header_of(std::uint64_t head) {
  std::string header(part_magic, 8);
  header.append(reinterpret_cast<const char*>(&head), 8);
  return header;
}

// Is it a part of the checkpoint with this head? Then the file stands behind its header.
bool begins_with(std::FILE* file, std::uint64_t head) {
  std::string found(16, '\0');
  return std::fread(found.data(), 1, 16, file) == 16 && found == header_of(head);
}

}  // namespace

fs::path parts_folder(const fs::path& checkpoint) { return checkpoint.string() + ".parts"; }

CheckpointPart::CheckpointPart(const fs::path& checkpoint, int rank, std::uint64_t head, double every)
    : path_(parts_folder(checkpoint) / std::to_string(rank)), head_(head), every_(every) {}

CheckpointPart::~CheckpointPart() {
  if (file_ && !has_failed_ && std::fflush(file_.get()) == 0) fdatasync(fileno(file_.get()));
}

// Counted; what is in it the first rank sends.
TrailEntry CheckpointPart::take() {
  ++number_;
  return {};
}

// Where a part of the same run is there, the first rank has cut off what does not count.
void CheckpointPart::open() {
  std::error_code error;
  fs::create_directories(path_.parent_path(), error);
  errno = 0;
  if (fs::is_symlink(path_) || fs::is_symlink(path_.parent_path())) return fail("it is a link");
  if (fs::hard_link_count(path_, error) > 1 && !error) return fail("it is a second name of another file");
  file_.reset(std::fopen(path_.c_str(), "r+b"));
  if (file_ && begins_with(file_.get(), head_)) {
    std::string payload;
    std::int64_t end = ftello(file_.get());
    for (std::uint64_t sum = 0; get_record(file_.get(), sum_, payload, sum); end = ftello(file_.get())) sum_ = sum;
    if (ftruncate(fileno(file_.get()), end) != 0 || fseeko(file_.get(), end, SEEK_SET) != 0)
      return fail(reason_not_written(errno));
  } else {
    file_.reset(std::fopen(path_.c_str(), "w+b"));
    const std::string header = header_of(head_);
    if (!file_ || std::fwrite(header.data(), 1, header.size(), file_.get()) != header.size())
      return fail(reason_not_written(errno));
  }
  const fs::space_info space = fs::space(path_.parent_path(), error);
  room_ = error ? std::numeric_limits<double>::infinity() : 0.5 * static_cast<double>(space.available) / ranks::count();
  flushed_ = synced_ = std::chrono::steady_clock::now();
}

void CheckpointPart::leave(const TrailEntry& entry) {
  EntryShare share{number_++, entry.runs, entry.q, entry.uncorrected, {}};
  if (has_failed_) return;
  if (!file_) open();
  if (has_failed_) return;
  for (size_t i = 0; i < entry.moved.size(); ++i)
    if (entry.moved[i]) share.moved.push_back(i);
  Encoder encoder;
  code_share(encoder, share);
  sum_ = chained_sum(sum_, encoder.bytes);
  errno = 0;
  room_ -= static_cast<double>(encoder.bytes.size() + 16);
  if (room_ < 0.0) return fail("it has filled its share of half of the free space");
  if (!put_record(file_.get(), encoder.bytes, sum_)) return fail(reason_not_written(errno));
  const auto now = std::chrono::steady_clock::now();
  if (now - flushed_ >= std::chrono::seconds(1)) {
    flushed_ = now;
    if (std::fflush(file_.get()) != 0) return fail(reason_not_written(errno));
  }
  if (std::chrono::duration<double>(now - synced_).count() < every_) return;
  synced_ = now;
  if (std::fflush(file_.get()) != 0 || fdatasync(fileno(file_.get())) != 0) fail(reason_not_written(errno));
}

// The results are not touched: the run continues without.
void CheckpointPart::fail(const std::string& reason) {
  has_failed_ = true;
  warn(fmt::format(
      "the checkpoint's part '{}' cannot be written: {}\n    the run continues; if stopped, it resumes from here",
      path_.string(), reason));
}

CheckpointParts::CheckpointParts(const fs::path& checkpoint, std::uint64_t head) {
  std::error_code error;
  const fs::path folder = parts_folder(checkpoint);
  if (fs::is_symlink(folder, error)) return;
  std::vector<fs::path> paths;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.is_regular_file(error) && !entry.is_symlink(error)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  for (const fs::path& path : paths) {
    Part part{OpenFile(std::fopen(path.c_str(), "r+b")), {}, 0};
    if (!part.file || !begins_with(part.file.get(), head)) continue;
    std::string payload;
    std::uint64_t before = 0, sum = 0;
    part.end = ftello(part.file.get());
    while (get_record(part.file.get(), before, payload, sum)) {
      EntryShare share;
      try {
        Decoder decoder(std::move(payload));
        code_share(decoder, share);
      } catch (const InputError&) {
        break;
      }
      if (!is_sound(share) || (!part.records.empty() && share.number <= part.records.back().number)) break;
      part.records.push_back({share.number, before, part.end, static_cast<long>(share.q.size())});
      before = sum;
      part.end = ftello(part.file.get());
    }
    parts_.push_back(std::move(part));
  }
}

const CheckpointParts::Record* CheckpointParts::find(const Part& part, std::uint64_t number) {
  const auto at = std::lower_bound(part.records.begin(), part.records.end(), number,
                                   [](const Record& record, std::uint64_t n) { return record.number < n; });
  return at != part.records.end() && at->number == number ? &*at : nullptr;
}

long CheckpointParts::n_unknowns(std::uint64_t number) const {
  return std::accumulate(parts_.begin(), parts_.end(), 0L, [&](long n, const Part& part) {
    const Record* record = find(part, number);
    return n + (record ? record->n_unknowns : 0);
  });
}

void CheckpointParts::add_to(std::uint64_t number, TrailEntry& entry) {
  for (Part& part : parts_) {
    const Record* record = find(part, number);
    if (!record) continue;
    std::string payload;
    std::uint64_t sum = 0;
    if (fseeko(part.file.get(), record->at, SEEK_SET) != 0 ||
        !get_record(part.file.get(), record->before, payload, sum))
      throw InputError("a part of the checkpoint has changed while the run replayed it");
    EntryShare share;
    Decoder decoder(std::move(payload));
    code_share(decoder, share);
    if (!is_sound(share) || share.runs.n_all != entry.q.size())
      throw InputError("a part of the checkpoint is of another run: it is damaged");
    share.runs.place(share.q, entry.q);
    if (share.uncorrected.size() > 0 && entry.uncorrected.size() > 0)
      share.runs.place(share.uncorrected, entry.uncorrected);
    for (const std::uint64_t piece : share.moved)
      if (piece < entry.moved.size()) entry.moved[piece] = 1;
  }
}

void CheckpointParts::cut(std::uint64_t number) {
  for (const Part& part : parts_) {
    std::int64_t end = part.end;
    for (const Record& record : part.records)
      if (record.number >= number) end = std::min(end, record.at);
    if (ftruncate(fileno(part.file.get()), end) != 0)
      warn(fmt::format("a part of the checkpoint cannot be cut: {}", std::strerror(errno)));
  }
  parts_.clear();
}

}  // namespace dygita
