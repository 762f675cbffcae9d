// What a deck has declared, drawn before anything is solved: parts, their named faces, and what was found between them.
#pragma once

#include <string>

#include "model/model.hpp"

namespace dygita {

// An SVG file: the assembly with its parts' names, the interfaces and supports, and every part from two sides with its
// groups. An interface whose faces do not match is drawn red on both of them, and named so.
std::string check_picture_svg(const Problem& problem);

// A page with the same drawings and the assembly to turn, cut and pull apart.
std::string check_picture_html(const Problem& problem);

}  // namespace dygita
