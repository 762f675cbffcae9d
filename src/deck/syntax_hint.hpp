// What may be meant where Lua finds a deck badly written.
#pragma once

#include <string>

namespace dygita {

// "\n    write 20*mm: ..." for Lua's message of a deck's text; empty where nothing comes to mind.
std::string syntax_hint(const std::string& message, const std::string& text);

}  // namespace dygita
