// What a constructor of the deck was given, as the floors below the deck see it: types and ranges have been checked and
// defaults are filled in, so that a law, a load or an output can be built where it is defined.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace dygita {

class Arguments {
 public:
  virtual ~Arguments() = default;

  virtual const std::string& path() const = 0;                              // the constructor: "interface.contact"
  virtual const Origin& origin() const = 0;                                 // the deck's line
  std::string word() const { return path().substr(path().find('.') + 1); }  // "contact"

  virtual bool has(const char* key) const = 0;
  virtual bool is_number(const char* key) const = 0;
  virtual bool is_table(const char* key) const = 0;

  // CHECKs that the argument is given and of this type.
  virtual double number(const char* key) const = 0;
  virtual bool boolean(const char* key) const = 0;
  virtual std::string text(const char* key) const = 0;
  virtual std::vector<double> numbers(const char* key) const = 0;
  virtual std::vector<std::string> texts(const char* key) const = 0;
  virtual std::map<std::string, double> settings(const char* key) const = 0;  // empty when absent; true counts as 1

  double number_or(const char* key, double otherwise) const { return has(key) ? number(key) : otherwise; }
  int integer(const char* key) const { return static_cast<int>(number(key)); }
};

}  // namespace dygita
