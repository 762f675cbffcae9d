// What every kind of history answers: for the files of signal that make them.
#pragma once

#include "signal/history.hpp"

namespace dygita {

struct History::Shape {
  struct Extent {
    double n_terms = 1.0;
    int depth = 1;
  };
  virtual ~Shape() = default;
  virtual double value(double t) const = 0;
  virtual double integral(double t0, double t1) const = 0;
  virtual bool is_constant() const { return false; }
  virtual std::string description() const = 0;
  virtual std::optional<Profile> profile() const { return std::nullopt; }
  virtual std::string unit() const { return ""; }
  virtual std::optional<double> factor_without_unit() const { return std::nullopt; }
  // How much a value costs: shapes that it asks, and how deep they lie in each other.
  virtual Extent extent() const { return {}; }
  // Adds the profiles of the terms of a sum; false where one has none.
  virtual bool add_terms(std::vector<Profile>& terms) const {
    const std::optional<Profile> own = profile();
    if (own) terms.push_back(*own);
    return own.has_value();
  }
};

}  // namespace dygita
