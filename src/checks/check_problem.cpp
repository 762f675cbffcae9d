#include "checks/check_problem.hpp"

#include "checks/parts.hpp"

namespace dygita {

void check_problem(const Problem& problem) {
  check::names(problem);
  check::interfaces(problem);
  check::supports(problem);
  check::steps(problem);
  check::cells(problem);
  check::loads(problem);
  check::cyclic(problem);
  check::outputs(problem);
  check::integration(problem);
  check::histories(problem);
  check::doubts(problem);
  check::balance(problem);
  check::resolution(problem);
}

}  // namespace dygita
