// A .geo file is a program of gmsh's: a stranger's must not be able to do more than describe a mesh.
#pragma once

#include <string>

namespace dygita {

// Reads a mesh file before gmsh does. Throws InputError, naming the word and its line, where a .geo calls the system,
// writes a file, opens a window or loads a plugin; where it merges or includes a file, that file is checked too. A .msh
// must be one (gmsh would run any other text as a .geo), and no <file>.opt may lie beside it (gmsh would run that).
void check_script(const std::string& path);

}  // namespace dygita
