#include "signal/srs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "base/error.hpp"
#include "base/log.hpp"
#include "signal/frequency_range.hpp"
#include "signal/oscillator.hpp"
#include "signal/upsampler.hpp"

namespace dygita {

namespace {

constexpr double samples_per_period = 40.0;
constexpr int least_factor =
    8;  // content above the natural frequency needs its samples too: 16 a period at the Nyquist frequency
constexpr int largest_factor = 64;       // far above the Nyquist frequency the response is the signal itself
constexpr double largest_record = 40.0;  // dB

void check_samples(const EvenStretch& stretch) {
  if (stretch.values.empty()) throw InputError("srs: the signal is empty");
  const auto odd =
      std::find_if(stretch.values.begin(), stretch.values.end(), [](double value) { return !std::isfinite(value); });
  if (odd != stretch.values.end())
    throw InputError(fmt::format("srs: sample {} of the signal is {}", odd - stretch.values.begin() + 1, *odd));
  if (!(stretch.dt > 0.0) || !std::isfinite(stretch.dt))
    throw InputError(fmt::format("srs: sampling interval {} s must be above 0", stretch.dt));
}

void check(const std::vector<EvenStretch>& signal, const SrsSettings& settings) {
  if (signal.empty()) throw InputError("srs: the signal is empty");
  for (const EvenStretch& stretch : signal) check_samples(stretch);
  for (size_t i = 1; i < signal.size(); ++i)
    if (!(signal[i].start > signal[i - 1].end()))
      throw InputError(
          fmt::format("srs: samples from {} s on come after one at {} s", signal[i].start, signal[i - 1].end()));
  if (!(settings.from > 0.0)) throw InputError(fmt::format("srs: 'from' = {} Hz must be above 0", settings.from));
  if (!(settings.from < settings.to) || !std::isfinite(settings.to))
    throw InputError(fmt::format("srs: 'from' = {} Hz must be below 'to' = {} Hz", settings.from, settings.to));
  if (settings.per_octave < 1)
    throw InputError(fmt::format("srs: 'per_octave' = {} must be 1 or more", settings.per_octave));
  if (!(settings.taper >= 0.0))
    throw InputError(fmt::format("srs: 'taper' = {} s must not be negative", settings.taper));
  if (!(settings.q_factor > 0.5))
    throw InputError(
        fmt::format("srs: 'q_factor' = {} must be above 0.5 (0.5 is critical damping)", settings.q_factor));
}

// From the first sample to one interval after the last.
double length_of(const std::vector<EvenStretch>& signal) {
  return signal.back().end() - signal.front().start + signal.back().dt;
}

void warn_of_limits(const std::vector<EvenStretch>& signal, const SrsSettings& settings) {
  const double duration = length_of(signal);
  double dt = signal.front().dt;
  for (const EvenStretch& stretch : signal) dt = std::min(dt, stretch.dt);
  const FrequencyRange reliable = reliable_range(duration, dt);
  if (settings.from < reliable.from)
    warn(fmt::format("srs: the spectrum is unreliable below {:.4g} Hz, 1/record length ({:.4g} s)", reliable.from,
                     duration));
  if (settings.to > reliable.to)
    warn(fmt::format(
        "srs: above {:.4g} Hz, half the sampling rate, the record has no content: the spectrum is its peak there",
        reliable.to));
}

std::vector<double> natural_frequencies(const SrsSettings& settings) {
  constexpr double same = 1.0 - 1e-9;
  std::vector<double> frequencies;
  for (int i = 0;; ++i) {
    const double frequency = settings.from * std::exp2(static_cast<double>(i) / settings.per_octave);
    if (frequency >= same * settings.to) break;
    frequencies.push_back(frequency);
  }
  frequencies.push_back(settings.to);
  return frequencies;
}

// A power of two, so that frequencies share few upsampled signals.
int upsampling_factor(double frequency, double dt) {
  int factor = least_factor;
  while (factor < largest_factor && factor < samples_per_period * frequency * dt) factor *= 2;
  return factor;
}

std::vector<int> factors_of(const std::vector<EvenStretch>& signal, double frequency) {
  std::vector<int> factors;
  for (const EvenStretch& stretch : signal) factors.push_back(upsampling_factor(frequency, stretch.dt));
  return factors;
}

double rise(double level, double of) {
  if (!(level > of)) return 0.0;
  return of > 0.0 ? std::min(20.0 * std::log10(level / of), largest_record) : largest_record;
}

// The spectrum at one frequency as it would be if the record ended at this instant and that one of its last quarter.
class CutShort {
 public:
  void note(double maximax, double primary) {
    if (n_++ == 0) first_ = lowest_ = maximax, first_primary_ = primary;
    highest_ = std::max(highest_, maximax);
    lowest_ = std::min(lowest_, maximax);
    fall_ = std::max(fall_, highest_ - maximax);
  }

