// A condensed assembly as files: matrices in Matrix Market format and a page that says what their rows are.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "reduction/superelement.hpp"

namespace dygita {

// A symmetric matrix, dense: "matrix array real symmetric", its lower triangle by columns, 17 significant digits.
// Source: Boisvert, Pozo, Remington, The Matrix Market exchange formats, NISTIR 5935 (1996).
std::string matrix_market_text(const Mat& symmetric, const std::string& comment);

// "NOT CONVERGED: 3 increments up to the end of step 'tighten' missed the tolerance".
std::string unconverged_text(const Superelement& element);

// The .json of a superelement. matrices: suffixes and contents of its matrices' files, whose digests it has.
std::string superelement_description(const std::string& problem, const SuperelementRequest& request,
                                     const Superelement& element,
                                     const std::vector<std::pair<std::string, std::string>>& matrices);

// Names (after the output's) and contents: _mass.mtx, _stiffness.mtx, _damping.mtx where there is any, .json and .md.
std::vector<std::pair<std::string, std::string>> superelement_files(const std::string& problem,
                                                                    const SuperelementRequest& request,
                                                                    const Superelement& element);

}  // namespace dygita
