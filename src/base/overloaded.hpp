// Visiting a std::variant with one lambda for each alternative and no default: a new alternative does not compile until
// every visitor has an answer.
#pragma once

#include <type_traits>

namespace dygita {

template <class... Answers>
struct overloaded : Answers... {
  using Answers::operator()...;
};
template <class... Answers>
overloaded(Answers...) -> overloaded<Answers...>;

// The alternatives that do not concern a visitor, by name.
template <class... Alternatives>
struct Ignored {
  template <class Alternative>
  requires(std::is_same_v<Alternative, Alternatives> || ...) void operator()(const Alternative&) const {}
};

}  // namespace dygita
