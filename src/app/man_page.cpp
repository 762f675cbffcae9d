#include <spdlog/fmt/fmt.h>

#include "app/command_pages.hpp"

namespace dygita {

namespace {

// Text as roff prints it: a dash that stays one, a backslash, and no control line.
std::string roff(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\')
      escaped += "\\e";
    else if (c == '-')
      escaped += "\\-";
    else
      escaped += c;
  }
  return escaped.starts_with('.') || escaped.starts_with('\'') ? "\\&" + escaped : escaped;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

std::string option_heading(const OptionRow& option) {
  std::string heading;
  for (const std::string& name : option.names)
    heading += (heading.empty() ? "" : ", ") + (option.is_positional ? italic(name) : bold(name));
  if (!option.value.empty() && !option.is_positional) heading += " " + italic(option.value);
  return heading;
}

std::string option_entry(const OptionRow& option) {
  std::string doc = option.doc;
  if (option.is_positional) doc += " (" + option.value + ")";
  if (option.is_repeated) doc += "; may be given several times";
  if (!option.by_default.empty()) doc += " [" + option.by_default + "]";
  return ".TP\n" + option_heading(option) + "\n" + roff(doc) + "\n";
}

std::string synopsis(const CommandRow& command) {
  std::string line = ".B dygita " + roff(command.name) + "\n";
  for (const OptionRow& option : command.options)
    if (option.is_positional) line += italic(option.names.front()) + "\n";
  return line + "[" + italic("options") + "]\n.br\n";
}

constexpr const char* description =
    "Dygita computes how a shock goes through a bolted assembly. Parts are linear elastic; contact, friction,\n"
    "separation, tightening and yielding of bolts happen on the interfaces between them. A computation is described\n"
    "by a Lua program, the deck; results are files for ParaView, CSV tables and a report of one page.\n";

constexpr const char* files =
    ".TP\n.I out/<problem>/<case>/report.html\nthe run on one page\n"
    ".TP\n.I out/<problem>/<case>/<problem>.pvd, interfaces.pvd\nthe parts and the interfaces through time, for "
    "ParaView\n"
    ".TP\n.I out/<problem>/<case>/*.csv\ntables, in SI\n"
    ".TP\n.I out/<problem>/<case>/run.json\nthe record of the run\n"
    ".TP\n.I out/<problem>/<case>/state.dygita\nwhat\n.B dygita continue\nstarts from\n";

}  // namespace

std::string man_page(const std::vector<CommandRow>& rows, const std::vector<std::pair<int, std::string>>& exits,
                     const std::string& version) {
  std::string page =
      ".\\\" Printed by dygita \\-\\-man.\n.TH DYGITA 1 \"\" \"dygita " + version + "\" \"User Commands\"\n";
  page += ".SH NAME\ndygita \\- shock propagation through bolted assemblies\n.SH SYNOPSIS\n";
  for (size_t i = 1; i < rows.size(); ++i) page += synopsis(rows[i]);
  page += std::string(".SH DESCRIPTION\n") + description + ".SH OPTIONS\n";
  for (const OptionRow& option : rows.front().options) page += option_entry(option);
  page += ".SH COMMANDS\n";
  for (size_t i = 1; i < rows.size(); ++i) {
    page += ".SS dygita " + roff(rows[i].name) + "\n" + roff(rows[i].doc) + "\n";
    for (const OptionRow& option : rows[i].options)
      if (option.names.back() != "--help") page += option_entry(option);
  }
  page += ".SH EXIT STATUS\n";
  for (const auto& [code, meaning] : exits) page += fmt::format(".TP\n.B {}\n{}\n", code, roff(meaning));
  page += std::string(".SH FILES\n") + files;
  page +=
      ".SH SEE ALSO\nThe user\\(aqs guide, the deck reference (\\fBdygita schema\\fR) and the method, in the manual.\n";
  return page;
}

}  // namespace dygita
