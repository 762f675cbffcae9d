#include "deck/deck_text.hpp"

#include <fstream>

#include "base/plain_file.hpp"

namespace dygita {

std::optional<std::string> read_deck_text(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored) || !std::ifstream(path)) return {};
  std::string text = text_of_file(path.string());
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  if (text.starts_with("#!")) text.replace(0, 2, "--");
  return text;
}

}  // namespace dygita
