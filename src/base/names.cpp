#include "base/names.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <numeric>
#include <optional>

namespace dygita {

namespace {

size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
    }
  }
  return row.back();
}

// "M", 7 of "M7"; nothing where it does not end with a number.
std::optional<std::pair<std::string, long>> numbered(const std::string& name) {
  constexpr size_t most_digits = 9;
  const size_t last = name.find_last_not_of("0123456789"), digits = last == std::string::npos ? 0 : last + 1;
  if (digits == 0 || digits == name.size() || name.size() - digits > most_digits) return {};
  return std::pair{in_lower_case(name.substr(0, digits)), std::stol(name.substr(digits))};
}

// Of names that differ by their number, those with the next lower and the next higher one: a 7 is no misspelt 3.
std::vector<std::string> neighbours_in_number(const std::string& name, const std::vector<std::string>& known) {
  const auto own = numbered(name);
  std::map<long, std::string> series;
  for (const std::string& candidate : known)
    if (const auto other = numbered(candidate); own && other && own->first == other->first)
      series[other->second] = candidate;
  if (series.empty() || series.contains(own->second)) return {};
  const auto above = series.upper_bound(own->second);
  std::vector<std::string> neighbours;
  if (above != series.begin()) neighbours.push_back(std::prev(above)->second);
  if (above != series.end()) neighbours.push_back(above->second);
  return neighbours;
}

std::string suggestion(const std::string& name, const std::vector<std::string>& known) {
  const std::vector<std::string> neighbours = neighbours_in_number(name, known);
  if (neighbours.size() == 2) return "did you mean '" + neighbours[0] + "' or '" + neighbours[1] + "'? ";
  const std::string best = neighbours.empty() ? closest_name(name, known) : neighbours.front();
  return best.empty() ? "" : "did you mean '" + best + "'? ";
}

}  // namespace

std::string closest_name(const std::string& name, const std::vector<std::string>& known) {
  constexpr size_t longest = 200;
  if (name.empty() || name.size() > longest) return "";
  for (const std::string& candidate : known)
    if (in_lower_case(candidate) == in_lower_case(name)) return candidate;
  std::string best;
  size_t best_distance = std::max<size_t>(2, (name.size() + 1) / 2);
  for (const std::string& candidate : known) {
    const size_t distance = edit_distance(name, candidate);
    if (distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string did_you_mean(const std::string& name, std::vector<std::string> known) {
  std::sort(known.begin(), known.end());
  std::string text = suggestion(name, known) + "known: ";
  for (size_t i = 0; i < known.size(); ++i) text += (i ? ", " : "") + known[i];
  return known.empty() ? text + "none" : text;
}

std::string printable(const std::string& text) {
  std::string shown;
  const auto escape = [&](unsigned char byte) {
    constexpr const char* digits = "0123456789abcdef";
    shown += {'\\', 'x', digits[byte >> 4], digits[byte & 15]};
  };
  for (size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : '\0');
    if (byte == 0xc2 && next >= 0x80 && next < 0xa0) {  // U+0080 to U+009F, which terminals obey as well
      escape(byte);
      escape(next);
      ++i;
    } else if ((byte < 0x20 && byte != '\n' && byte != '\t') || byte == 0x7f) {
      escape(byte);
    } else {
      shown += text[i];
    }
  }
  return shown;
}

std::string file_name_of(const std::string& name) {
  if (name.empty()) return "unnamed";
  std::string file_name = name;
  for (char& c : file_name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f || c == '/' || c == '\\') c = '_';
  }
  if (file_name.front() == '.') file_name.front() = '_';
  return file_name;
}

std::string in_lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

}  // namespace dygita
