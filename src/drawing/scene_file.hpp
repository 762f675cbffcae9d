// scenes.json: what a report draws of a run, already projected and small, so that a report needs no mesh.
#pragma once

#include <string>

#include "files/files.hpp"
#include "model/model.hpp"
#include "result/result.hpp"
#include "result/scenes.hpp"

namespace dygita {

// Pictures of the assembly and of its modes, maps of the joints (picture.hpp, joint_map.hpp) as JSON. Lengths of
// pictures are tenths of a pixel.
std::string scene_text(const Problem& problem, const RunResult& result);

}  // namespace dygita
