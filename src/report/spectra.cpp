#include "report/spectra.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/log.hpp"
#include "base/names.hpp"
#include "drawing/units.hpp"
#include "result/limits.hpp"

namespace dygita {

namespace {

constexpr size_t most_ranges = 4;  // in a sentence

using SpecificationPtr = std::shared_ptr<const Specification>;

// What a request gives a spectrum; null: nothing.
SpecificationPtr requested(const Json& output, const ReportRequest& request, bool deck_has_some) {
  const auto& given = request.specifications;
  auto found = given.find(text(output, "name"));
  if (found == given.end() && (output.contains("specification") || !deck_has_some)) found = given.find("");
  if (found == given.end()) return nullptr;
  if (const std::string quantity = text(output, "quantity"); quantity != "acceleration") {
    warn(fmt::format(
        "spectrum '{}' is of {} and is not compared with the specification, which is of absolute acceleration",
        text(output, "name"), quantity));
    return nullptr;
  }
  return found->second;
}

SpecificationPtr specification_of(const Json& output, const ReportRequest& request, bool deck_has_some) {
  if (SpecificationPtr given = requested(output, request, deck_has_some)) return given;
  if (!output.contains("specification")) return nullptr;
  const Json& json = output["specification"];
  auto found = std::make_shared<Specification>();
  found->source = text(json, "source");
  found->frequency = json.at("frequency").get<std::vector<double>>();
  found->level = json.at("level").get<std::vector<double>>();
  return found;
}

// What is asked for and is not there; what one file that names no spectrum is held against.
void check_names(const std::vector<Json>& outputs, const ReportRequest& request, bool deck_has_some) {
  std::vector<std::string> names;
  for (const Json& output : outputs) names.push_back(text(output, "name"));
  for (const auto& [name, specification] : request.specifications)
    if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end())
      throw InputError(fmt::format("--specification {}={}: the run has no spectrum '{}'\n    {}", name,
                                   specification->source, name, did_you_mean(name, names)));
  if (deck_has_some || names.size() < 2 || !request.specifications.contains("")) return;
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "'" : ", '") + name + "'";
  warn(
      fmt::format("the specification is compared with every spectrum of the run, {}, since the deck specifies none; "
                  "--specification {}=FILE.csv applies it to one",
                  list, names.front()));
}

std::string hertz(double f) { return with_unit(f, "Hz"); }

std::string range_text(double from, double to) {
  return from < to ? hertz(from) + " to " + hertz(to) : "at " + hertz(from);
}

// "+7 dB at 2.1 kHz (1.7 to 2.5 kHz), +1 dB at 5 kHz".
std::string listed(const std::vector<Excursion>& ranges) {
  std::string result;
  for (size_t i = 0; i < ranges.size(); ++i) {
    const Excursion& r = ranges[i];
    if (i == most_ranges) return result + fmt::format(" and {} further ranges", ranges.size() - i);
    result += (i > 0 ? ", " : "") + decibels(r.worst) + " at " + hertz(r.at);
    if (r.from < r.to) result += " (" + range_text(r.from, r.to) + ")";
  }
  return result;
}

// What the run's own estimate leaves at a frequency, dB; zero where it has none.
double uncertainty(const Spectrum& s, double frequency) {
  if (s.band.n_rows() != s.table.n_rows()) return 0.0;
  const auto at = std::find(s.frequency().begin(), s.frequency().end(), frequency);
  return at == s.frequency().end() ? 0.0 : s.band.column("all")[static_cast<size_t>(at - s.frequency().begin())];
}

// The frequencies that record, spectrum and specification have in common.
FrequencyRange common(const Spectrum& s, const FrequencyRange& judged) {
  return {std::max({judged.from, s.frequency().front(), s.specification->frequency.front()}),
          std::min({judged.to, s.frequency().back(), s.specification->frequency.back()})};
}

