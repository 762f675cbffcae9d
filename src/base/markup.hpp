// Text inside HTML, SVG and XML.
#pragma once

#include <string>

namespace dygita {

// For text and quoted attributes: & < > " ' and control characters (which XML forbids).
std::string escaped(const std::string& text);

}  // namespace dygita
