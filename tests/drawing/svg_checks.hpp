// Is a text well-formed XML? Enough of it for what this program writes: elements, attributes, the five entities.
#pragma once

#include <cctype>
#include <string>
#include <vector>

namespace dygita::test {

inline int count(const std::string& text, const std::string& what) {
  int n = 0;
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + what.size())) ++n;
  return n;
}

// The first fault, or nothing. `void_elements` of HTML (<meta>, <br>) need no end.
inline std::string xml_fault(const std::string& text, const std::vector<std::string>& void_elements = {}) {
  std::vector<std::string> open;
  const auto is_void = [&](const std::string& name) {
    for (const std::string& element : void_elements)
      if (element == name) return true;
    return false;
  };
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '&') {
      const size_t end = text.find(';', i);
      if (end == std::string::npos || end > i + 8) return "a bare & at " + text.substr(i, 30);
    }
    if (text[i] != '<') continue;
    if (text.compare(i, 2, "<!") == 0) {
      i = text.find('>', i);
      if (i == std::string::npos) return "an unclosed declaration";
      continue;
    }
    size_t end = i + 1;
    bool is_quoted = false;
    for (; end < text.size() && (is_quoted || text[end] != '>'); ++end) {
      if (text[end] == '"') is_quoted = !is_quoted;
      if (text[end] == '<') return "a bare < at " + text.substr(i, 60);
    }
    if (end == text.size()) return "an unclosed element at " + text.substr(i, 60);
    const bool is_end = text[i + 1] == '/', is_empty = text[end - 1] == '/';
    size_t name_end = i + 1 + (is_end ? 1 : 0);
    const size_t name_start = name_end;
    while (name_end < end && (std::isalnum(static_cast<unsigned char>(text[name_end])) || text[name_end] == '-'))
      ++name_end;
    const std::string name = text.substr(name_start, name_end - name_start);
    if (name.empty()) return "an element without name at " + text.substr(i, 30);
    if (is_end) {
      if (open.empty() || open.back() != name)
        return "</" + name + "> ends " + (open.empty() ? "nothing" : "<" + open.back() + ">");
      open.pop_back();
    } else if (!is_empty && !is_void(name)) {
      open.push_back(name);
      if (name == "style" || name == "script") {  // its text is no markup
        const size_t closed = text.find("</" + name + ">", end);
        if (closed == std::string::npos) return "<" + name + "> is not closed";
        end = closed - 1;
      }
    }
    i = end;
  }
  return open.empty() ? "" : "<" + open.back() + "> has no end";
}

}  // namespace dygita::test