// Why the specification is not judged over all of it; empty where it is.
std::string not_covered(const Spectrum& s, const FrequencyRange& judged) {
  const std::vector<double>& asked = s.specification->frequency;
  std::string result;
  const auto add = [&](double from, double to, const std::string& why) {
    result += (result.empty() ? "" : ", ") + range_text(from, to) + " (" + why + ")";
  };
  const FrequencyRange both = common(s, judged);
  constexpr double same = 1.0 + 1e-6;
  if (asked.front() * same < both.from)
    add(asked.front(), std::min(both.from, asked.back()),
        judged.from >= s.frequency().front() ? "the record is too short, 1/record length is " + hertz(judged.from)
                                             : "the spectrum starts at " + hertz(s.frequency().front()));
  // Spectra end at the last frequency of their octaves: less than a line short is no gap.
  const double line = s.frequency().size() > 1 ? s.frequency()[1] / s.frequency()[0] : 1.0;
  if (asked.back() > both.to * std::max(same, line) && both.to >= both.from)
    add(both.to, asked.back(),
        judged.to <= s.frequency().back() ? "beyond half the sampling rate, " + hertz(judged.to)
                                          : "the spectrum ends at " + hertz(s.frequency().back()));
  return result;
}

SpectrumVerdict not_judged(const Spectrum& s, const FrequencyRange& judged) {
  const std::string specification = range_text(s.specification->frequency.front(), s.specification->frequency.back());
  std::string why = "the spectrum is from " + hertz(s.frequency().front()) + " to " + hertz(s.frequency().back());
  if (std::isfinite(judged.from)) why += ", and the record allows " + hertz(judged.from) + " to " + hertz(judged.to);
  return {fmt::format("Spectrum '{}' is not compared with its specification ({}): they have no common frequency that "
                      "can be judged; {}.",
                      s.name, specification, why),
          {"'" + s.name + "' and its specification", "not judged", "no frequency in common", Grade::poor}};
}

}  // namespace

std::vector<Spectrum> spectra_of(const RunFolder& run, const ReportRequest& request) {
  const std::vector<Json> outputs = run.outputs(Display::As::spectrum);
  const bool deck_has_some =
      std::any_of(outputs.begin(), outputs.end(), [](const Json& output) { return output.contains("specification"); });
  check_names(outputs, request, deck_has_some);
  std::vector<Spectrum> spectra;
  for (const Json& output : outputs) {
    const std::string judged = output.contains("judge") ? text(output, "judge") : "maximax";
    Spectrum spectrum{text(output, "name"),
                      text(output, "of"),
                      text(output, "quantity"),
                      number(output, "q_factor"),
                      run.table(text(output, "file"), {"maximax", "positive", "negative", judged}),
                      specification_of(output, request, deck_has_some),
                      0.0,
                      {}};
    if (output.contains("specification")) spectrum.margin = output["specification"].value("margin", 0.0);
    spectrum.judged = judged;
    if (output.contains("band")) spectrum.band = run.table(text(output, "band"), {"all"});
    if (spectrum.table.n_rows() > 0) spectra.push_back(std::move(spectrum));
  }
  return spectra;
}

std::string shade_unreliable(const FrequencyRange& judged, Plot& plot) {
  std::string caption;
  if (judged.from > *plot.x.from && *plot.x.from < *plot.x.to) {
    plot.spans.push_back({*plot.x.from, std::min(judged.from, *plot.x.to), "the record is too short"});
    caption += "; unreliable, and not judged, below " + with_unit(judged.from, "Hz") + ", 1/record length";
  }
  if (judged.to < *plot.x.to) {
    plot.spans.push_back({std::max(judged.to, *plot.x.from), *plot.x.to, "beyond the sampling"});
    caption += "; beyond " + with_unit(judged.to, "Hz") + ", half the sampling rate, the record has no content";
  }
  return caption;
}

std::string decibels(double value) { return fmt::format("{}{:.1f}\u00a0dB", value < 0.0 ? "−" : "+", std::abs(value)); }

