#include "deck/deck_text.hpp"

#include <fstream>
#include <iterator>

namespace dygita {

std::optional<std::string> read_deck_text(const std::filesystem::path& path) {
  std::error_code ignored;
  std::ifstream stream(path, std::ios::binary);
  if (!std::filesystem::is_regular_file(path, ignored) || !stream) return {};
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  if (text.starts_with("#!")) text.replace(0, 2, "--");
  return text;
}

}  // namespace dygita
