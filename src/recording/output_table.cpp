#include "recording/output_table.hpp"

namespace dygita {

const OutputEntry* output_entry(const std::string& word) {
  for (const OutputEntry& entry : output_table())
    if (entry.word == word) return &entry;
  return nullptr;
}

OutputPtr make_output(const ModelArguments& arguments) {
  const OutputEntry* entry = output_entry(arguments.word());
  CHECK(entry, "no file of src/recording/outputs makes '" + arguments.path() + "'");
  return entry->make(arguments);
}

}  // namespace dygita
