#include "deck/register.hpp"

namespace dygita {

int Register::add(std::string label, Origin origin, std::vector<int> uses) {
  entries_.push_back({std::move(label), std::move(origin), std::move(uses)});
  return static_cast<int>(entries_.size()) - 1;
}

std::vector<std::string> Register::unused() const {
  std::vector<bool> is_used(entries_.size()), is_referred(entries_.size());
  // Objects refer to earlier ones only: one sweep from the last reaches everything.
  for (size_t i = entries_.size(); i-- > 0;) {
    if (entries_[i].is_used) is_used[i] = true;
    for (const int j : entries_[i].uses) {
      is_referred[static_cast<size_t>(j)] = true;
      if (is_used[i]) is_used[static_cast<size_t>(j)] = true;
    }
  }
  std::vector<std::string> warnings;
  for (size_t i = 0; i < entries_.size(); ++i) {
    if (is_used[i] || is_referred[i]) continue;
    const bool is_problem = entries_[i].label.rfind("problem", 0) == 0;
    warnings.push_back(entries_[i].origin.prefix() + entries_[i].label +
                       (is_problem ? " is declared but never run" : " is declared but never used"));
  }
  return warnings;
}

}  // namespace dygita
