// The pieces a report's page is made of. Texts are escaped here, unless they are said to be HTML.
#pragma once

#include <string>
#include <vector>

namespace dygita::html {

std::string page(const std::string& title, const std::string& body_html);
// Empty where the body is.
std::string section(const std::string& title, const std::string& body_html);
std::string heading(const std::string& title);  // of a part of a section
std::string paragraph(const std::string& text);
// `drawing` is SVG; the caption says what it shows.
std::string figure(const std::string& drawing, const std::string& caption = {});
// Figures side by side where the page is wide enough.
std::string row(const std::vector<std::string>& figures);
// The first column is a name, the others are numbers where `numbers` is set.
std::string table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows,
                  bool numbers = false);
// Blocks stand side by side where they have room.
std::string block(const std::string& body_html);
std::string blocks(const std::string& blocks_html);
std::string list(const std::vector<std::string>& items, const char* style = "");

}  // namespace dygita::html
