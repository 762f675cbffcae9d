// Labels of equations (S1, L4, ...): where manual/method.md defines them, and where anything cites them.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace dygita::architecture {

// Labels that the text of manual/method.md defines, in its order, each as often as it is defined: at the head of a
// line of equations ("    S1    M (V1 - V0)/dt ...") or in brackets at its end ("... = Q  (Q1)").
std::vector<std::string> defined_labels(const std::string& method);

enum class Prose { cpp_comments, lua_comments, python_comments, markdown };

// Labels that a text cites in its comments, or in a manual's prose outside code and equations. A word like one (a
// letter and a number from 1 to 99) is a label if its letter is one of `families`, or if it follows "eq. ".
std::vector<std::string> cited_labels(const std::string& text, Prose prose, const std::set<char>& families);

}  // namespace dygita::architecture
