// Tables as comma-separated values.
#pragma once

#include <filesystem>
#include <istream>
#include <string>
#include <vector>

#include "result/result.hpp"

namespace dygita {

// A text as a cell.
std::string quoted(const std::string& text);

// One line of `name [unit]` (or `name`), then one per row, nine significant digits (fifteen of `time`), SI. Where rows
// belong to steps, the second column is `step`, the step's name; where they are marked, the last one is `converged`, 1
// or 0. Texts with a comma, a quotation mark or a line break are quoted (RFC 4180).
std::string csv_text(const Table& table, const std::vector<std::string>& step_names);

// The same table with its numbers as that text has them: what is read back of it.
Table as_written(Table table);

// The table of such a text, of a problem with these steps. Throws InputError that tells the line ("line 3: 'x' is no
// number"), and the file.
Table parse_csv(std::istream& stream, const std::vector<std::string>& step_names);
Table read_csv(const std::filesystem::path& path, const std::vector<std::string>& step_names);

}  // namespace dygita
