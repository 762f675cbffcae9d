// What the mesher does: reads a file by gmsh and meshes what is not meshed. All throw InputError.
#pragma once

#include "intake/mesher_task.hpp"

namespace dygita {

// `path`: what gmsh opens, the file or a script that includes it.
MesherAnswer read_file(const GmshOptions& options, const std::string& path);
MesherAnswer read_assembly(const StepOptions& options);

// Tells the program that waits what goes on, at most ten times a second: a line on standard error.
void tell(const std::string& doing);

}  // namespace dygita
