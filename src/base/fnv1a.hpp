// Digests: FNV-1a of 64 bits (Fowler, Noll, Vo), by bytes and by words.
#pragma once

#include <spdlog/fmt/fmt.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>

namespace dygita {

// What both start from, and one step of both.
constexpr uint64_t fnv_offset = 0xcbf29ce484222325u;
constexpr uint64_t fnv_mix(uint64_t hash, uint64_t word) { return (hash ^ word) * 0x100000001b3u; }

// Tells texts, meshes and the like apart by name.
class Fnv1a {
 public:
  void add(const void* data, size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (size_t i = 0; i < size; ++i) hash_ = fnv_mix(hash_, bytes[i]);
  }
  // The length goes in too, so that "ab" + "c" differs from "a" + "bc".
  void add(const std::string& text) {
    add(text.size());
    add(text.data(), text.size());
  }
  template <typename T>
  requires std::has_unique_object_representations_v<T>
  void add(const T& value) { add(&value, sizeof value); }

  std::string hexadecimal() const { return fmt::format("{:016x}", hash_); }

 private:
  uint64_t hash_ = fnv_offset;
};

// Tells whether a large file is whole: on words of 64 bits, rotated so that the highest bits count as much as the
// lowest.
class Checksum {
 public:
  void add(const void* data, size_t bytes) {
    const char* at = static_cast<const char*>(data);
    for (; bytes >= 8; bytes -= 8, at += 8) {
      uint64_t word;
      std::memcpy(&word, at, 8);
      mix(word);
    }
    if (bytes == 0) return;
    uint64_t word = bytes;
    std::memcpy(&word, at, bytes);
    mix(word);
  }
  uint64_t value() const { return hash_; }

 private:
  void mix(uint64_t word) { hash_ = std::rotl(fnv_mix(hash_, word), 29); }
  uint64_t hash_ = fnv_offset;
};

}  // namespace dygita
