#include "persistence/state_parts.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "base/error.hpp"
#include "base/fnv1a.hpp"
#include "base/plain_file.hpp"
#include "persistence/open_file.hpp"
#include "persistence/state_coder.hpp"
#include "ranks/ranks.hpp"

namespace dygita {

namespace fs = std::filesystem;

namespace {

constexpr char fields_magic[] = "DYGITASQ";  // 8 bytes
constexpr std::int64_t start_of_fields = 8;

template <class Coder, class Part>
void code_part(Coder& code, Part& part) {
  code_list(code, part.runs, [&](auto& step) { code_runs(code, step); });
  code(part.sum);
}

// Has every unknown of every step one rank that keeps it?
bool are_complete(const std::vector<StatePart>& parts, const FieldSizes& sizes) {
  for (size_t s = 0; s < sizes.size(); ++s) {
    const long n_all = sizes[s].empty() ? -1 : static_cast<long>(sizes[s].front());
    if (!sizes[s].empty() && n_all < 0) return false;
    if (std::any_of(sizes[s].begin(), sizes[s].end(), [&](Eigen::Index n) { return n != n_all; })) return false;
    std::vector<AssembledRuns::Run> runs;
    for (const StatePart& part : parts) {
      if (part.runs.size() != sizes.size()) return false;
      const AssembledRuns& of_part = part.runs[s];
      if (n_all >= 0 && (of_part.n_all != n_all || !of_part.are_sound())) return false;
      runs.insert(runs.end(), of_part.runs.begin(), of_part.runs.end());
    }
    if (n_all < 0) continue;
    std::sort(runs.begin(), runs.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    long end = 0;
    for (const AssembledRuns::Run& run : runs) {
      if (run.first != end) return false;
      end += run.n;
    }
    if (end != n_all) return false;
  }
  return true;
}

void check_part(const fs::path& path, const StatePart& part, const FieldSizes& sizes) {
  require_file(path);
  const OpenFile file(std::fopen(path.c_str(), "rb"));
  if (!file) throw InputError(fmt::format("its part '{}' cannot be read: {}", path.string(), std::strerror(errno)));
  const auto is_whole = [&] {
    char found[8];
    const std::uintmax_t room = fs::file_size(path) / 8;
    if (std::fread(found, 1, 8, file.get()) != 8 || std::memcmp(found, fields_magic, 8) != 0) return false;
    Checksum sum;
    Vec q;
    for (size_t s = 0; s < sizes.size(); ++s)
      for (size_t i = 0; i < sizes[s].size(); ++i) {
        const auto n = static_cast<size_t>(part.runs[s].n_kept());
        if (n > room) return false;
        q.resize(static_cast<Eigen::Index>(n));
        if (n > 0 && std::fread(q.data(), 8, n, file.get()) != n) return false;
        if (!q.allFinite()) return false;
        sum.add(q.data(), 8 * n);
      }
    return std::fgetc(file.get()) == EOF && sum.value() == part.sum;
  };
  if (!is_whole()) throw InputError(fmt::format("its part '{}' is damaged, or of another run", path.string()));
}

}  // namespace

fs::path state_parts_folder(const fs::path& state) { return state.string() + ".parts"; }

StatePart write_state_part(const fs::path& path, const InterfaceFields& kept, const FieldSizes& sizes) {
  std::error_code ignored;
  fs::create_directories(path.parent_path(), ignored);
  fs::remove(path, ignored);  // a link there would lead to a file of somebody's
  errno = 0;
  OpenFile file(std::fopen(path.c_str(), "wbx"));
  StatePart part;
  Checksum sum;
  bool is_good = file && std::fwrite(fields_magic, 1, 8, file.get()) == 8;
  Vec q;
  for (size_t s = 0; s < sizes.size() && is_good; ++s) {
    part.runs.push_back(kept.runs(s));
    for (size_t i = 0; i < sizes[s].size() && is_good; ++i) {
      if (!kept.read(s, i, part.runs.back().n_kept(), q))
        throw InputError("the interface fields kept in a file cannot be read back");
      const auto n = static_cast<size_t>(q.size());
      sum.add(q.data(), 8 * n);
      is_good = n == 0 || std::fwrite(q.data(), 8, n, file.get()) == n;
    }
  }
  is_good = is_good && std::fflush(file.get()) == 0;
  if (!is_good) throw InputError(fmt::format("cannot write '{}': {}", path.string(), reason_not_written(errno)));
  part.sum = sum.value();
  return part;
}

std::string bytes_of(const StatePart& part) {
  Encoder encoder;
  code_part(encoder, part);
  return encoder.bytes;
}

StatePart state_part_of(std::string bytes) {
  StatePart part;
  Decoder decoder(std::move(bytes));
  code_part(decoder, part);
  return part;
}

std::shared_ptr<const InterfaceFields> fields_of_parts(const fs::path& state, const StateParts& all) {
  const auto& [sizes, parts] = all;
  if (!are_complete(parts, sizes)) throw InputError("its parts do not contain every unknown exactly once");
  std::vector<FieldPart> files;
  for (size_t i = 0; i < parts.size(); ++i) {
    const fs::path path = state_parts_folder(state) / std::to_string(i);
    if (static_cast<int>(i) % ranks::count() == ranks::me()) check_part(path, parts[i], sizes);
    files.push_back({path, start_of_fields, parts[i].runs});
  }
  return std::make_shared<InterfaceFields>(std::move(files), sizes);
}

}  // namespace dygita