  void add_to(Srs::Ending& ending, double maximax, double primary) const {
    constexpr double much = 1.0, ripple = 0.1;  // dB; of the growth
    const bool is_known = n_ > 0;
    ending.maximax.push_back(is_known ? std::max(rise(highest_, maximax), rise(maximax, lowest_)) : 0.0);
    ending.primary.push_back(is_known ? rise(primary, first_primary_) : 0.0);
    const double fall = std::max(fall_, highest_ - maximax);
    ending.grows.push_back(is_known && rise(maximax, first_) > much && fall <= ripple * (maximax - first_));
  }

 private:
  int n_ = 0;
  double first_ = 0.0, lowest_ = 0.0, highest_ = 0.0, fall_ = 0.0, first_primary_ = 0.0;
};

// When the last quarter of a record begins, from where it first moves on: a rest before a shock is no part of it.
double last_quarter(const std::vector<EvenStretch>& signal) {
  constexpr double rest = 1e-3;  // of the largest value
  double largest = 0.0;
  for (const EvenStretch& stretch : signal)
    for (const double value : stretch.values) largest = std::max(largest, std::abs(value));
  const double end = signal.back().end();
  for (const EvenStretch& stretch : signal)
    for (size_t i = 0; i < stretch.values.size(); ++i)
      if (std::abs(stretch.values[i]) > rest * largest) return end - 0.25 * (end - stretch.time(i));
  return end;
}

// Where in its last quarter a record is cut short.
struct Cuts {
  static constexpr int n = 32;
  double from, every;  // s

  explicit Cuts(const std::vector<EvenStretch>& signal)
      : from(last_quarter(signal)), every((signal.back().end() - from) / n) {}

  bool are_on(double time) const { return time >= from; }
  // The sample of a stretch after number i at which the next is due.
  size_t next(const EvenStretch& stretch, size_t i) const {
    const double wait = are_on(stretch.time(i)) ? every : from - stretch.time(i);
    return i + static_cast<size_t>(std::clamp(wait / stretch.dt, 1.0, 1e9));
  }
};

// Oscillators that need the same upsampling, run together.
class Group {
 public:
  Group(const std::vector<double>& frequencies, const std::vector<EvenStretch>& signal, const SrsSettings& settings)
      : frequencies_(frequencies), signal_(signal), factors_(factors_of(signal, frequencies.front())) {
    if (settings.watches_end) cuts_.emplace(signal);
    const EvenStretch& first = signal.front();
    for (const double frequency : frequencies)
      oscillators_.emplace_back(frequency, settings.q_factor, first.dt / factors_.front(), first.values.front(),
                                settings.quantity);
    cut_short_.resize(frequencies.size());
  }

  void run() {
    for (size_t i = 0; i < signal_.size(); ++i) {
      if (i > 0) reach(signal_[i - 1], signal_[i], factors_[i]);
      run_through(signal_[i], factors_[i]);
    }
  }

  void append_to(Srs& srs) const {
    for (size_t i = 0; i < frequencies_.size(); ++i) {
      const ResponsePeaks during = oscillators_[i].during(), after = oscillators_[i].after();
      if (!std::isfinite(oscillators_[i].response()) || !std::isfinite(during.maximax() + after.maximax()))
        throw InputError("srs: the signal has values that overflow");
      srs.frequency.push_back(frequencies_[i]);
      srs.positive.push_back(std::max(during.highest, after.highest));
      srs.negative.push_back(-std::min(during.lowest, after.lowest) + 0.0);  // + 0: no "-0"
      srs.maximax.push_back(std::max(during.maximax(), after.maximax()));
      srs.primary.push_back(during.maximax());
      srs.residual.push_back(after.maximax());
      if (cuts_) cut_short_[i].add_to(srs.ending, srs.maximax.back(), srs.primary.back());
    }
  }

 private:
  void reach(const EvenStretch& before, const EvenStretch& stretch, int factor) {
    for (Oscillator& oscillator : oscillators_) {
      oscillator.follow_line(stretch.values.front(), stretch.start - before.end());
      oscillator.sample_every(stretch.dt / factor);
    }
  }

