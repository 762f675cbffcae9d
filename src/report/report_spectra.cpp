// Charts of spectra, one for each place, with the specification that each is held against.
#include <algorithm>
#include <cmath>
#include <map>

#include "base/log.hpp"
#include "base/name_list.hpp"
#include "drawing/svg_text.hpp"
#include "drawing/units.hpp"
#include "report/html.hpp"
#include "report/report_parts.hpp"
#include "report/spectra.hpp"
#include "result/limits.hpp"

namespace dygita {

namespace {

constexpr double decades_shown = 4.0;  // 80 dB below the peak

std::vector<double> scaled(const std::vector<double>& values, double factor) {
  std::vector<double> result = values;
  for (double& value : result) value *= factor;
  return result;
}

void add_bands(const Specification& s, Plot& plot) {
  for (const double band : {6.0, 3.0}) {
    const double factor = std::pow(10.0, band / 20.0);
    plot.bands.push_back({fmt::format("±{:.0f} dB", band), s.frequency, scaled(s.level, 1.0 / factor),
                          scaled(s.level, factor), "#555555", 0.16});
  }
}

// The specification and, thinner, what its margin leaves.
void add_specification(const Spectrum& s, const std::string& name, const std::string& color, Plot& plot) {
  const Specification& of = *s.specification;
  plot.lines.push_back({name, of.frequency, of.level, color, true, false, 1.8});
  if (s.margin > 0.0)
    plot.lines.push_back({fmt::format("{} − {:g} dB", name, s.margin), of.frequency,
                          scaled(of.level, std::pow(10.0, -s.margin / 20.0)), color, true, false, 0.9});
}

constexpr size_t most_shaded = 3;  // spectra in one figure

bool add_uncertainty(const Spectrum& s, int i_line, Plot& plot) {
  if (s.band.n_rows() != s.table.n_rows()) return false;
  PlotBand band{"", s.frequency(), s.level(), s.level(), series_color(i_line), 0.18};
  for (size_t i = 0; i < band.low.size(); ++i) {
    const double factor = std::pow(10.0, s.band.column("all")[i] / 20.0);
    band.low[i] /= factor;
    band.high[i] *= factor;
  }
  plot.bands.push_back(std::move(band));
  return true;
}

// A ring at each range above the specification; at the nearest place where there is none.
void mark_worst(const Spectrum& s, const FrequencyRange& judged, Plot& plot) {
  constexpr size_t most_marks = 3;
  std::vector<Excursion> marked = excursions(s, judged, limit::specification, 1);
  if (marked.size() > most_marks) marked.resize(most_marks);
  if (marked.empty())
    if (const Exceedance worst = largest_exceedance(*s.specification, s.frequency(), s.level(), judged); worst.is_known)
      marked.push_back({worst.frequency, worst.frequency, worst.decibels, worst.frequency});
  for (const Excursion& range : marked) {
    const auto at = std::find(s.frequency().begin(), s.frequency().end(), range.at) - s.frequency().begin();
    plot.marks.push_back({range.at, s.level()[static_cast<size_t>(at)], decibels(range.worst)});
  }
}

// Spectra of one quantity at one place, along several directions.
struct Group {
  std::string place;
  std::vector<Spectrum> spectra;
};

// Where the history of a spectrum is taken; its name where the record does not tell.
std::string place_of(const RunFolder& run, const Spectrum& spectrum) {
  for (const Json& output : run.record().value("outputs", Json::array()))
    if (text(output, "name") == spectrum.of) {
      std::string places;
      for (const Json& place : output.value("on", Json::array()))
        if (place.is_string()) places += (places.empty() ? "" : ", ") + place.get<std::string>();
      if (!places.empty()) return places;
    }
  return spectrum.of;
}

double peak_of(const Spectrum& s) {
  double peak = 0.0;
  for (const double level : s.level())
    if (std::isfinite(level)) peak = std::max(peak, level);
  return peak;
}

// What the names of a group begin with, up to a space, a dot, a dash or a line: "srs unit " of "srs unit axial".
std::string common_start(const std::vector<Spectrum>& spectra) {
  std::string start = spectra.front().name;
  for (const Spectrum& s : spectra) {
    size_t n = 0;
    while (n < std::min(start.size(), s.name.size()) && start[n] == s.name[n]) ++n;
    start.resize(n);
  }
  const size_t end = start.find_last_of(" ._-:");
  return spectra.size() < 2 || end == std::string::npos ? "" : start.substr(0, end + 1);
}

// The least that is drawn of a spectrum, with what is shaded.
double lowest_of(const Spectrum& s) {
  double low = 1e300;
  for (size_t i = 0; i < s.level().size(); ++i) {
    const bool has_band = s.band.n_rows() == s.table.n_rows();
    const double level = s.level()[i] / (has_band ? std::pow(10.0, s.band.column("all")[i] / 20.0) : 1.0);
    if (level > 0.0) low = std::min(low, level);
  }
  return low;
}

// The axis by what matters: from the peak to 80 dB below, the specification in sight.
void set_axes(const Group& group, Plot& plot) {
  plot.x.from = group.spectra.front().frequency().front();
  plot.x.to = group.spectra.front().frequency().back();
  double peak = 0.0, low = 1e300, specified = 1e300;
  for (const Spectrum& s : group.spectra) {
    plot.x.from = std::min(*plot.x.from, s.frequency().front());
    plot.x.to = std::max(*plot.x.to, s.frequency().back());
    peak = std::max(peak, peak_of(s));
    low = std::min(low, lowest_of(s));
    if (!s.specification) continue;
    for (const double level : s.specification->level) {
      peak = std::max(peak, level);
      if (level > 0.0) specified = std::min(specified, level);
    }
  }
  const double deepest = peak * std::pow(10.0, -decades_shown);
  if (peak > 0.0 && std::min(low, specified) < deepest) plot.y.from = std::min(deepest, 0.5 * specified);
}

void add_lines(const Group& group, Plot& plot) {
  const std::string start = common_start(group.spectra);
  for (const Spectrum& s : group.spectra)
    plot.lines.push_back({s.name.substr(start.size()) +
                              (std::isfinite(s.q_factor) ? fmt::format(" (Q {:g})", s.q_factor) : " (undamped)") +
                              (s.judged == "maximax" ? "" : ", " + s.judged),
                          s.frequency(), s.level()});
  if (group.spectra.size() == 1)
    for (const char* side : {"positive", "negative"})
      plot.lines.push_back(
          {side, group.spectra[0].frequency(), group.spectra[0].table.column(side), {}, true, false, 1.0});
}

bool are_alike(const Spectrum& a, const Spectrum& b) {
  return a.margin == b.margin && a.specification->frequency == b.specification->frequency &&
         a.specification->level == b.specification->level;
}

// Each once: one with its bands, several in the colours of their spectra.
void add_specifications(const Group& group, Plot& plot) {
  const std::string start = common_start(group.spectra);
  std::vector<size_t> drawn;
  for (size_t i = 0; i < group.spectra.size(); ++i) {
    const bool is_new = group.spectra[i].specification && std::none_of(drawn.begin(), drawn.end(), [&](size_t d) {
                          return are_alike(group.spectra[d], group.spectra[i]);
                        });
    if (is_new) drawn.push_back(i);
  }
  for (const size_t i : drawn) {
    const Spectrum& s = group.spectra[i];
    if (drawn.size() == 1) add_bands(*s.specification, plot);
    if (drawn.size() == 1)
      add_specification(s, "specification", "#000000", plot);
    else
      add_specification(s, "specification " + s.name.substr(start.size()), series_color(static_cast<int>(i)), plot);
  }
}

std::string group_figure(const RunFolder& run, const Group& group, const TimeAxis& time, bool is_alone) {
  const Spectrum& first = group.spectra.front();
  const std::string start = common_start(group.spectra),
                    name = start.empty() ? first.name : start.substr(0, start.find_last_not_of(" ._-:") + 1);
  Plot plot{.title = "Shock response spectra of " + first.quantity + ", " + name,
            .x = {"frequency", "Hz", true},
            .y = {"maximax " + first.quantity, first.table.units.at(1), true}};
  plot.width = is_alone ? 820 : 530;
  plot.height = is_alone ? 400 : 340;
  add_lines(group, plot);
  bool has_uncertainty = false;
  if (group.spectra.size() <= most_shaded)
    for (size_t i = 0; i < group.spectra.size(); ++i)
      has_uncertainty |= add_uncertainty(group.spectra[i], static_cast<int>(i), plot);
  set_axes(group, plot);
  add_specifications(group, plot);
  for (const Spectrum& s : group.spectra)
    if (s.specification) mark_worst(s, time.judged(), plot);
  std::string caption = (start.empty() ? "'" + first.name + "'" : "'" + name + "'") + " on " + group.place +
                        ": maximax response of oscillators to the acceleration of the dynamic steps";
  if (time.record() > 0.0) caption += shade_unreliable(time.judged(), plot);
  if (has_uncertainty)
    caption +=
        "; shaded: uncertainty from iteration, time step and mesh, and from where the record ends, by the run's own "
        "estimate";
  return doubted_figure(run, svg(plot), caption + ".");
}

// Of one quantity, by place in the order of the record; `still` takes what carries rounding alone.
std::vector<Group> groups_of(const RunFolder& run, std::vector<Spectrum> spectra, std::vector<std::string>& still) {
  double largest = 0.0;
  for (const Spectrum& s : spectra) largest = std::max(largest, peak_of(s));
  std::vector<Group> groups;
  for (Spectrum& s : spectra) {
    if (largest > 0.0 && is_rounding(peak_of(s), largest)) {
      still.push_back(s.name);
      continue;
    }
    const std::string place = place_of(run, s);
    auto of = std::find_if(groups.begin(), groups.end(), [&](const Group& group) { return group.place == place; });
    if (of == groups.end()) of = groups.insert(of, Group{place, {}});
    of->spectra.push_back(std::move(s));
  }
  return groups;
}

}  // namespace

std::string spectra_section(const RunFolder& run, const TimeAxis& time, const ReportRequest& request) {
  std::map<std::string, std::vector<Spectrum>> of_quantity;
  std::string verdicts;
  for (Spectrum& spectrum : spectra_of(run, request)) {
    if (spectrum.specification)
      verdicts += html::paragraph(
          verdict_of(spectrum, time.judged()).sentence +
          (spectrum.specification->source.empty() ? "" : " Specification: " + spectrum.specification->source + "."));
    of_quantity[spectrum.quantity].push_back(std::move(spectrum));
  }
  std::vector<std::string> figures, still;
  std::vector<Group> groups;
  for (auto& [quantity, spectra] : of_quantity)
    for (Group& group : groups_of(run, std::move(spectra), still)) groups.push_back(std::move(group));
  for (const Group& group : groups) figures.push_back(group_figure(run, group, time, groups.size() == 1));
  std::string body = groups.size() == 1 ? figures.front() : html::row(figures);
  if (!still.empty())
    body += html::paragraph(fmt::format("Not drawn, since {} nothing but rounding beside the largest of the run: {}.",
                                        still.size() == 1 ? "it carries" : "they carry", list_of_names(still)));
  return doubted_section(run, "Shock response spectra", body + verdicts);
}

}  // namespace dygita
