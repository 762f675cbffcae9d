// Records of a file one after the other: length, bytes, and a checksum that continues from that of the record before.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

namespace dygita {

std::uint64_t chained_sum(std::uint64_t before, const std::string& bytes);
// False: it could not be written.
bool put_record(std::FILE* file, const std::string& payload, std::uint64_t sum);
// The record where the file stands, if it is whole and follows one with the sum `before`.
bool get_record(std::FILE* file, std::uint64_t before, std::string& payload, std::uint64_t& sum);

}  // namespace dygita
