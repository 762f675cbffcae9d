// Frames as VTK's unstructured grids (.vtu): the only place that knows VTK.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "result/frame.hpp"

namespace dygita {

// Undeformed nodes (mesh + place, m), cells, and the fields as point arrays: `displacement` always (Warp By Vector
// needs nothing else), six components named XX YY ZZ XY YZ XZ. Points and displacement in double precision, the rest in
// single. Inline binary, zlib. All throw InputError where the file cannot be written.
void write_part(const PartFrame& part, const Frame& frame, const std::filesystem::path& path);

// Of a part in pieces: the list that ParaView opens as one grid (.pvtu), whose files stand beside it in the order of
// its ranks; the instant is told here, too.
void write_pieces(const PartFrame& part, const Frame& frame, const std::vector<std::filesystem::path>& files,
                  const std::filesystem::path& path);

// All interfaces in one grid of triangles and quadrangles; the cell array `interface` is the index into the field data
// `interface_name`. A field that an interface does not have is NaN on it (displacement: zero).
void write_interfaces(const Frame& frame, const std::filesystem::path& path);

// "9.1.0": of the library in use.
std::string vtk_version();

}  // namespace dygita
