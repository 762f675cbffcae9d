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

// Names of the faces: those of their meshes where these tell them apart.
std::vector<std::string> face_names(const std::vector<Target>& on);

// What Nastran reads (suffix .pch): GRID points, SPOINTs for modes, and KAAX, MAAX, BAAX as symmetric DMIG of ten
// digits in SI; and the table of the points with their numbers (_points.csv) that substructure.superelement takes
// beside it. Source: MSC Nastran Quick Reference Guide, DMIG.
std::vector<std::pair<std::string, std::string>> dmig_files(const SuperelementRequest& request,
                                                            const Superelement& element);

// Names (after the output's) and contents: _mass.mtx, _stiffness.mtx, _damping.mtx where there is any, .json and .md;
// those for Nastran where they are asked for.
std::vector<std::pair<std::string, std::string>> superelement_files(const std::string& problem,
                                                                    const SuperelementRequest& request,
                                                                    const Superelement& element);

}  // namespace dygita
