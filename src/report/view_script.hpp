// view.py: sets ParaView up for a run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "files/frame_summary.hpp"
#include "model/model.hpp"
#include "model/own_files.hpp"

namespace dygita {

inline constexpr const char* view_file = own_file::view;

// A script for paraview --script and pvpython: parts and interfaces side by side, warped, coloured over the range of
// all frames, clipped, at the instant of largest stress (displacement, where there is none) of the motion. `folder` is
// where the run's files are in the end. Empty without frames.
std::string view_script(const Problem& problem, const std::vector<FrameSummary>& frames,
                        const std::filesystem::path& folder);

// The same written afresh for a run that lies in `folder` now, from the values in the text of its view.py: what else
// stands there is left behind, so that no program of a stranger's runs. Throws InputError where a value is missing or
// is no plain number, text or list. At its end it takes the folder `own` away, where it lies itself.
std::string view_script_again(const std::string& kept, const std::filesystem::path& folder,
                              const std::filesystem::path& own);

}  // namespace dygita
