// How a check refuses what a deck declared, or warns of it: with the place in the deck and the problem's name.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/warnings.hpp"
#include "model/model.hpp"

namespace dygita::check {

// Throws InputError "<origin>: problem '<name>': <text>"; `hint`, where given, follows on its own line.
[[noreturn]] void fail(const Problem& problem, const Origin& origin, const std::string& text,
                       const std::string& hint = "");

// Warns of it: "<origin>: problem '<name>': <text>".
void doubt(const Problem& problem, const Origin& origin, const std::string& text);
void doubt(const Problem& problem, const Origin& origin, const std::string& text, const KindOfWarning& of);

// Throws unless an output is on something, and on listed objects only; `refused` says why it cannot be on a target,
// nothing where it can.
void is_on(const Problem& problem, const Output& output, const std::vector<Target>& on,
           const std::function<std::string(const Target&)>& refused);

// Throws where another output is called as files of this one are: its own name and one of the suffixes.
void names_are_free(const Problem& problem, const Output& output, const std::vector<std::string>& suffixes);

// Throws InputError where a file of the output, its name and one of `suffixes` (".json"), is one of the program's own.
void files_are_free(const Problem& problem, const Output& output, const std::vector<std::string>& suffixes);

// Throws unless the part of a face or a region is in 'substructures', its group exists and it is not empty; `who` opens
// the message ("interface 'seat' joins").
void place_exists(const Problem& problem, const Origin& origin, const std::string& who, const FaceOrRegion& place);

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
