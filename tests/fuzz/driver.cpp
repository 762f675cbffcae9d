// Stands in for libFuzzer where the compiler has none: hands every file to the target, then changed ones for a while.
//   fuzz_NAME [--seconds N] [--seed N] FILE-OR-FOLDER...
// The input at hand lies in fuzz_NAME.input, which stays where it has found something.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <string_view>

#include "fuzz/target.hpp"

extern "C" __attribute__((weak)) size_t LLVMFuzzerCustomMutator(std::uint8_t* data, size_t size, size_t most,
                                                                unsigned seed);

namespace {

namespace fs = std::filesystem;

constexpr size_t most_bytes = size_t{1} << 16;
constexpr unsigned longest_seconds = 120;  // for one input
std::mt19937_64 random_numbers(1);

// A byte, a number, a piece taken out, repeated or moved.
void change(std::string& bytes) {
  static const std::string ends[] = {"\0", "\xff", "9999999999", "-1", "nan", "1e400", "\n", "\"", "{", "[", ","};
  const size_t at = bytes.empty() ? 0 : random_numbers() % bytes.size(), n = 1 + random_numbers() % 16;
  switch (random_numbers() % 6) {
    case 0:
      if (!bytes.empty()) bytes[at] = static_cast<char>(random_numbers());
      break;
    case 1:
      bytes.erase(at, n);
      break;
    case 2:
      bytes.insert(at, ends[random_numbers() % std::size(ends)]);
      break;
    case 3:
      bytes.insert(at, bytes.substr(bytes.empty() ? 0 : random_numbers() % bytes.size(), 4 * n));
      break;
    case 4:
      for (size_t i = at; i < std::min(at + 8, bytes.size()); ++i)
        bytes[i] = static_cast<char>(random_numbers() % 3 - 1);
      break;
    default:
      bytes.resize(at);
  }
}

struct Given {
  double seconds = 0.0;
  std::vector<std::string> inputs;
};

void read_into(std::vector<std::string>& inputs, const fs::path& path) {
  std::vector<fs::path> files = {path};
  if (fs::is_directory(path)) {
    files.clear();
    for (const auto& entry : fs::recursive_directory_iterator(path))
      if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    std::ifstream stream(file, std::ios::binary);
    inputs.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
}

Given given(int argc, char** argv) {
  Given all;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--seconds" && i + 1 < argc)
      all.seconds = std::atof(argv[++i]);
    else if (word == "--seed" && i + 1 < argc)
      random_numbers.seed(std::strtoull(argv[++i], nullptr, 10));
    else
      read_into(all.inputs, argv[i]);
  }
  return all;
}

void take(const std::string& bytes, const std::string& kept) {
  std::ofstream(kept, std::ios::binary) << bytes;
  alarm(longest_seconds);
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  alarm(0);
}

std::string changed(std::string bytes) {
  bytes.resize(std::min(bytes.size(), most_bytes));
  const size_t size = bytes.size();
  bytes.resize(most_bytes);
  auto* const data = reinterpret_cast<std::uint8_t*>(bytes.data());
  bytes.resize(LLVMFuzzerCustomMutator
                   ? LLVMFuzzerCustomMutator(data, size, most_bytes, static_cast<unsigned>(random_numbers()))
                   : LLVMFuzzerMutate(data, size, most_bytes));
  return bytes;
}

}  // namespace

extern "C" size_t LLVMFuzzerMutate(std::uint8_t* data, size_t size, size_t most) {
  std::string bytes = dygita::fuzz::text_of(data, size);
  for (size_t n = 1 + random_numbers() % 4; n > 0; --n) change(bytes);
  std::copy_n(bytes.begin(), std::min(bytes.size(), most), reinterpret_cast<char*>(data));
  return std::min(bytes.size(), most);
}

int main(int argc, char** argv) {
  const Given all = given(argc, argv);
  if (all.inputs.empty()) {
    std::fprintf(stderr, "usage: %s [--seconds N] [--seed N] FILE-OR-FOLDER...\n", argv[0]);
    return 2;
  }
  const std::string kept = fs::absolute(fs::path(argv[0]).filename().string() + ".input").string();
  std::FILE* const quiet = std::freopen("/dev/null", "w", stdout);
  dygita::fuzz::demand(quiet != nullptr, "no /dev/null");
  for (const std::string& bytes : all.inputs) take(bytes, kept);
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  long n = 0;
  for (; seconds() < all.seconds; ++n) take(changed(all.inputs[random_numbers() % all.inputs.size()]), kept);
  std::fprintf(stderr, "%zu inputs replayed, %ld changed ones tried\n", all.inputs.size(), n);
  fs::remove(kept);
  return 0;
}
