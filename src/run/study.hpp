// Cases of a problem that a deck runs one after the other: what they come to, side by side.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "report/study_files.hpp"

namespace dygita {

class Study {
 public:
  // In the order of the runs; by problem.
  void add(const std::string& problem, StudyCase one) { cases_[problem].push_back(std::move(one)); }

  // For each problem with several cases, some of which were told their parameters (run{ at = ... }) : writes
  // out/<problem>/study.csv and study.svg where `writes_files`, and says a summary.
  void finish(const std::filesystem::path& out, bool writes_files) const;

 private:
  std::map<std::string, std::vector<StudyCase>> cases_;
};

}  // namespace dygita