std::vector<Excursion> excursions(const Spectrum& spectrum, const FrequencyRange& judged, double limit, int sign) {
  std::vector<Excursion> found;
  const std::vector<double>& f = spectrum.frequency();
  const auto difference = [&](size_t i) {
    return 20.0 * std::log10(spectrum.level()[i] / spectrum.specification->level_at(f[i]));
  };
  bool is_outside = false;
  for (size_t i = 0; i < f.size(); ++i) {
    const double decibels = difference(i);
    const bool was_outside = is_outside;
    is_outside = judged.holds(f[i]) && std::isfinite(decibels) && sign * decibels > limit;
    if (!is_outside) continue;
    if (!was_outside) found.push_back({f[i], f[i], decibels, f[i]});
    Excursion& last = found.back();
    last.to = f[i];
    if (sign * decibels > sign * last.worst) {
      last.worst = decibels;
      last.at = f[i];
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [&](const Excursion& a, const Excursion& b) { return sign * a.worst > sign * b.worst; });
  return found;
}

bool SpectrumVerdict::is_above() const { return worst && worst->worst > limit::specification; }
bool SpectrumVerdict::is_margin_kept() const { return worst && worst->worst <= limit::specification - margin; }

namespace {

// What of the margin that is asked is there: ", where 3 dB are asked".
std::string asked_margin(const SpectrumVerdict& verdict) {
  if (!(verdict.margin > 0.0)) return "";
  return fmt::format(", where {:g}\u00a0dB of margin are asked", verdict.margin);
}

}  // namespace

SpectrumVerdict verdict_of(const Spectrum& s, const FrequencyRange& judged) {
  const Exceedance worst = largest_exceedance(*s.specification, s.frequency(), s.level(), judged);
  if (!worst.is_known) return not_judged(s, judged);
  const std::vector<Excursion> above = excursions(s, judged, limit::specification, 1),
                               below = excursions(s, judged, 6.0, -1);
  const FrequencyRange both = common(s, judged);
  const std::string open = not_covered(s, judged);
  const double unsure = uncertainty(s, worst.frequency);
  SpectrumVerdict verdict;
  verdict.worst = Excursion{worst.frequency, worst.frequency, worst.decibels, worst.frequency};
  verdict.uncertain = unsure;
  verdict.margin = s.margin;
  Card& card = verdict.card;
  card.name = "'" + s.name + "' against its specification";
  card.value = decibels(worst.decibels);
  card.note =
      "at " + hertz(worst.frequency) + (s.margin > 0.0 ? fmt::format(", {:g}\u00a0dB of margin asked", s.margin) : "");
  std::string& line = verdict.sentence;
  if (above.empty()) {
    line = fmt::format("Spectrum '{}' is below its specification over the judged range, closest at {} with {}{}",
                       s.name, hertz(worst.frequency), decibels(worst.decibels), asked_margin(verdict));
    if (-worst.decibels - s.margin < unsure) card.grade = Grade::fair;
    if (!verdict.is_margin_kept()) card.grade = Grade::poor;
  } else {
    line = fmt::format("Spectrum '{}' exceeds its specification by up to {}{}", s.name, listed(above),
                       asked_margin(verdict));
    card.grade = Grade::poor;
    if (above.front().from < above.front().to)
      card.note += ", above from " + range_text(above.front().from, above.front().to);
  }
  if (unsure > 0.05) {
    line += fmt::format("; uncertain there by {:.1f}\u00a0dB", unsure);
    card.note += fmt::format(", uncertain by {:.1f}\u00a0dB", unsure);
  }
  if (!below.empty()) line += "; below the −6 dB band by up to " + listed(below);
  line += ". Judged from " + range_text(both.from, both.to) + ".";
  if (!open.empty()) {
    line += " Of the specification not judged: " + open + ".";
    card.note += "; not judged: part of the specification";
    if (card.grade == Grade::fine) card.grade = Grade::fair;
  }
  return verdict;
}

}  // namespace dygita
