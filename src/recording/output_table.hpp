// Every output.* of decks: how it is made, and what the report shows of it.
#pragma once

#include "model/arguments.hpp"
#include "model/output.hpp"

namespace dygita {

// The ways in which the report shows a table.
struct Display {
  enum class As {
    nothing,
    curves,       // of its columns, against time
    spectrum,     // with its specification
    attenuation,  // bands of three columns an axis: entering, leaving, ratio
    joint,        // forces, areas by state, loops, works, maps
    loop,         // force against displacement, and its cycles
    frequencies,  // a list
    modes,        // with effective masses and shapes
    amplitude,    // frequency and damping against it
    energy        // one on top of the other
  };
  As as;
  std::string quantity;  // curves: of the columns; empty: the record states it
  int n_columns;         // curves: how many are drawn; 0: all
};

struct OutputEntry {
  std::string word;
  OutputPtr (*make)(const ModelArguments& arguments);
  Display display;
};

template <class T>
OutputPtr new_output(const ModelArguments& arguments) {
  return std::make_shared<const T>(arguments);
}

// One entry for each file of outputs/, in the order of their names. CMake writes this function.
const std::vector<OutputEntry>& output_table();

// The entry of a word; null: there is none.
const OutputEntry* output_entry(const std::string& word);

// The output of arguments.word(); CHECKs that there is one. Throws InputError where arguments contradict each other.
OutputPtr make_output(const ModelArguments& arguments);

}  // namespace dygita
