// The files of lua/, put into the program when it is built.
#pragma once

#include <map>
#include <string>

namespace dygita {

// Text of each file by its name without extension ("schema", "check", ...).
const std::map<std::string, std::string>& embedded_lua();

}  // namespace dygita
