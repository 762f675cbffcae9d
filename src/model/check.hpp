// The parts of check_problem and what they share. Each throws InputError with the origin of the object at fault.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/warnings.hpp"
#include "model/model.hpp"

namespace dygita::check {

// Names: given, unique in their list, fit for a file; no object listed twice.
void names(const Problem& problem);

// Interfaces and supports: their parts are listed, their faces exist, no face is under two supports in one step.
void interfaces(const Problem& problem);
void supports(const Problem& problem);

// Steps: one line in the order listed, times and increments, a static step first where there is an interference.
void steps(const Problem& problem);

// Cells: of order one where a solver's setting wants the mass at the nodes.
void cells(const Problem& problem);

// Loads of every step: on what they can act, listed, in a step where they mean something, nothing prescribed twice.
void loads(const Problem& problem);

// Outputs: on what they can be, listed, spectra of a scalar acceleration.
void outputs(const Problem& problem);

// Substructures that are to be explicit can be.
void integration(const Problem& problem);

// What is allowed but hardly meant: said with warn().
void doubts(const Problem& problem);

// Forces on nodes whose motion is prescribed: said with warn(). Throws where preloads leave a substructure without
// equilibrium.
void balance(const Problem& problem);

// A time step or a mesh too coarse for what the loads bring and the spectra ask for: said with warn(), with the
// figures.
void resolution(const Problem& problem);

// Histories of loads and the steps they act in: pulses that a step cuts off or a time step swallows, records held
// beyond their ends, peaks that no step reaches: said with warn(). Throws where a record is in another unit than its
// load.
void histories(const Problem& problem);

// Throws InputError "<origin>: problem '<name>': <text>"; `hint`, where given, follows on its own line.
[[noreturn]] void fail(const Problem& problem, const Origin& origin, const std::string& text,
                       const std::string& hint = "");

// Warns of it: "<origin>: problem '<name>': <text>".
void doubt(const Problem& problem, const Origin& origin, const std::string& text);
void doubt(const Problem& problem, const Origin& origin, const std::string& text, const KindOfWarning& of);

bool has_dynamic_step(const Problem& problem);
bool is_wall(const Target& target);

// Throws unless an output is on something, and on listed objects only; `refused` says why it cannot be on a target,
// nothing where it can.
void is_on(const Problem& problem, const Output& output, const std::vector<Target>& on,
           const std::function<std::string(const Target&)>& refused);

// Throws where another output is called as files of this one are: its own name and one of the suffixes.
void names_are_free(const Problem& problem, const Output& output, const std::vector<std::string>& suffixes);

// Throws InputError where a file of the output, its name and one of `suffixes` (".json"), is one of the program's own.
void files_are_free(const Problem& problem, const Output& output, const std::vector<std::string>& suffixes);

// Every support in force in some step, each once, the problem's own first.
std::vector<SupportPtr> all_supports(const Problem& problem);

// Throws unless the part of a face or a region is in 'substructures', its group exists and it is not empty; `who` opens
// the message ("interface 'seat' joins").
void place_exists(const Problem& problem, const Origin& origin, const std::string& who, const FaceOrRegion& place);

const Substructure& part_of(const FaceOrRegion& place);
std::string label_of(const FaceOrRegion& place);
std::vector<int> nodes_at(const FaceOrRegion& place);  // of the part's mesh, increasing
// Nodes and shares, of sum 1, whose motion is the place's mean one: by area on a face, alike in a region.
std::vector<std::pair<int, double>> mean_of(const FaceOrRegion& place);

// On one part, every node of one also a node of the other.
bool one_in_other(const FaceOrRegion& a, const FaceOrRegion& b);
// On one part with the same nodes.
bool coincide(const FaceOrRegion& a, const FaceOrRegion& b);
// Two faces with a facet, or two regions with a node in common.
bool overlap(const FaceOrRegion& a, const FaceOrRegion& b);

// "face 'punch.zmin'", "a region of 'punch'", "interface.contact 'touch'", "support.wall 'wall'".
std::string describe(const Target& target);
std::string describe(const Interface& interface);
std::string describe(const Support& support);

Target target_of(const FaceOrRegion& place);
// The face or region of a target, if it is one.
std::optional<FaceOrRegion> place_of(const Target& target);

// Throws unless the target is in the problem's lists (a support: in `supports`); `who` as in place_exists.
void target_exists(const Problem& problem, const Origin& origin, const std::string& who, const Target& target,
                   const std::vector<SupportPtr>& supports);

// Why `object` is not in `list` (called `list_name`): another object of its name is, or the names that are.
std::string why_not_listed(const Named& object, const std::vector<const Named*>& list, const std::string& list_name);

// Throws "<who> '<name>', which is not in '<list_name>'" unless `object` itself is in `list`.
template <class T>
void listed(const Problem& problem, const std::string& who, const T& object,
            const std::vector<std::shared_ptr<const T>>& list, const std::string& list_name) {
  if (index_of(list, &object) >= 0) return;
  std::vector<const Named*> named;
  for (const auto& other : list) named.push_back(other.get());
  fail(problem, problem.origin, who + " '" + object.name + "', which is not in '" + list_name + "'",
       why_not_listed(object, named, list_name));
}

}  // namespace dygita::check
