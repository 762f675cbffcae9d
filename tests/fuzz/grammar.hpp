// The language of decks as the schema (lua/schema.lua) has it, for writing decks that are nearly right.
#pragma once

#include <random>
#include <string>
#include <vector>

namespace dygita::fuzz {

using Random = std::mt19937_64;

struct Argument {
  std::string name, type, unit;
  double low = 0.0, high = 1.0;  // range
  bool is_required = false, may_be_single = false;
  std::vector<std::string> choices, kinds;
  std::vector<Argument> fields;  // of a table
};

struct Entry {
  std::string path;  // "mesh.box", or "substructure:face" for a method
  std::string makes;
  std::vector<Argument> arguments;
  bool is_method() const { return path.find(':') != std::string::npos; }
  std::string member() const { return path.substr(path.find_last_of(".:") + 1); }
};

struct Grammar {
  std::vector<Entry> entries;
  std::vector<std::string> words;  // of constructors, arguments and choices, each once
  const Entry* entry(const std::string& path) const;
};

// Of this build, read once.
const Grammar& grammar();

// What a deck has declared, by the kind of object: names to write where an object is asked for.
using Declared = std::vector<std::pair<std::string, std::string>>;  // kind ("face", "interface.contact"), name
Declared declared_in(const std::string& deck);

template <class T>
const T& one_of(const std::vector<T>& list, Random& random) {
  return list[random() % list.size()];
}
inline bool chance(double share, Random& random) { return static_cast<double>(random() % 10000) < 1e4 * share; }

// "young = 210*GPa", mostly of the right type and within its range.
std::string text_of(const Argument& argument, const Declared& declared, Random& random);
std::string value_for(const Argument& argument, const Declared& declared, Random& random);
std::string any_value(const Declared& declared, Random& random);
std::string any_number(Random& random);
// A statement that declares an object: "local x7 = load.pressure{ ... }".
std::string statement(const Declared& declared, Random& random);

}  // namespace dygita::fuzz
