// What a run says of the thing that was computed: sentences, and cards that say the same.
#pragma once

#include <string>
#include <vector>

#include "report/card.hpp"
#include "report/report.hpp"

namespace dygita {

class RunFolder;

struct Finding {
  std::string sentence;  // empty: nothing to say
  std::vector<Card> cards;
};

// Each spectrum against its specification, what bolts have kept, what contacts did, stress against yield.
std::vector<Finding> findings_of(const RunFolder& run, const ReportRequest& request);

}  // namespace dygita
