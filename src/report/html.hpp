// The pieces a report's page is made of. Texts are escaped here, unless they are said to be HTML.
#pragma once

#include <string>
#include <vector>

namespace dygita::html {

std::string page(const std::string& title, const std::string& body_html);
// Empty where the body is. The mark, where there is one, stands under the heading.
struct Section {
  std::string title, mark, body_html;
};
std::string section(const Section& section);
inline std::string section(const std::string& title, const std::string& body_html) {
  return section(Section{title, "", body_html});
}
std::string heading(const std::string& title);  // of a part of a section
std::string paragraph(const std::string& text);
// `drawing` is SVG; the caption says what it shows. The stamp is written into the drawing, which may be taken out of
// the page.
std::string figure(const std::string& drawing, const std::string& caption = {}, const std::string& stamp = {});
// Figures side by side where the page is wide enough.
std::string row(const std::vector<std::string>& figures);
// The first column is a name, the others are numbers where `numbers` is set.
std::string table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows,
                  bool numbers = false);
// Blocks stand side by side where they have room.
std::string block(const std::string& body_html);
std::string blocks(const std::string& blocks_html);
// Closed until it is asked for, open in print.
std::string folded(const std::string& title, const std::string& body_html);
// `folded` where a table has more rows than a reader takes in at a glance; else under a heading.
std::string table_under(const std::string& title, const std::string& table_html, size_t n_rows);
std::string list(const std::vector<std::string>& items, const char* style = "");
// One item of HTML for each.
std::string html_list(const std::vector<std::string>& items_html, const char* style = "");

}  // namespace dygita::html
