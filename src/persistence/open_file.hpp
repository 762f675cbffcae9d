// Files of numbers as this machine has them: closed with their owner, marked with the order of their bytes.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>

namespace dygita {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using OpenFile = std::unique_ptr<std::FILE, CloseFile>;

constexpr std::uint32_t byte_order = 0x01020304;

inline bool put(std::FILE* file, const void* data, size_t bytes) { return std::fwrite(data, 1, bytes, file) == bytes; }

}  // namespace dygita
