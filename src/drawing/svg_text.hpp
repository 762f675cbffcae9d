// Pieces of SVG text: coordinates, colours that colour-blind readers tell apart.
#pragma once

#include <string>

#include "base/markup.hpp"

namespace dygita {

// "12.3", "12", "-0.5": one decimal, no trailing zero; "0" for what is not finite.
std::string coordinate(double value);

// Colour of a line or a part, no two alike. The first seven are those of Okabe and Ito (2008), which colour-blind
// readers tell apart; black is left for limits and specifications.
std::string series_color(int i);

// Colours of a scale from low (0) to high (1), after Matplotlib's viridis: even in lightness, so that it prints in
// grey.
std::string scale_color(double x);

// The beginning of a drawing of its own, sizes in pixels; ends with "</svg>".
std::string open_svg(double width, double height, const std::string& title);

}  // namespace dygita
