// The fields of a state that several ranks keep: each writes its own beside the state file (<state>.parts/<rank>),
// which records what they contain. Any number of ranks resumes from all of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "interfaces/interface_fields.hpp"

namespace dygita {

// What a rank has written.
struct StatePart {
  std::vector<AssembledRuns> runs;  // of each step
  std::uint64_t sum = 0;            // checksum of the fields

  bool operator==(const StatePart&) const = default;
};

using FieldSizes = std::vector<std::vector<Eigen::Index>>;  // unknowns of each increment of each step

struct StateParts {
  FieldSizes sizes;
  std::vector<StatePart> of_ranks;

  bool is_empty() const { return of_ranks.empty(); }
};

std::filesystem::path state_parts_folder(const std::filesystem::path& state);

// Writes this rank's share of as many increments as `sizes` has. Throws InputError: it cannot be written.
StatePart write_state_part(const std::filesystem::path& file, const InterfaceFields& kept, const FieldSizes& sizes);

// As bytes, for the state file and for the other ranks; throws InputError where they are damaged.
std::string bytes_of(const StatePart& part);
StatePart state_part_of(std::string bytes);

// The fields that lie in the parts of a state. A rank reads its share of the files once through to know that they are
// whole (one process all of them). Throws InputError: a part is missing, damaged or of another run.
std::shared_ptr<const InterfaceFields> fields_of_parts(const std::filesystem::path& state, const StateParts& parts);

}  // namespace dygita
