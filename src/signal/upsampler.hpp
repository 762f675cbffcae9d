// Band-limited interpolation of a sampled signal.
#pragma once

#include <cstddef>
#include <vector>

namespace dygita {

// Puts `factor` - 1 samples between each two of a signal: windowed sinc, 32 samples to each side, Kaiser window of 90
// dB (Oppenheim and Schafer, Discrete-Time Signal Processing). Within 0.001 dB up to 0.44 of the sampling rate;
// the samples themselves are kept. Beyond its ends the signal is continued by its point reflection about the end
// sample, which keeps value and slope, so that a record may start and end anywhere.
class Upsampler {
 public:
  // factor >= 1, signal not empty (else ContractError).
  Upsampler(const std::vector<double>& signal, int factor);

  int factor() const { return factor_; }
  size_t n_intervals() const { return n_intervals_; }  // between the samples given: their number - 1

  // Samples of the intervals [from, to): (to - from) x factor values into `out`, the first at sample `from`.
  void intervals(size_t from, size_t to, std::vector<double>& out) const;

 private:
  int factor_;
  size_t n_intervals_;
  std::vector<double> extended_;  // the signal with half a kernel on each side
  std::vector<double> kernel_;    // factor x width, row after row
};

}  // namespace dygita
