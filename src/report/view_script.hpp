// view.py: sets ParaView up for a run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "model/model.hpp"
#include "model/own_files.hpp"
#include "output/frame_summary.hpp"

namespace dygita {

inline constexpr const char* view_file = own_file::view;

// A script for paraview --script and pvpython: parts and interfaces side by side, warped, coloured over the range of
// all frames, clipped, at the instant of largest stress (displacement, where there is none) of the motion. `folder` is
// where the run's files are in the end. Empty without frames.
std::string view_script(const Problem& problem, const std::vector<FrameSummary>& frames,
                        const std::filesystem::path& folder);

}  // namespace dygita
