// Which program a file of a model is of, by the end of its name.
#include <filesystem>

#include "base/error.hpp"
#include "base/names.hpp"
#include "foreign/abaqus_deck.hpp"
#include "foreign/nastran_deck.hpp"

namespace dygita {

std::string imported_deck(const ImportOptions& options) {
  const std::string end = in_lower_case(std::filesystem::path(options.file).extension().string());
  if (end == ".inp") return deck_of_abaqus(options);
  for (const char* one : {".bdf", ".nas", ".dat", ".fem"})
    if (end == one) return deck_of_nastran(options);
  throw InputError(fmt::format(
      "'{}' is no model that is read\n    its name ends in .inp (Abaqus, CalculiX) or .bdf, .nas, .dat, .fem (Nastran)",
      printable(options.file)));
}

}  // namespace dygita
