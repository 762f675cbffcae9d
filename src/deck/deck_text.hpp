// The text of a deck.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace dygita {

// The file's text as Lua is to read it: without the byte order mark of some editors, a first line for the shell (#!)
// made a comment. Empty where there is no such file.
std::optional<std::string> read_deck_text(const std::filesystem::path& path);

}  // namespace dygita
