// Case control of a Nastran file.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <set>

#include "base/names.hpp"
#include "foreign/cards.hpp"
#include "foreign/nastran_cases.hpp"

namespace dygita {

namespace {

// The executive control, titles, and what is printed or plotted: nothing of the motion.
constexpr const char* silent_words[] = {
    "ID",    "CEND",   "TIME",    "DIAG",   "NASTRAN", "ASSIGN", "INIT",    "TITLE",  "SUBTI",  "LABEL",
    "ECHO",  "LINE",   "MAXLIN",  "SET ",   "SET\t",   "DISP",   "VELO",    "ACCE",   "SPCF",   "MPCF",
    "OLOAD", "GPF",    "PRES",    "VECT",   "SVECT",   "STRE",   "STRA",    "FORC",   "ELFO",   "ELST",
    "ESE",   "EKE",    "EDE",     "GPSTR",  "OFREQ",   "OTIME",  "OUTPUT",  "XYPLO",  "PLOT",   "ELSUM",
    "ELSDC", "GROUND", "WEIGHT",  "MEFF",   "RESVEC",  "SEALL",  "PARAM",   "OMODES", "SURFAC", "VOLUME",
    "$",     "RIGID",  "AUTOSPC", "MODCON", "SORT",    "SCREEN", "BOUTPUT", "BCRESU", "HDF5",   "MDLPRM"};

// "SPC(X) = 3" as "SPC" and "3"; a word alone has no value.
struct Said {
  std::string word, value;
};

Said said_in(const std::string& text) {
  const size_t equals = text.find('=');
  std::string word(without_blanks_around(std::string_view(text).substr(0, equals)));
  std::string value(equals == std::string::npos ? std::string_view()
                                                : without_blanks_around(std::string_view(text).substr(equals + 1)));
  if (equals == std::string::npos)
    if (const size_t blank = word.find_first_of(" \t,"); blank != std::string::npos) {
      value = std::string(without_blanks_around(std::string_view(word).substr(blank + 1)));
      word.resize(blank);
    }
  return {word, value};
}

NastranAnalysis::Kind kind_of_solution(const std::string& solution) {
  using Solution = NastranAnalysis::Kind;
  for (const char* name : {"101", "SESTATIC", "STATICS", "LINEAR STATICS", "1"})
    if (solution == name || solution == std::string(name) + "S") return Solution::statics;
  for (const char* name : {"103", "SEMODES", "MODES", "NORMAL MODES", "3"})
    if (solution == name) return Solution::modes;
  return Solution::other;
}

bool take(const Said& said, NastranCase& into) {
  constexpr size_t most_digits = 9;
  if (!is_whole(said.value) || said.value.size() > most_digits) return false;
  const long number = std::stol(said.value);
  if (said.word == "SPC") into.supports = number;
  if (said.word == "LOAD") into.loads = number;
  if (said.word == "METHOD") into.method = number;
  return said.word == "SPC" || said.word == "LOAD" || said.word == "METHOD";
}

}  // namespace

void read_case_control(const NastranModel& model, NastranAnalysis& analysis) {
  NastranCase above;
  if (!model.control().empty()) above.where = model.control()[0].where;
  for (const ControlLine& line : model.control()) {
    const Said said = said_in(line.text);
    const auto leave = [&](const std::string& why) {
      analysis.untranslated.push_back(fmt::format("{}: {}: {}", line.where, printable(line.text), why));
    };
    NastranCase& into = analysis.cases.empty() ? above : analysis.cases.back();
    if (said.word == "SOL") {
      analysis.kind = kind_of_solution(said.value);
      if (analysis.kind == NastranAnalysis::Kind::other) leave("statics (101) and modes (103) are read");
    } else if (said.word == "SUBCASE") {
      analysis.cases.push_back(above);
      analysis.cases.back().where = line.where;
      analysis.cases.back().name = "subcase " + said.value;
    } else if (!take(said, into) && std::none_of(std::begin(silent_words), std::end(silent_words),
                                                 [&](const char* word) { return line.text.starts_with(word); })) {
      leave("a deck has no word for it");
    }
  }
  if (analysis.cases.empty()) analysis.cases.push_back(above);
}

}  // namespace dygita
