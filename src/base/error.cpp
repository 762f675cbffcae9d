#include "base/error.hpp"

namespace dygita {

void contract_broken(const char* condition, const char* file, int line, const std::string& detail) {
  throw ContractError(std::string("internal error: ") + detail + " (" + condition + ", " + file + ":" +
                      std::to_string(line) + "); please report it");
}

}  // namespace dygita
