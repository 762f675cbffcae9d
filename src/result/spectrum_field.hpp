// Shock response spectra at every node of faces.
#pragma once

#include "result/frame.hpp"
#include "result/result.hpp"
#include "solution/observer.hpp"

namespace dygita {

// Accelerations of every node of faces through the dynamic steps, and their spectra at the end.
class SpectrumField {
 public:
  SpectrumField(const Problem& problem, const Output& output);
  void accept(const Instant& instant);

  // A frame a frequency, label_time in Hz: fields maximax, positive, negative, primary, residual on the faces.
  std::vector<Frame> frames() const;
  // Columns frequency (Hz), highest and mean maximax over the nodes, from those frames.
  Table table(const std::vector<Frame>& frames) const;

 private:
  struct Area {
    int part;
    InterfaceFrame faces;  // points and facets
    std::vector<int> nodes;
  };
  std::vector<Mat> spectra(const Area& area, size_t first, std::vector<double>& frequency) const;

  const Problem& problem_;
  const Output& output_;
  std::vector<Area> areas_;
  std::vector<double> time_;                 // s, middle of each increment
  std::vector<std::vector<float>> signals_;  // of each instant: nodes of all areas x directions, m/s^2
  double dt_ = 0.0;                          // s, smallest
};

}  // namespace dygita
