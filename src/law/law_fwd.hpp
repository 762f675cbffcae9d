// Names of laws for those who hold one and ask it nothing: law.hpp may then change without them.
#pragma once

#include <map>
#include <memory>
#include <string>

namespace dygita {

class Law;
using LawPtr = std::shared_ptr<const Law>;

// Arguments of a law by name, SI; 1 and 0 for yes and no.
using LawArguments = std::map<std::string, double>;

}  // namespace dygita
