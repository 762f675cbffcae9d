// Pages that shells and man read, made from the rows of the command line. rows: the program itself first, then its
// commands.
#pragma once

#include <string>
#include <vector>

#include "app/command_rows.hpp"

namespace dygita {

const std::vector<std::string>& known_shells();

// The completion script for one of the known shells (InputError for another).
std::string completion_script(const std::vector<CommandRow>& rows, const std::string& shell);

// dygita(1) in roff; exits: code and meaning.
std::string man_page(const std::vector<CommandRow>& rows, const std::vector<std::pair<int, std::string>>& exits,
                     const std::string& version);

}  // namespace dygita
