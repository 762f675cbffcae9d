// What every kind of history answers: for the files of signal that make them.
#pragma once

#include "signal/history.hpp"

namespace dygita {

struct History::Shape {
  virtual ~Shape() = default;
  virtual double value(double t) const = 0;
  virtual double integral(double t0, double t1) const = 0;
  virtual bool is_constant() const { return false; }
  virtual std::string description() const = 0;
  virtual std::optional<Profile> profile() const { return std::nullopt; }
  virtual std::string unit() const { return ""; }
  virtual std::optional<double> factor_without_unit() const { return std::nullopt; }
};

}  // namespace dygita
