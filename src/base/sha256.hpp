// SHA-256 (FIPS 180-4) and HMAC with it (RFC 2104): digests that nobody can make something else fit.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace dygita {

using Digest256 = std::array<unsigned char, 32>;

class Sha256 {
 public:
  void add(std::string_view bytes);
  Digest256 value() const;

 private:
  void take(const unsigned char* block);

  std::array<std::uint32_t, 8> state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                      0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<unsigned char, 64> block_{};
  std::uint64_t n_bytes_ = 0;
};

Digest256 sha256(std::string_view bytes);
// secret: at most 64 bytes.
Digest256 hmac_sha256(std::string_view secret, std::string_view bytes);

std::string hexadecimal(const Digest256& digest);
inline std::string bytes_of(const Digest256& digest) { return {digest.begin(), digest.end()}; }

}  // namespace dygita
