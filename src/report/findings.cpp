#include "report/findings.hpp"

#include <algorithm>
#include <cmath>

#include "base/log.hpp"
#include "base/name_list.hpp"
#include "drawing/time_axis.hpp"
#include "drawing/units.hpp"
#include "report/contacts.hpp"
#include "report/spectra.hpp"
#include "result/limits.hpp"

namespace dygita {

namespace {

constexpr size_t most_named = 3, most_cards = 6;

// Rounded down: "93 % or more" is so. Less than nothing is kept as nothing.
std::string whole_percent(double share) {
  return fmt::format("{:.0f}\u00a0%", std::floor(100.0 * std::max(0.0, share) + 1e-6));
}

struct JudgedSpectrum {
  std::string name;
  SpectrumVerdict verdict;
};

std::string further(size_t n, size_t named, const char* what) {
  return n > named ? fmt::format(" and {} more{}", n - named, what) : "";
}

std::string uncertain(double decibels) {
  return decibels > 0.05 ? fmt::format(" (uncertain by {:.1f}\u00a0dB)", decibels) : "";
}

// "exceeds its specification by 6.3 dB at 100 Hz", "stays below its specification by 1.2 dB at 2 kHz, of 3 dB asked".
std::string told_of_miss(const SpectrumVerdict& verdict) {
  const Excursion& at = *verdict.worst;
  const std::string where = " at " + with_unit(at.at, "Hz") + uncertain(verdict.uncertain);
  if (verdict.is_above()) return fmt::format("exceeds its specification by {:.1f}\u00a0dB", at.worst) + where;
  return fmt::format("stays below its specification by {:.1f}\u00a0dB{}, of the {:g}\u00a0dB that are asked", -at.worst,
                     where, verdict.margin);
}

// What of the margins that are asked is kept: " and keep the 3 dB that are asked".
std::string told_of_margins(const std::vector<JudgedSpectrum>& judged) {
  double least = 1e300, most = 0.0;
  for (const JudgedSpectrum& one : judged) {
    least = std::min(least, one.verdict.margin);
    most = std::max(most, one.verdict.margin);
  }
  if (!(most > 0.0)) return "";
  return (judged.size() == 1 ? " and keeps the " : " and keep the ") +
         (least == most ? fmt::format("{:g}\u00a0dB", most) : "margins") + " that are asked";
}

std::string told_of_spectra(const std::vector<JudgedSpectrum>& judged) {
  const auto n_above = static_cast<size_t>(std::count_if(
      judged.begin(), judged.end(), [](const JudgedSpectrum& one) { return !one.verdict.is_margin_kept(); }));
  const JudgedSpectrum& worst = judged.front();
  const Excursion& at = *worst.verdict.worst;
  if (n_above == 0)
    return fmt::format(
        "{} below {} specification{}, {}{:.1f}\u00a0dB at {}{}.",
        judged.size() == 1 ? "'" + worst.name + "' stays" : fmt::format("All {} spectra stay", judged.size()),
        judged.size() == 1 ? "its" : "their", told_of_margins(judged),
        judged.size() == 1 ? "nearest by " : "nearest '" + worst.name + "' by ", -at.worst, with_unit(at.at, "Hz"),
        uncertain(worst.verdict.uncertain));
  std::string told;
  for (size_t i = 0; i < std::min(n_above, most_named); ++i)
    told += fmt::format("{}'{}' {}", i > 0 ? "; " : "", judged[i].name, told_of_miss(judged[i].verdict));
  told += further(n_above, most_named, "");
  const size_t below = judged.size() - n_above;
  return told + (below == 0   ? "."
                 : below == 1 ? "; the other stays below its own."
                              : fmt::format("; the other {} stay below theirs.", below));
}

Finding of_spectra(const RunFolder& run, const ReportRequest& request) {
  Finding finding;
  std::vector<JudgedSpectrum> judged;
  std::string not_judged;
  for (const Spectrum& spectrum : spectra_of(run, request)) {
    if (!spectrum.specification) continue;
    JudgedSpectrum one{spectrum.name, verdict_of(spectrum, TimeAxis(run.record().at("steps")).judged())};
    finding.cards.push_back(one.verdict.card);
    if (!one.verdict.worst)
      not_judged += " '" + spectrum.name + "' and its specification share no frequency that can be judged.";
    else
      judged.push_back(std::move(one));
  }
  std::stable_sort(judged.begin(), judged.end(), [](const JudgedSpectrum& a, const JudgedSpectrum& b) {
    return a.verdict.worst->worst + a.verdict.margin > b.verdict.worst->worst + b.verdict.margin;
  });
  if (!judged.empty()) finding.sentence = told_of_spectra(judged);
  finding.sentence += finding.sentence.empty() && !not_judged.empty() ? not_judged.substr(1) : not_judged;
  std::stable_sort(finding.cards.begin(), finding.cards.end(),
                   [](const Card& a, const Card& b) { return a.grade > b.grade; });
  if (const size_t n = finding.cards.size(); n > most_cards) {
    const Grade grade = finding.cards[most_cards - 1].grade;
    finding.cards.resize(most_cards - 1);
    finding.cards.push_back({"further spectra", fmt::format("{}", n - most_cards + 1), "no worse than these", grade});
  }
  return finding;
}

// Those whose loss is known.
struct Kept {
  std::string name;
  double at_end, lowest;  // of what the tightening gave; lowest: in the motion, nan without
};

std::vector<Kept> kept_by_bolts(const Json& record) {
  std::vector<Kept> kept;
  for (const Json& bolt : record.value("bolts", Json::array())) {
    const double loss = number(bolt, "loss");
    if (std::isfinite(loss))
      kept.push_back({text(bolt, "name"), 1.0 - loss, number(bolt, "lowest") / number(bolt, "tightened")});
  }
  std::stable_sort(kept.begin(), kept.end(), [](const Kept& a, const Kept& b) { return a.at_end < b.at_end; });
  return kept;
}

Finding of_bolts(const Json& record, bool has_motion) {
  const std::vector<Kept> kept = kept_by_bolts(record);
  if (kept.empty()) return {};
  const Kept& least = kept.front();
  const auto n_loose = static_cast<size_t>(
      std::count_if(kept.begin(), kept.end(), [](const Kept& bolt) { return bolt.at_end < limit::good_preload_kept; }));
  Finding finding;
  if (kept.size() == 1)
    finding.sentence = fmt::format("Bolt '{}' keeps {} of its preload", least.name, whole_percent(least.at_end));
  else if (n_loose == 0)
    finding.sentence =
        fmt::format("All {} bolts keep {} or more of their preload", kept.size(), whole_percent(least.at_end));
  else {
    finding.sentence = fmt::format("{} of {} bolts keep {} or more of their preload", kept.size() - n_loose,
                                   kept.size(), whole_percent(limit::good_preload_kept));
    for (size_t i = 0; i < std::min(n_loose, most_named); ++i)
      finding.sentence += fmt::format(", '{}' {}", kept[i].name, whole_percent(kept[i].at_end));
    finding.sentence += further(n_loose, most_named, " less");
  }
  Card card{"preload kept" + (kept.size() > 1 ? fmt::format(", least of {} bolts", kept.size()) : ""),
            whole_percent(least.at_end), "'" + least.name + "'"};
  const Kept& slackest =
      *std::min_element(kept.begin(), kept.end(), [](const Kept& a, const Kept& b) { return a.lowest < b.lowest; });
  if (has_motion && std::isfinite(slackest.lowest)) {
    const std::string low = whole_percent(slackest.lowest);
    finding.sentence += slackest.lowest > 0.0 ? ", at the lowest " + low + " in the motion"
                                              : "; '" + slackest.name + "' goes slack in the motion";
    card.note +=
        ", at the lowest " + low + " in the motion" + (slackest.name == least.name ? "" : " ('" + slackest.name + "')");
  }
  finding.sentence += ".";
  card.grade = least.at_end >= limit::good_preload_kept ? Grade::fine : Grade::fair;
  if (least.at_end < limit::preload_kept || (has_motion && slackest.lowest <= 0.0)) card.grade = Grade::poor;
  finding.cards = {card};
  return finding;
}

template <class Which>
std::vector<std::string> names_where(const std::vector<Contact>& contacts, Which&& which) {
  std::vector<std::string> names;
  for (const Contact& contact : contacts)
    if (which(contact)) names.push_back(contact.name);
  return names;
}

// Of what does not slide, the nearest to it.
std::string most_friction_used(const std::vector<Contact>& contacts) {
  const Contact* nearest = nullptr;
  for (const Contact& c : contacts)
    if (!c.slides() && std::isfinite(c.friction_used) && (!nearest || c.friction_used > nearest->friction_used))
      nearest = &c;
  return nearest ? fmt::format("at most {:.0f}\u00a0% of the friction is used, in '{}'", 100.0 * nearest->friction_used,
                               nearest->name)
                 : "";
}

Finding of_contacts(const Json& record) {
  std::vector<Contact> contacts = contacts_of(record);
  std::erase_if(contacts, [](const Contact& c) { return !(c.highest > 0.0); });  // what never touches
  if (contacts.empty()) return {};
  const auto sliding = names_where(contacts, [](const Contact& c) { return c.slides(); });
  const auto parted = names_where(contacts, [](const Contact& c) { return c.parts(); });
  Finding finding;
  const auto n_free = static_cast<size_t>(
      std::count_if(contacts.begin(), contacts.end(), [](const Contact& c) { return c.friction == 0.0; }));
  const size_t n_rough = contacts.size() - n_free;
  const std::string free =
      n_free == 0 ? "" : fmt::format("{} without friction slide{} freely", n_free, n_free == 1 ? "s" : "");
  Card card{"contacts that slide as a whole",
            n_rough > 0 ? fmt::format("{} of {}", sliding.size(), n_rough) : "no friction", ""};
  double slip = 0.0;
  for (const Contact& c : contacts)
    if (c.slides()) slip = std::fmax(slip, c.slip);
  const std::string used = most_friction_used(contacts);
  if (!sliding.empty()) {
    finding.sentence = fmt::format("{} of {} contacts slide{} as a whole, by up to {}: {}", sliding.size(), n_rough,
                                   sliding.size() == 1 ? "s" : "", with_unit(slip, "m"), list_of_names(sliding));
    card.note = "by up to " + with_unit(slip, "m");
  } else if (n_rough > 0) {
    finding.sentence = "No contact slides as a whole" + (used.empty() ? "" : " (" + used + ")");
    card.note = used;
  }
  if (n_free > 0) {
    finding.sentence += n_rough > 0   ? "; " + free
                        : n_free == 1 ? "The contact has no friction"
                                      : "No contact has friction";
    if (n_rough > 0) card.note += (card.note.empty() ? "" : "; ") + free;
  }
  if (!parted.empty()) {
    finding.sentence += fmt::format("; {} of them part{} for some time: {}", parted.size(),
                                    parted.size() == 1 ? "s" : "", list_of_names(parted));
    card.note += fmt::format("{}{} part{} for some time", card.note.empty() ? "" : "; ", parted.size(),
                             parted.size() == 1 ? "s" : "");
  }
  finding.sentence += ".";
  card.grade = sliding.empty() && parted.empty() ? Grade::fine : Grade::fair;
  finding.cards = {card};
  return finding;
}

Finding of_yield(const Json& record) {
  const Json* least = nullptr;
  const Json parts = record.value("substructures", Json::array());
  const auto margin = [](const Json& part) { return number(part.at("stress"), "margin"); };
  std::vector<std::string> beyond;
  for (const Json& part : parts) {
    if (!part.contains("stress") || !part["stress"].contains("von_mises")) continue;
    if (number(part["stress"], "von_mises") == 0.0) continue;
    if (!least || !(margin(part) >= margin(*least))) least = &part;
    if (!(margin(part) >= limit::yield_margin)) beyond.push_back(text(part, "name"));
  }
  if (!least) return {};
  const double value = margin(*least);
  const std::string percent = std::isfinite(value) ? plain_number(100.0 * value, 3) + "\u00a0%" : "not a number";
  Finding finding;
  finding.cards = {{"smallest margin against yield", percent,
                    "in '" + text(*least, "name") + "', yield / von Mises − 1",
                    value >= limit::yield_margin ? Grade::fine : Grade::poor}};
  if (beyond.empty())
    finding.sentence =
        fmt::format("No part reaches its yield: the smallest margin is {}, in '{}'.", percent, text(*least, "name"));
  else
    finding.sentence = fmt::format("The stress reaches the yield in {}: the smallest margin is {}, in '{}'.",
                                   list_of_names(beyond), percent, text(*least, "name"));
  return finding;
}

Finding of_failure(const Json& record) {
  const Json parts = record.value("substructures", Json::array());
  const Json* worst = nullptr;
  std::vector<std::string> beyond;
  const auto index = [](const Json& part) { return number(part.at("stress"), "failure_index"); };
  for (const Json& part : parts) {
    if (!part.contains("stress") || !part["stress"].contains("failure_index")) continue;
    if (!worst || !(index(part) <= index(*worst))) worst = &part;
    if (!(index(part) <= 1.0)) beyond.push_back(text(part, "name"));
  }
  if (!worst) return {};
  const std::string value = std::isfinite(index(*worst)) ? plain_number(index(*worst), 3) : "not a number";
  Finding finding;
  finding.cards = {{"largest failure index", value, "in '" + text(*worst, "name") + "', 1 at failure",
                    beyond.empty() ? Grade::fine : Grade::poor}};
  finding.sentence = beyond.empty() ? fmt::format("No composite fails: the largest failure index is {}, in '{}'.",
                                                  value, text(*worst, "name"))
                                    : fmt::format("The failure index passes 1 in {}: the largest is {}, in '{}'.",
                                                  list_of_names(beyond), value, text(*worst, "name"));
  return finding;
}

}  // namespace

std::vector<Finding> findings_of(const RunFolder& run, const ReportRequest& request) {
  const Json& record = run.record();
  const Json& steps = record.at("steps");
  const bool has_motion =
      std::any_of(steps.begin(), steps.end(), [](const Json& step) { return text(step, "kind") == "dynamic"; });
  return {of_spectra(run, request), of_bolts(record, has_motion), of_contacts(record), of_yield(record),
          of_failure(record)};
}

}  // namespace dygita
