// Arguments as a deck would give them, for loads and outputs built without a deck.
#pragma once

#include "model/arguments.hpp"

namespace dygita {

class GivenArguments : public ModelArguments {
 public:
  GivenArguments(std::string path, Origin origin) : path_(std::move(path)), origin_(std::move(origin)) {}

  std::vector<Target> on;
  std::vector<SubstructurePtr> parts;
  std::map<std::string, TimeValue> values_of_time;  // numbers too
  std::map<std::string, std::vector<double>> lists;
  std::map<std::string, std::string> words;
  std::map<std::string, std::map<std::string, double>> tables;
  std::map<std::string, std::vector<std::string>> word_lists;
  std::map<std::string, std::vector<Target>> places_of;  // beside `on`
  std::map<std::string, OutputPtr> outputs;
  std::map<std::string, StepPtr> step_of;
  std::map<std::string, std::shared_ptr<const Specification>> specifications;

  const std::string& path() const override { return path_; }
  const Origin& origin() const override { return origin_; }
  bool has(const char* key) const override {
    return values_of_time.contains(key) || lists.contains(key) || words.contains(key) || tables.contains(key);
  }
  bool is_number(const char* key) const override {
    return values_of_time.contains(key) && values_of_time.at(key).is_number;
  }
  bool is_table(const char* key) const override { return tables.contains(key); }
  double number(const char* key) const override { return values_of_time.at(key).history.value(0.0); }
  bool boolean(const char* key) const override { return number(key) != 0.0; }
  std::string text(const char* key) const override { return words.at(key); }
  std::vector<double> numbers(const char* key) const override { return lists.at(key); }
  std::vector<std::string> texts(const char* key) const override { return word_lists.at(key); }
  std::map<std::string, double> settings(const char* key) const override { return given(tables, key); }
  TimeValue value(const char* key) const override { return values_of_time.at(key); }
  std::vector<Target> targets(const char* key) const override {
    return std::string(key) == "on" ? on : given(places_of, key);
  }
  std::vector<SubstructurePtr> substructures(const char*) const override { return parts; }
  StepPtr step(const char* key) const override { return given(step_of, key); }
  std::vector<StepPtr> steps(const char*) const override { return {}; }
  OutputPtr output(const char* key) const override { return given(outputs, key); }
  std::shared_ptr<const Specification> specification(const char* key) const override {
    return given(specifications, key);
  }

 private:
  template <class T>
  static T given(const std::map<std::string, T>& values, const char* key) {
    const auto found = values.find(key);
    return found == values.end() ? T() : found->second;
  }

  std::string path_;
  Origin origin_;
};

}  // namespace dygita
