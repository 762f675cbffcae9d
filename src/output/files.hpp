// Contents of files.
#pragma once

#include <filesystem>
#include <string>

#include "base/names.hpp"

namespace dygita {

// What a report draws of a run, already projected, in the run's folder.
inline constexpr const char* scene_file = "scenes.json";

// Writes a file whole or not at all: into <path>.tmp, then renamed. Throws InputError with the system's reason.
void write_text(const std::filesystem::path& path, const std::string& text);

// Throws InputError with the system's reason.
void make_directory(const std::filesystem::path& path);

}  // namespace dygita
