// The assembly, and what check_problem says of it.
#pragma once

#include <string>
#include <vector>

#include "checks/check_problem.hpp"
#include "model/assembly.hpp"

namespace dygita {

class CheckedAssembly : public Assembly {
 protected:
  // The message to the user, whole; "" when the problem is accepted.
  std::string complaint() const {
    try {
      check_problem(problem);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  std::string only_warning() const {
    take_warnings();
    EXPECT_EQ(complaint(), "");
    const std::vector<std::string> warnings = take_warnings();
    EXPECT_EQ(warnings.size(), 1U);
    return warnings.empty() ? "" : warnings.front();
  }
};

}  // namespace dygita