  void run_through(const EvenStretch& stretch, int factor) {
    constexpr size_t chunk_length = 4096;
    const Upsampler upsampler(stretch.values, factor);
    const size_t n = upsampler.n_intervals(), longest = std::max<size_t>(1, chunk_length / static_cast<size_t>(factor));
    std::vector<double> chunk;
    for (size_t from = 0, to = 0; from < n; from = to) {
      to = std::min(from + longest, n);
      if (cuts_) to = std::min(to, cuts_->next(stretch, from));
      upsampler.intervals(from, to, chunk);
      if (from == 0) chunk.erase(chunk.begin());  // the oscillators start from the first sample
      for (Oscillator& oscillator : oscillators_) oscillator.advance(chunk);
      if (cuts_ && cuts_->are_on(stretch.time(to))) cut();
    }
    if (n == 0) return;
    for (Oscillator& oscillator : oscillators_) oscillator.advance({stretch.values.back()});
  }

  void cut() {
    for (size_t i = 0; i < oscillators_.size(); ++i) {
      const double primary = oscillators_[i].during().maximax();
      cut_short_[i].note(std::max(primary, oscillators_[i].after().maximax()), primary);
    }
  }

  std::vector<double> frequencies_;
  const std::vector<EvenStretch>& signal_;
  std::vector<int> factors_;
  std::optional<Cuts> cuts_;
  std::vector<Oscillator> oscillators_;
  std::vector<CutShort> cut_short_;
};

Srs spectrum_of(const std::vector<EvenStretch>& signal, const SrsSettings& settings) {
  const std::vector<double> all = natural_frequencies(settings);
  Srs srs;
  for (auto first = all.begin(); first != all.end();) {
    const std::vector<int> factors = factors_of(signal, *first);
    const auto end = std::find_if(first, all.end(), [&](double f) { return factors_of(signal, f) != factors; });
    Group group({first, end}, signal, settings);
    group.run();
    group.append_to(srs);
    first = end;
  }
  return srs;
}

// The record up to an instant (s), its last `taper` (s) taken to zero.
std::vector<EvenStretch> tapered(std::vector<EvenStretch> signal, double end, double taper) {
  std::erase_if(signal, [&](const EvenStretch& stretch) { return stretch.start > end; });
  for (EvenStretch& stretch : signal) {
    if (stretch.end() > end)
      stretch.values.resize(static_cast<size_t>((end - stretch.start) / stretch.dt * (1.0 + 1e-12)) + 1);
    for (size_t i = 0; i < stretch.values.size(); ++i)
      if (const double after = (stretch.time(i) - (end - taper)) / taper; after > 0.0)
        stretch.values[i] *= 0.5 * (1.0 + std::cos(std::numbers::pi * std::min(after, 1.0)));
  }
  return signal;
}

// Each cut is tapered as the record itself is: a spectrum of its own.
Srs tapered_spectrum(const std::vector<EvenStretch>& signal, SrsSettings settings) {
  constexpr int n_cuts = 8;
  const bool watches_end = settings.watches_end;
  settings.watches_end = false;
  const double end = signal.back().end(), length = end - signal.front().start;
  if (!(length > 0.0)) return spectrum_of(signal, settings);
  const double quarter = last_quarter(signal);
  settings.taper = std::min(settings.taper, length);
  Srs srs = spectrum_of(tapered(signal, end, settings.taper), settings);
  if (!watches_end) return srs;
  std::vector<CutShort> cut_short(srs.frequency.size());
  for (int k = 0; k < n_cuts; ++k) {
    const double cut = std::max(end - (end - quarter) * (n_cuts - k) / n_cuts, signal.front().start + settings.taper);
    const Srs shorter = spectrum_of(tapered(signal, cut, settings.taper), settings);
    for (size_t i = 0; i < cut_short.size(); ++i) cut_short[i].note(shorter.maximax[i], shorter.primary[i]);
  }
  for (size_t i = 0; i < cut_short.size(); ++i) cut_short[i].add_to(srs.ending, srs.maximax[i], srs.primary[i]);
  return srs;
}

}  // namespace

std::string srs_unit(SrsQuantity quantity, const std::string& unit) {
  if (quantity == SrsQuantity::absolute_acceleration || unit.empty()) return unit;
  const bool is_velocity = quantity == SrsQuantity::pseudo_velocity;
  if (unit == "m/s^2") return is_velocity ? "m/s" : "m";
  return unit + (is_velocity ? " s" : " s^2");
}

double q_factor_of(double damping) { return damping > 0.0 ? 0.5 / damping : std::numeric_limits<double>::infinity(); }

Srs shock_response_spectrum(const std::vector<EvenStretch>& signal, const SrsSettings& settings) {
  check(signal, settings);
  warn_of_limits(signal, settings);
  return settings.taper > 0.0 ? tapered_spectrum(signal, settings) : spectrum_of(signal, settings);
}

Srs shock_response_spectrum(const std::vector<double>& signal, double dt, const SrsSettings& settings) {
  return shock_response_spectrum({EvenStretch{0.0, dt, signal}}, settings);
}

}  // namespace dygita
