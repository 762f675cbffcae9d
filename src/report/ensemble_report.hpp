// What an ensemble has to say, on the screen and on a page.
#pragma once

#include "estimates/ensemble.hpp"

namespace dygita {

const char* name_of(Design design);

// Of each spectrum how far P95/50 is above its specification, or its spread, and what drives it; of other figures what
// drives them.
std::vector<std::string> ensemble_lines(const Ensemble& ensemble, const std::vector<OutputScatter>& scatter);
// Spectra whose members fall into two groups, which P95/50 takes as one.
std::vector<std::string> ensemble_warnings(const Ensemble& ensemble, const std::vector<OutputScatter>& scatter);
// Of a spectrum, SVG: median, P95/50, the envelope and the specification over frequency.
std::string ensemble_chart(const Ensemble& ensemble, const OutputScatter& scatter);
// report.html: all of these, what drives which figure, and the members.
std::string ensemble_page(const Ensemble& ensemble, const std::vector<OutputScatter>& scatter);

}  // namespace dygita
