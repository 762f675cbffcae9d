// Parts of the run record that say what was computed: interfaces, supports, outputs, bolts.
#pragma once

#include <nlohmann/json.hpp>

#include "result/result.hpp"

namespace dygita {

// Gives the interfaces and walls of a record the `law` that earlier versions did not write, made from their kind
// and parameters. Throws InputError where an interface cannot be told: it must not pass for a contact.
void complete_laws(nlohmann::ordered_json& record);

nlohmann::ordered_json interfaces_record(const Problem& problem);
nlohmann::ordered_json supports_record(const Problem& problem);
// Outputs with a table, in the deck's order, with the file of each and what it reports about itself.
nlohmann::ordered_json outputs_record(const Problem& problem, const RunResult& result);
// Tolerances and what else tells how it was solved.
nlohmann::ordered_json solver_record(const Problem& problem);

}  // namespace dygita
