// state.dygita and checkpoint.dygita: as they come, and with their checksums put right, so that what lies behind them
// is reached.
#include <cstring>

#include "base/fnv1a.hpp"
#include "fuzz/target.hpp"
#include "persistence/checkpoint_file.hpp"
#include "run/continuation.hpp"

namespace dygita::fuzz {

namespace {

constexpr size_t preamble = 16;  // magic, version, byte order

std::uint64_t word_at(const std::string& bytes, size_t at) {
  std::uint64_t word = 0;
  std::memcpy(&word, bytes.data() + at, 8);
  return word;
}

void put_word(std::string& bytes, size_t at, std::uint64_t word) { std::memcpy(bytes.data() + at, &word, 8); }

std::uint64_t sum_of(std::uint64_t before, bool is_chained, const char* bytes, size_t size) {
  Checksum sum;
  if (is_chained) sum.add(&before, sizeof before);
  sum.add(bytes, size);
  return sum.value();
}

// One record after the other, length, payload, sum. A length that leads too far is cut to what there is.
std::string repaired(std::string bytes) {
  if (bytes.size() < preamble + 16) return bytes;
  const bool is_checkpoint = bytes.compare(0, 8, "DYGITACP") == 0;
  std::memcpy(bytes.data(), is_checkpoint ? "DYGITACP" : "DYGITAST", 8);
  put_word(bytes, 8, 0x0102030400000001u);
  std::uint64_t sum = 0;
  size_t at = preamble;
  while (at + 16 <= bytes.size()) {
    const std::uint64_t room = bytes.size() - at - 16;
    const std::uint64_t length = std::min(word_at(bytes, at), room);
    put_word(bytes, at, length);
    sum = sum_of(sum, is_checkpoint, bytes.data() + at + 8, length);
    put_word(bytes, at + 8 + length, sum);
    at += 16 + length;
    if (!is_checkpoint) break;
  }
  if (!is_checkpoint && at + 8 <= bytes.size())
    put_word(bytes, bytes.size() - 8, sum_of(0, false, bytes.data() + at, bytes.size() - at - 8));
  return bytes;
}

void read_fields(const RunState& state) {
  Vec q;
  long n = 0;
  for (size_t s = 0; s < state.fields->n_steps(); ++s)
    for (size_t i = 0; i < state.fields->n_increments(s); ++i, ++n)
      demand(state.fields->read(s, i, state.fields->size(s, i), q), "fields that were checked are read");
  demand(n == state.n_increments(), "as many increments as are kept");
}

void ask(const std::filesystem::path& run) {
  for (const bool asks : {false, true})
    attempt([&] {
      ContinueOptions options;
      options.run = run;
      if (asks) options.tolerance = 1e-6, options.until = 1.0;
      const Continuation continuation(options);
      continuation.idle();
      continuation.check_until();
    });
}

void read_as_state(const Scratch& scratch, const std::string& bytes) {
  scratch.write(state_file_name, bytes);
  const std::filesystem::path path = scratch.folder() / state_file_name;
  attempt([&] {
    const RunState state = read_state(path);
    read_fields(state);
    write_state(scratch.folder() / "copy", state);
    demand(read_state(scratch.folder() / "copy").n_increments() == state.n_increments(), "a state is kept as it is");
  });
  ask(scratch.folder());
}

void read_as_checkpoint(const Scratch& scratch, const std::string& bytes) {
  scratch.write(checkpoint_file_name, bytes);
  ask(scratch.folder());
  attempt([&] {
    CheckpointFile file(scratch.folder() / checkpoint_file_name, 180.0);
    TrailEntry last;
    while (file.leads(1)) last = file.take();
    file.leave(last);
    file.sync();
  });
}

void read_all(const std::string& bytes) {
  static const Scratch scratch;
  scratch.empty();
  if (bytes.compare(0, 8, "DYGITACP") == 0)
    read_as_checkpoint(scratch, bytes);
  else
    read_as_state(scratch, bytes);
  scratch.demand_nothing_outside_was_touched();
}

}  // namespace

}  // namespace dygita::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, size_t size) {
  using namespace dygita::fuzz;
  const std::string bytes = text_of(data, size), put_right = repaired(bytes);
  read_all(put_right);
  if (put_right != bytes) read_all(bytes);
  return 0;
}
