// The three errors, never mixed, and the place in a deck that an object came from.
#pragma once

#include <stdexcept>
#include <string>

namespace dygita {

// Where in a deck something was declared; an empty file means "not from a deck".
struct Origin {
  std::string file;
  int line = 0;

  // "crush.lua:18: ", or nothing when unknown: the prefix of every message to the user.
  std::string prefix() const { return file.empty() ? "" : file + ":" + std::to_string(line) + ": "; }
};

// The deck or the mesh is wrong (exit 2). The message says what, where, what is allowed and the closest name.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
  InputError(const Origin& origin, const std::string& message) : std::runtime_error(origin.prefix() + message) {}
};

// The computation failed (exit 3): what failed, in which substructure or interface, step and instant, the likely cause.
class NumericalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A programmer broke a contract (exit 4); thrown by CHECK.
class ContractError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

[[noreturn]] void contract_broken(const char* condition, const char* file, int line, const std::string& detail);

}  // namespace dygita

#define CHECK(condition, detail)                                                         \
  do {                                                                                   \
    if (!(condition)) ::dygita::contract_broken(#condition, __FILE__, __LINE__, detail); \
  } while (false)
