#include "report/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace dygita {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// fmin and fmax pass over what is not known.
void add_step(const Json& step, Contact& contact) {
  contact.lowest = std::fmin(contact.lowest, number(step, "pressed_lowest"));
  contact.highest = std::fmax(contact.highest, number(step, "pressed_highest"));
  contact.shear = std::fmax(contact.shear, number(step, "shear"));
  contact.closed = std::fmin(contact.closed, number(step, "closed"));
  contact.opening = std::fmax(contact.opening, number(step, "opening"));
  contact.sliding = std::fmax(contact.sliding, number(step, "sliding"));
  contact.slip = std::fmax(contact.slip, number(step, "slip"));
  contact.friction_used = std::fmax(contact.friction_used, number(step, "friction_used"));
}

// Those that slide or part first, then by what is used of their friction.
double rank(const Contact& contact) {
  const double used = std::isfinite(contact.friction_used) ? contact.friction_used : 0.0;
  return (contact.has_changed() ? 10.0 : 0.0) + used;
}

}  // namespace

std::vector<Contact> contacts_of(const Json& record) {
  std::set<std::string> moving;
  for (const Json& step : record.at("steps"))
    if (text(step, "kind") == "dynamic") moving.insert(text(step, "name"));
  std::vector<Contact> contacts;
  for (const Json& told : record.value("contacts", Json::array())) {
    Contact contact{text(told, "name"),
                    number(told, "area"),
                    number(told, "friction"),
                    nan,
                    nan,
                    nan,
                    nan,
                    nan,
                    nan,
                    nan,
                    nan,
                    nan};
    const Json steps = told.value("steps", Json::array());
    const bool moves =
        std::any_of(steps.begin(), steps.end(), [&](const Json& step) { return moving.contains(text(step, "step")); });
    for (const Json& step : steps) {
      const bool is_static = !moving.contains(text(step, "step"));
      if (is_static && std::isnan(contact.lowest)) contact.at_rest = number(step, "pressed_highest");
      if (!is_static || (!moves && &step == &steps.back())) add_step(step, contact);
    }
    if (!steps.empty()) contacts.push_back(std::move(contact));
  }
  std::stable_sort(contacts.begin(), contacts.end(),
                   [](const Contact& a, const Contact& b) { return rank(a) > rank(b); });
  return contacts;
}

}  // namespace dygita
