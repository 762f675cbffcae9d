// Spectra of a run, and how each stands against its specification.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drawing/svg_plot.hpp"
#include "files/run_folder.hpp"
#include "report/card.hpp"
#include "report/report.hpp"

namespace dygita {

// A spectrum with what it is held against.
struct Spectrum {
  std::string name, of, quantity;
  double q_factor;
  Table table;
  std::shared_ptr<const Specification> specification;
  double margin = 0.0;  // dB, to be kept below the specification
  Table band;           // dB, what iteration, time step, mesh and the end of the record leave; empty: not known
  std::string judged = "maximax";  // the column that is held against the specification

  const std::vector<double>& frequency() const { return table.columns.front(); }
  const std::vector<double>& level() const { return table.column(judged); }
};

// Those of the record whose tables are there. Throws InputError where the request names a spectrum that is none of
// them.
std::vector<Spectrum> spectra_of(const RunFolder& run, const ReportRequest& request);

// "+7.1 dB", with a true minus.
std::string decibels(double value);

// A range of frequencies that lies outside, with the worst of it.
struct Excursion {
  double from, to;  // Hz
  double worst;     // dB from the specification
  double at;        // Hz
};

// Where the spectrum, at the frequencies judged, is above (sign 1) or below (sign -1) its specification by more than
// `limit` dB; the worst first.
std::vector<Excursion> excursions(const Spectrum& spectrum, const FrequencyRange& judged, double limit, int sign);

// Shades what the record does not allow to judge in a plot over frequencies that has its limits, and says so: what
// follows in its caption.
std::string shade_unreliable(const FrequencyRange& judged, Plot& plot);

struct SpectrumVerdict {
  std::string sentence;
  Card card;
  std::optional<Excursion> worst = {};  // or nearest, where nothing is above; none: not judged
  double uncertain = 0.0;               // dB, there
  double margin = 0.0;                  // dB, asked

  bool is_above() const;  // its specification
  bool is_margin_kept() const;
};

// Of a spectrum with a specification, at the frequencies that the record allows.
SpectrumVerdict verdict_of(const Spectrum& spectrum, const FrequencyRange& judged);

}  // namespace dygita
