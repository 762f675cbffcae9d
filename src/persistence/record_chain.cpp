#include "persistence/record_chain.hpp"

#include "base/fnv1a.hpp"
#include "base/memory.hpp"
#include "persistence/open_file.hpp"

namespace dygita {

namespace {

constexpr std::uint64_t largest_record = std::uint64_t{1} << 40;

}  // namespace

std::uint64_t chained_sum(std::uint64_t before, const std::string& bytes) {
  Checksum sum;
  sum.add(&before, sizeof before);
  sum.add(bytes.data(), bytes.size());
  return sum.value();
}

bool put_record(std::FILE* file, const std::string& payload, std::uint64_t sum) {
  const std::uint64_t length = payload.size();
  return put(file, &length, 8) && put(file, payload.data(), payload.size()) && put(file, &sum, 8);
}

bool get_record(std::FILE* file, std::uint64_t before, std::string& payload, std::uint64_t& sum) {
  std::uint64_t length = 0;
  const std::int64_t begin = ftello(file);
  if (std::fread(&length, 8, 1, file) != 1 || length > largest_record) return false;
  fseeko(file, 0, SEEK_END);
  const auto rest = static_cast<std::uint64_t>(ftello(file) - begin - 8);
  fseeko(file, begin + 8, SEEK_SET);
  if (rest < length + 8 || exceeds_memory(length)) return false;
  payload.resize(length);
  return std::fread(payload.data(), 1, length, file) == length && std::fread(&sum, 8, 1, file) == 1 &&
         sum == chained_sum(before, payload);
}

}  // namespace dygita
