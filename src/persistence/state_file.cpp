#include "persistence/state_file.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "base/error.hpp"
#include "base/fnv1a.hpp"
#include "base/memory.hpp"
#include "base/plain_file.hpp"
#include "persistence/open_file.hpp"
#include "persistence/state_coder.hpp"
#include "ranks/ranks.hpp"

namespace dygita {

namespace {

constexpr char state_magic[] = "DYGITAST";  // 8 bytes
constexpr std::uint32_t version_of_fields = 1, version_of_parts = 2;
constexpr std::int64_t start_of_header = 24;  // state_magic, version, byte order, length of the header

template <class Coder, class State, class SizesOf>
void visit(Coder& code, State& state, SizesOf& sizes) {
  const auto pair = [&](auto& p) { code(p.first), code(p.second); };
  code(state.program), code(state.problem), code(state.case_name);
  code(state.deck_path), code(state.deck_text), code(state.solver);
  code_list(code, state.settings, pair);
  code_list(code, state.mesh_digests, pair);
  code_list(code, state.loads, [&](auto& value) { code(value); });
  code_list(code, state.steps, [&](auto& step) {
    code(step.name), code_number(code, step.is_static), code_number(code, step.increments);
    code(step.duration), code(step.worst_indicator);
  });
  code_list(code, state.efforts, [&](auto& effort) {
    code(effort.tolerance), code(effort.static_tolerance), code_number(code, effort.more_iterations);
    code_number(code, effort.iterations), code(effort.seconds);
  });
  code_number(code, state.converged), code_number(code, state.interrupted);
  code_list(code, sizes, [&](auto& step) { code_list(code, step, [&](auto& size) { code_number(code, size); }); });
}

FieldSizes sizes_of(const InterfaceFields& fields) {
  FieldSizes sizes(fields.n_steps());
  for (size_t s = 0; s < sizes.size(); ++s)
    for (size_t i = 0; i < fields.n_increments(s); ++i) sizes[s].push_back(fields.size(s, i));
  return sizes;
}

// Behind the rest of the header, in version 2.
template <class Coder, class Parts>
void visit_parts(Coder& code, Parts& parts) {
  code_list(code, parts, [&](auto& part) {
    std::string bytes;
    if constexpr (std::is_same_v<Coder, Encoder>) bytes = bytes_of(part);
    code(bytes);
    if constexpr (std::is_same_v<Coder, Decoder>) part = state_part_of(bytes);
  });
}

bool write_all(std::FILE* file, const RunState& state) {
  const auto put = [&](const void* data, size_t bytes) {
    return bytes == 0 || std::fwrite(data, 1, bytes, file) == bytes;
  };
  const auto put_sum = [&](const Checksum& sum) {
    const std::uint64_t value = sum.value();
    return put(&value, 8);
  };
  const bool has_parts = !state.parts.is_empty();
  const FieldSizes sizes = has_parts ? state.parts.sizes : sizes_of(*state.fields);
  const std::uint32_t version = has_parts ? version_of_parts : version_of_fields;
  Encoder header;
  visit(header, state, sizes);
  if (has_parts) visit_parts(header, state.parts.of_ranks);
  const std::uint64_t length = header.bytes.size();
  Checksum of_header, of_fields;
  of_header.add(header.bytes.data(), header.bytes.size());
  bool is_good = put(state_magic, 8) && put(&version, 4) && put(&byte_order, 4) && put(&length, 8) &&
                 put(header.bytes.data(), header.bytes.size()) && put_sum(of_header);
  if (has_parts) return is_good && std::fflush(file) == 0;
  Vec q;
  for (size_t s = 0; s < sizes.size() && is_good; ++s) {
    for (size_t i = 0; i < sizes[s].size() && is_good; ++i) {
      if (!state.fields->read(s, i, sizes[s][i], q))
        throw InputError("the interface fields kept in a file cannot be read back");
      const size_t bytes = 8 * static_cast<size_t>(q.size());
      of_fields.add(q.data(), bytes);
      is_good = put(q.data(), bytes);
    }
  }
  return is_good && put_sum(of_fields) && std::fflush(file) == 0;
}

// What is read must be what was written; the fields are read once through, to know before anything is computed.
void check_fields(std::FILE* file, std::int64_t begin, std::int64_t bytes) {
  Checksum sum;
  std::vector<double> block(1 << 17);
  const auto most = static_cast<std::int64_t>(8 * block.size());
  bool is_finite = true, is_good = fseeko(file, begin, SEEK_SET) == 0;
  for (std::int64_t left = bytes; left > 0 && is_good;) {
    const size_t n = static_cast<size_t>(std::min(left, most));
    is_good = std::fread(block.data(), 1, n, file) == n;
    sum.add(block.data(), n);
    is_finite = is_finite && std::all_of(block.begin(), block.begin() + static_cast<std::ptrdiff_t>(n / 8),
                                         [](double x) { return std::isfinite(x); });
    left -= static_cast<std::int64_t>(n);
  }
  std::uint64_t expected = 0;
  is_good = is_good && std::fread(&expected, 8, 1, file) == 1 && std::fgetc(file) == EOF;
  if (!is_good) throw InputError("it has the wrong length");
  if (expected != sum.value()) throw InputError("its checksum does not match");
  if (!is_finite) throw InputError("it holds numbers that are not finite");
}

RunState read_all(OpenFile file, const std::filesystem::path& path) {
  char found[8];
  std::uint32_t version = 0, order = 0;
  std::uint64_t length = 0, expected = 0;
  const auto get = [&](void* data, size_t bytes) {
    if (std::fread(data, 1, bytes, file.get()) != bytes) throw InputError("it is truncated");
  };
  get(found, 8);
  if (std::memcmp(found, state_magic, 8) != 0) throw InputError("it is not a state file of dygita");
  get(&version, 4), get(&order, 4), get(&length, 8);
  if (order != byte_order) throw InputError("it comes from a machine with another byte order");
  if (version != version_of_fields && version != version_of_parts)
    throw InputError(fmt::format("it has version {} of the format, this program reads versions {} and {}", version,
                                 version_of_fields, version_of_parts));
  fseeko(file.get(), 0, SEEK_END);
  const std::int64_t file_length = ftello(file.get());
  if (length > (std::uint64_t{1} << 40) || file_length < start_of_header + static_cast<std::int64_t>(length))
    throw InputError("it is truncated");
  fseeko(file.get(), start_of_header, SEEK_SET);
  if (exceeds_memory(length)) throw InputError("its header does not fit into memory");
  std::string header(length, '\0');
  get(header.data(), length), get(&expected, 8);
  Checksum sum;
  sum.add(header.data(), header.size());
  if (sum.value() != expected) throw InputError("its checksum does not match");

  RunState state;
  FieldSizes sizes;
  Decoder decoder(std::move(header));
  visit(decoder, state, sizes);
  if (version == version_of_parts) {
    StateParts parts{sizes, {}};
    visit_parts(decoder, parts.of_ranks);
    if (std::fgetc(file.get()) != EOF) throw InputError("it has the wrong length");
    state.fields = fields_of_parts(path, parts);
    return state;
  }
  const std::int64_t begin = start_of_header + static_cast<std::int64_t>(length) + 8;
  std::vector<std::vector<InterfaceFields::Place>> places(sizes.size());
  std::int64_t at = begin;
  for (size_t s = 0; s < sizes.size(); ++s) {
    for (const Eigen::Index size : sizes[s]) {
      if (size < 0 || size > (file_length - at) / 8) throw InputError("it has the wrong length");
      places[s].push_back({at, size});
      at += 8 * static_cast<std::int64_t>(size);
    }
  }
  if (ranks::is_first()) check_fields(file.get(), begin, at - begin);
  state.fields = std::make_shared<InterfaceFields>(file.release(), places);
  return state;
}

}  // namespace

std::string identity_bytes(const RunState& state) {
  Encoder header;
  const FieldSizes none;
  visit(header, state, none);
  return header.bytes;
}

RunState state_of_identity(std::string bytes) {
  RunState state;
  FieldSizes sizes;
  Decoder decoder(std::move(bytes));
  visit(decoder, state, sizes);
  return state;
}

long RunState::n_increments() const {
  long n = 0;
  for (size_t s = 0; s < fields->n_steps(); ++s) n += static_cast<long>(fields->n_increments(s));
  return n;
}

void write_state(const std::filesystem::path& path, const RunState& state) {
  const std::string temporary = path.string() + ".tmp";
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);  // a link there would lead to a file of somebody's
  errno = 0;
  const auto fail = [&](const std::string& reason) {
    std::filesystem::remove(temporary, ignored);
    throw InputError(fmt::format("cannot write '{}': {}", path.string(), reason));
  };
  std::FILE* file = std::fopen(temporary.c_str(), "wbx");
  if (!file) fail(std::strerror(errno));
  bool is_good = false;
  try {
    is_good = write_all(file, state);
  } catch (const InputError& error) {
    std::fclose(file);
    fail(error.what());
  }
  const int reason = errno;
  is_good = std::fclose(file) == 0 && is_good;
  if (!is_good) fail(reason_not_written(reason ? reason : errno));
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  if (error) fail(error.message());
}

RunState read_state(const std::filesystem::path& path) {
  require_file(path);
  OpenFile file(std::fopen(path.c_str(), "rb"));
  if (!file) throw InputError(fmt::format("cannot read '{}': {}", path.string(), std::strerror(errno)));
  try {
    return read_all(std::move(file), path);
  } catch (const InputError& error) {
    throw InputError(fmt::format("'{}' cannot be used: {}\n    run the deck again", path.string(), error.what()));
  }
}

}  // namespace dygita
