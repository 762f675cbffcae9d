#include "base/sha256.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <bit>

#include "base/error.hpp"

namespace dygita {

namespace {

constexpr std::array<std::uint32_t, 64> constants = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

const unsigned char* data_of(std::string_view bytes) { return reinterpret_cast<const unsigned char*>(bytes.data()); }

}  // namespace

void Sha256::take(const unsigned char* block) {
  std::array<std::uint32_t, 64> w;
  for (size_t i = 0; i < 16; ++i)
    w[i] = std::uint32_t{block[4 * i]} << 24 | std::uint32_t{block[4 * i + 1]} << 16 |
           std::uint32_t{block[4 * i + 2]} << 8 | std::uint32_t{block[4 * i + 3]};
  for (size_t i = 16; i < 64; ++i) {
    const std::uint32_t a = w[i - 15], b = w[i - 2];
    w[i] = w[i - 16] + (std::rotr(a, 7) ^ std::rotr(a, 18) ^ a >> 3) + w[i - 7] +
           (std::rotr(b, 17) ^ std::rotr(b, 19) ^ b >> 10);
  }
  auto [a, b, c, d, e, f, g, h] = state_;
  for (size_t i = 0; i < 64; ++i) {
    const std::uint32_t one =
        h + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) + ((e & f) ^ (~e & g)) + constants[i] + w[i];
    const std::uint32_t two = (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
    h = g, g = f, f = e, e = d + one;
    d = c, c = b, b = a, a = one + two;
  }
  const std::uint32_t sums[] = {a, b, c, d, e, f, g, h};
  for (size_t i = 0; i < 8; ++i) state_[i] += sums[i];
}

void Sha256::add(std::string_view bytes) {
  while (!bytes.empty()) {
    const size_t at = n_bytes_ % 64, n = std::min(bytes.size(), 64 - at);
    n_bytes_ += n;
    if (n == 64) {
      take(data_of(bytes));
    } else {
      std::copy_n(data_of(bytes), n, block_.begin() + static_cast<std::ptrdiff_t>(at));
      if (at + n == 64) take(block_.data());
    }
    bytes.remove_prefix(n);
  }
}

Digest256 Sha256::value() const {
  Sha256 all = *this;
  const std::uint64_t n_bits = 8 * n_bytes_;
  std::string end(1, '\x80');
  end.append((119 - n_bytes_ % 64) % 64, '\0');
  for (int shift = 56; shift >= 0; shift -= 8) end += static_cast<char>(n_bits >> shift);
  all.add(end);
  Digest256 digest;
  for (size_t i = 0; i < 32; ++i) digest[i] = static_cast<unsigned char>(all.state_[i / 4] >> (24 - 8 * (i % 4)));
  return digest;
}

Digest256 sha256(std::string_view bytes) {
  Sha256 all;
  all.add(bytes);
  return all.value();
}

Digest256 hmac_sha256(std::string_view secret, std::string_view bytes) {
  CHECK(secret.size() <= 64, "a secret of at most a block");
  const auto padded = [&](char with) {
    std::string block(64, with);
    for (size_t i = 0; i < secret.size(); ++i) block[i] = static_cast<char>(block[i] ^ secret[i]);
    return block;
  };
  Sha256 inner, outer;
  inner.add(padded(0x36));
  inner.add(bytes);
  outer.add(padded(0x5c));
  outer.add(bytes_of(inner.value()));
  return outer.value();
}

std::string hexadecimal(const Digest256& digest) {
  std::string text;
  for (const unsigned char byte : digest) text += fmt::format("{:02x}", byte);
  return text;
}

}  // namespace dygita
