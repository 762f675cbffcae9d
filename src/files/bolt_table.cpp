#include "files/bolt_table.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "files/csv.hpp"

namespace dygita {

namespace {

// More columns do not fit on a line: bolts.csv has them all.
constexpr size_t most_columns = 8, widest_name = 14;

std::vector<std::string> static_steps(const Problem& problem) {
  std::vector<std::string> names;
  for (const StepPtr& step : problem.steps)
    if (step->is_static) names.push_back(step->name);
  return names;
}

std::string number(const std::optional<double>& value) { return value ? fmt::format("{:.9g}", *value + 0.0) : ""; }

// "-0.000" is zero.
std::string shown(const std::optional<double>& force) {
  if (!force) return "";
  return fmt::format("{:.3f}", std::abs(*force) < 0.5 ? 0.0 : *force / 1e3);
}

std::string percent(const std::optional<double>& value) {
  if (!value) return "-";
  return fmt::format("{:.2f} %", std::abs(*value) < 5e-5 ? 0.0 : 100.0 * *value);
}

bool is_same(const BoltByHand& a, const BoltByHand& b) {
  return a.resilience.bolt == b.resilience.bolt && a.resilience.plates == b.resilience.plates && a.share == b.share &&
         a.shortening == b.shortening;
}

// The formula of a bolt that the others before it have not.
std::string hand_line(const BoltSummary& bolt) {
  const BoltByHand& hand = *bolt.formula;
  return fmt::format(
      "    by hand (VDI 2230{}), '{}': {:.2f} um for {:.3f} kN, found {:.2f} um; bolt {:.4g} kN/um, plates {:.4g} "
      "kN/um, load "
      "factor {:.3f}",
      hand.share < 1.0 ? fmt::format(", {:.4g} of a bolt", hand.share) : "", bolt.name, hand.shortening * 1e6,
      bolt.target.value_or(bolt.tightened) / 1e3, bolt.shortening * 1e6, 1e-9 / hand.resilience.bolt,
      1e-9 / hand.resilience.plates, hand.resilience.load_factor());
}

}  // namespace

std::string bolts_csv(const Problem& problem, const RunResult& result) {
  const std::vector<std::string> steps = static_steps(problem);
  std::string text = "bolt,area [m^2],target [N]";
  for (const std::string& step : steps) text += "," + quoted("after " + step + " [N]");
  text +=
      ",lowest [N],highest [N],last [N],loss [1],shortening [m],plastic_opening [m],hand [N],hand_shortening "
      "[m],load_factor [1],loss_by_yield [1],swing [N],converged";
  const bool has_margins = std::any_of(result.bolts.begin(), result.bolts.end(),
                                       [](const BoltSummary& bolt) { return bolt.margins.has_value(); });
  text += has_margins ? ",proof_load [N],largest [N],margin_proof [1],margin_slip [1],margin_separation [1]\n" : "\n";
  for (const BoltSummary& bolt : result.bolts) {
    text += quoted(bolt.name) + "," + number(bolt.area) + "," + number(bolt.target);
    for (size_t i = 0; i < steps.size(); ++i)
      text += "," + (i < bolt.after_static.size() ? number(bolt.after_static[i]) : std::string());
    for (const std::optional<double>& value :
         {std::optional(bolt.lowest), std::optional(bolt.highest), std::optional(bolt.last), bolt.loss(),
          std::optional(bolt.shortening), std::optional(bolt.plastic_opening)})
      text += "," + number(value);
    text += "," + number(bolt.hand);
    text += bolt.formula ? "," + number(bolt.formula->shortening) + "," + number(bolt.formula->resilience.load_factor())
                         : ",,";
    text += "," + number(bolt.loss_by_yield()) + "," + number(bolt.swing) + (result.converged ? ",1" : ",0");
    if (const auto& margins = bolt.margins)
      for (const std::optional<double>& value :
           {std::optional(margins->proof_load), std::optional(margins->largest),
            std::optional(margins->against_proof(bolt.tightened)), margins->slip, margins->against_separation()})
        text += "," + number(value);
    else if (has_margins)
      text += ",,,,,";
    text += "\n";
  }
  return text;
}

std::vector<std::string> bolt_lines(const Problem& problem, const RunResult& result) {
  if (result.bolts.empty()) return {};
  const std::vector<std::string> steps = static_steps(problem);
  const size_t first = steps.size() > most_columns ? steps.size() - most_columns : 0;
  const bool has_shock = steps.size() < problem.steps.size();
  size_t widest = 4;
  for (const BoltSummary& bolt : result.bolts) widest = std::max(widest, bolt.name.size());

  std::vector<std::pair<std::string, std::vector<std::string>>> columns;  // head, one text a bolt
  const auto add = [&](const std::string& head, auto&& text_of) {
    columns.push_back({head.size() > widest_name ? head.substr(0, widest_name - 2) + ".." : head, {}});
    for (const BoltSummary& bolt : result.bolts) columns.back().second.push_back(text_of(bolt));
  };
  const auto is_target = [](const BoltSummary& bolt) { return bolt.target.has_value(); };
  if (std::any_of(result.bolts.begin(), result.bolts.end(), is_target))
    add("target", [](const BoltSummary& b) { return shown(b.target); });
  for (size_t i = first; i < steps.size(); ++i)
    add(steps[i],
        [i](const BoltSummary& b) { return i < b.after_static.size() ? shown(b.after_static[i]) : std::string("-"); });
  if (has_shock) {
    add("lowest", [](const BoltSummary& b) { return shown(b.lowest); });
    add("highest", [](const BoltSummary& b) { return shown(b.highest); });
    add("at the end", [](const BoltSummary& b) { return shown(b.last); });
  }
  add("loss", [](const BoltSummary& b) { return percent(b.loss()); });
  const auto add_margin = [&](const std::string& head, auto&& margin_of) {
    if (std::any_of(result.bolts.begin(), result.bolts.end(),
                    [&](const BoltSummary& b) { return margin_of(b).has_value(); }))
      add(head, [&](const BoltSummary& b) {
        const std::optional<double> margin = margin_of(b);
        return margin ? fmt::format("{:.2f}", *margin) : std::string("-");
      });
  };
  add_margin("proof", [](const BoltSummary& b) {
    return b.margins ? std::optional(b.margins->against_proof(b.tightened)) : std::nullopt;
  });
  add_margin("slip", [](const BoltSummary& b) { return b.margins ? b.margins->slip : std::nullopt; });
  add_margin("separation",
             [](const BoltSummary& b) { return b.margins ? b.margins->against_separation() : std::nullopt; });
  const auto has_formula = [](const BoltSummary& bolt) { return bolt.formula.has_value(); };
  if (std::any_of(result.bolts.begin(), result.bolts.end(), has_formula))
    add("by hand", [](const BoltSummary& b) { return shown(b.hand); });

  std::vector<std::string> lines{"  bolts: forces (kN) at the end of each static step" +
                                 std::string(has_shock ? ", lowest and highest in the dynamic ones" : "") +
                                 "; loss since a bolt's own tightening" +
                                 std::string(std::any_of(result.bolts.begin(), result.bolts.end(),
                                                         [](const BoltSummary& b) { return b.margins.has_value(); })
                                                 ? "; margins"
                                                 : "")};
  if (first > 0)
    lines.push_back(fmt::format("    the last {} static steps; bolts.csv has all {}", most_columns, steps.size()));
  for (size_t row = 0; row <= result.bolts.size(); ++row) {
    std::string line = fmt::format("    {:<{}}", row == 0 ? "" : result.bolts[row - 1].name, widest);
    for (const auto& [head, texts] : columns) {
      size_t width = std::max<size_t>(7, head.size());
      for (const std::string& text : texts) width = std::max(width, text.size());
      line += fmt::format("  {:>{}}", row == 0 ? head : texts[row - 1], width);
    }
    lines.push_back(line);
  }
  for (size_t i = 0; i < result.bolts.size(); ++i) {
    const auto& bolts = result.bolts;
    const auto known = [&](const BoltSummary& other) {
      return other.formula && is_same(*other.formula, *bolts[i].formula);
    };
    if (bolts[i].formula && std::none_of(bolts.begin(), bolts.begin() + static_cast<std::ptrdiff_t>(i), known))
      lines.push_back(hand_line(bolts[i]));
  }
  return lines;
}

}  // namespace dygita
