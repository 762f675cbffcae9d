#include "report/html.hpp"

#include <algorithm>
#include <cctype>

#include "base/log.hpp"
#include "drawing/svg_text.hpp"
#include "report/embedded.hpp"

namespace dygita::html {

namespace {

constexpr const char* style = R"(
body { font: 15px/1.45 Helvetica, Arial, sans-serif; color: #222; background: #fff; max-width: 1100px; margin: 24px auto; padding: 0 20px; }
h1 { font-size: 24px; margin: 0 0 2px; }
h2 { font-size: 19px; margin: 34px 0 8px; border-bottom: 2px solid #ddd; padding-bottom: 3px; }
h3 { font-size: 16px; margin: 22px 0 4px; }
p { margin: 6px 0; max-width: 900px; }
.under { color: #555; margin: 0 0 16px; }
.verdict { border-left: 8px solid; padding: 8px 14px; margin: 10px 0; font-size: 16px; }
.missed { color: #b34700; font-weight: bold; }
.good { border-color: #009e73; background: #eef8f4; }
.verdict.fair { border-color: #e69f00; background: #fdf7ea; }
.bad { border-color: #d55e00; background: #fdf1ea; }
.cards { display: flex; flex-wrap: wrap; gap: 10px; margin: 12px 0; }
.card { border: 1px solid #ccc; border-top: 4px solid #888; padding: 6px 12px 8px; min-width: 150px; flex: 1; max-width: 240px; }
.card.fine { border-top-color: #009e73; }
.card.fair { border-top-color: #e69f00; }
.card.poor { border-top-color: #d55e00; }
details { margin: 14px 0; }
summary { font-weight: bold; font-size: 16px; cursor: pointer; }
td.sum { border-top: 2px solid #bbb; }
.card b { display: block; font-size: 20px; }
.card small { color: #555; display: block; }
ul.warnings { list-style: none; padding: 0; }
ul.warnings li { border-left: 8px solid #e69f00; background: #fdf7ea; padding: 6px 12px; margin: 6px 0; }
table { border-collapse: collapse; margin: 8px 0 16px; font-size: 14px; display: block; overflow-x: auto; max-width: 100%; }
th { text-align: left; border-bottom: 2px solid #bbb; padding: 3px 14px 3px 0; vertical-align: bottom; }
td { border-bottom: 1px solid #e4e4e4; padding: 3px 14px 3px 0; vertical-align: top; }
table.numbers td + td, table.numbers th + th { text-align: right; }
table.numbers td.text, table.numbers th.text { text-align: left; }
td:first-child { white-space: nowrap; }
ul.warnings ul { margin: 4px 0 0; padding-left: 18px; list-style: disc; } ul.warnings ul li { border: 0; background: none; padding: 0; margin: 2px 0; }
ul.warnings details { margin: 4px 0 0; } ul.warnings summary { font-size: 14px; font-weight: normal; }
figure { margin: 8px 0; break-inside: avoid; }
figcaption { color: #555; font-size: 13px; max-width: 900px; }
svg { max-width: 100%; height: auto; }
.blocks { display: flex; flex-wrap: wrap; gap: 0 48px; align-items: flex-start; }
.row { display: flex; flex-wrap: wrap; gap: 4px 20px; align-items: flex-start; }
.row figure { flex: 1 1 480px; min-width: 0; max-width: 540px; }
@media print { table { display: table; } details::details-content { content-visibility: visible; display: block; } summary { list-style: none; } body { margin: 0; max-width: none; font-size: 12px; } h2 { break-after: avoid; } h3 { break-after: avoid; }
  .row figure { flex-basis: 300px; } .card, .verdict, ul.warnings li { -webkit-print-color-adjust: exact; print-color-adjust: exact; } }
)";

// A column of words among numbers.
bool is_text(const std::vector<std::vector<std::string>>& rows, size_t column) {
  return std::all_of(rows.begin(), rows.end(), [&](const std::vector<std::string>& row) {
    return column >= row.size() || row[column].empty() || std::isalpha(static_cast<unsigned char>(row[column].front()));
  });
}

}  // namespace

std::string page(const std::string& title, const std::string& body_html) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" + escaped(title) +
         "</title>\n<meta name=\"viewport\" content=\"width=device-width\">\n<style>" + style +
         embedded_text("page.css") + "</style>\n</head>\n<body>\n" + body_html + "<script>\n" +
         embedded_text("charts.js") + embedded_text("turn.js") + "</script>\n</body>\n</html>\n";
}

std::string section(const Section& section) {
  if (section.body_html.empty()) return "";
  const std::string mark = section.mark.empty() ? "" : "<p class=\"missed\">" + escaped(section.mark) + "</p>\n";
  return "<section>\n<h2>" + escaped(section.title) + "</h2>\n" + mark + section.body_html + "</section>\n";
}

std::string heading(const std::string& title) { return "<h3>" + escaped(title) + "</h3>\n"; }

std::string paragraph(const std::string& text) { return "<p>" + escaped(text) + "</p>\n"; }

std::string figure(const std::string& drawing, const std::string& caption, const std::string& stamp) {
  if (drawing.empty()) return "";
  std::string stamped = drawing;
  if (!stamp.empty())
    stamped.insert(
        stamped.rfind("</svg>"),
        "<text x=\"99.5%\" y=\"98.5%\" text-anchor=\"end\" font-size=\"11\" font-weight=\"bold\" fill=\"#d55e00\" "
        "stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\">" +
            escaped(stamp) + "</text>\n");
  return "<figure>\n" + stamped + (caption.empty() ? "" : "<figcaption>" + escaped(caption) + "</figcaption>\n") +
         "</figure>\n";
}

std::string row(const std::vector<std::string>& figures) {
  std::string inside;
  for (const std::string& drawing : figures) inside += drawing;
  return inside.empty() ? "" : "<div class=\"row\">\n" + inside + "</div>\n";
}

std::string table(const std::vector<std::string>& header, const std::vector<std::vector<std::string>>& rows,
                  bool numbers) {
  if (rows.empty()) return "";
  std::string result = numbers ? "<table class=\"numbers\">\n<tr>" : "<table>\n<tr>";
  const auto mark = [&](size_t column) {
    return numbers && column > 0 && is_text(rows, column) ? " class=\"text\"" : "";
  };
  for (size_t i = 0; i < header.size(); ++i)
    result += std::string("<th") + mark(i) + ">" + escaped(header[i]) + "</th>";
  result += "</tr>\n";
  for (const std::vector<std::string>& cells : rows) {
    result += "<tr>";
    for (size_t i = 0; i < cells.size(); ++i)
      result += std::string("<td") + mark(i) + ">" + escaped(cells[i]) + "</td>";
    result += "</tr>\n";
  }
  return result + "</table>\n";
}

std::string folded(const std::string& title, const std::string& body_html) {
  return body_html.empty() ? "" : "<details>\n<summary>" + escaped(title) + "</summary>\n" + body_html + "</details>\n";
}

std::string table_under(const std::string& title, const std::string& table_html, size_t n_rows) {
  constexpr size_t most_rows = 12;
  if (table_html.empty()) return "";
  return n_rows > most_rows ? folded(fmt::format("{} ({})", title, n_rows), table_html) : heading(title) + table_html;
}

std::string block(const std::string& body_html) { return "<div>\n" + body_html + "</div>\n"; }

std::string blocks(const std::string& blocks_html) {
  return blocks_html.empty() ? "" : "<div class=\"blocks\">\n" + blocks_html + "</div>\n";
}

std::string list(const std::vector<std::string>& items, const char* name) {
  std::vector<std::string> safe;
  for (const std::string& item : items) safe.push_back(escaped(item));
  return html_list(safe, name);
}

std::string html_list(const std::vector<std::string>& items_html, const char* name) {
  if (items_html.empty()) return "";
  std::string result = std::string("<ul class=\"") + name + "\">\n";
  for (const std::string& item : items_html) result += "<li>" + item + "</li>\n";
  return result + "</ul>\n";
}

}  // namespace dygita::html
