// Digest of bytes: FNV-1a of 64 bits (Fowler, Noll, Vo).
#pragma once

#include <spdlog/fmt/fmt.h>

#include <cstdint>
#include <string>
#include <type_traits>

namespace dygita {

class Fnv1a {
 public:
  void add(const void* data, size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (size_t i = 0; i < size; ++i) hash_ = (hash_ ^ bytes[i]) * 0x100000001b3u;
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
  uint64_t hash_ = 0xcbf29ce484222325u;
};

}  // namespace dygita
