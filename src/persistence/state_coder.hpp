// Bytes of state files: numbers little-endian, texts and lists with their length; one description for both directions.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>

#include "base/error.hpp"
#include "numerics/types.hpp"

namespace dygita {

class Encoder {
 public:
  void operator()(const std::string& text) {
    (*this)(static_cast<std::uint64_t>(text.size()));
    bytes += text;
  }
  void operator()(std::uint64_t number) { bytes.append(reinterpret_cast<const char*>(&number), 8); }
  void operator()(double number) { (*this)(std::bit_cast<std::uint64_t>(number)); }
  std::string bytes;
};

// Throws InputError where the bytes end too early.
class Decoder {
 public:
  explicit Decoder(std::string bytes) : bytes_(std::move(bytes)) {}
  void operator()(std::string& text) {
    std::uint64_t size = 0;
    (*this)(size);
    const char* at = take(size);
    text.assign(at, size);
  }
  void operator()(std::uint64_t& number) { std::memcpy(&number, take(8), 8); }
  void operator()(double& number) { std::memcpy(&number, take(8), 8); }
  // Items of so many bytes at least that can follow.
  std::uint64_t room_for(std::uint64_t item_bytes) const { return (bytes_.size() - at_) / item_bytes; }

 private:
  const char* take(std::uint64_t size) {
    if (size > bytes_.size() - at_) throw InputError("its header is truncated");
    at_ += size;
    return bytes_.data() + (at_ - size);
  }
  std::string bytes_;
  size_t at_ = 0;
};

template <class Coder, class Number>
void code_number(Coder& code, Number& value) {
  if constexpr (std::is_same_v<Coder, Encoder>) {
    code(static_cast<std::uint64_t>(value));
  } else {
    std::uint64_t wide = 0;
    code(wide);
    value = static_cast<Number>(wide);
  }
}

template <class Coder, class List, class Item>
void code_list(Coder& code, List& items, Item&& item) {
  std::uint64_t n = items.size();
  code(n);
  if constexpr (std::is_same_v<Coder, Decoder>) {
    if (n > code.room_for(8)) throw InputError("its header is truncated");
    items.clear();
    for (std::uint64_t i = 0; i < n; ++i) item(items.emplace_back());
  } else {
    for (const auto& value : items) item(value);
  }
}

template <class Coder>
void code_vector(Coder& code, Vec& vector) {
  std::uint64_t n = static_cast<std::uint64_t>(vector.size());
  code(n);
  if constexpr (std::is_same_v<Coder, Decoder>) {
    if (n > code.room_for(8)) throw InputError("an entry is truncated");
    vector.resize(static_cast<Eigen::Index>(n));
  }
  for (Eigen::Index i = 0; i < vector.size(); ++i) code(vector[i]);
}

template <class Coder, class Runs>
void code_runs(Coder& code, Runs& runs) {
  code_number(code, runs.n_all);
  code_list(code, runs.runs, [&](auto& run) {
    auto first = run.first, n = run.n;
    code_number(code, first), code_number(code, n);
    if constexpr (std::is_same_v<Coder, Decoder>) run = {first, n};
  });
}

}  // namespace dygita
