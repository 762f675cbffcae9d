// RBE2 and RBE3: the motion of a node and that of the nodes around it, rigidly or in the mean.
#pragma once

#include <string>
#include <vector>

#include "foreign/nastran_model.hpp"

namespace dygita {

struct NastranSpider {
  const BulkCard* card;
  bool is_mean;            // RBE3
  int centre;              // node of the model
  std::vector<int> feet;   // in increasing order
  std::string components;  // of the feet, "123"
  std::string doubt;       // why it is not read: weights that differ
  bool is_said = false;    // by a support or a load of a case
};

// Throws InputError with the card.
NastranSpider nastran_spider(const NastranModel& model, const BulkCard& card);

}  // namespace dygita
