#include "result/result.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/names.hpp"

namespace dygita {

const std::vector<double>& Table::column(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  CHECK(found != names.end(), "no column '" + name + "': " + did_you_mean(name, names));
  return columns.at(static_cast<size_t>(found - names.begin()));
}

}  // namespace dygita
