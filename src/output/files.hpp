// Names and contents of files.
#pragma once

#include <filesystem>
#include <string>

namespace dygita {

// What a report draws of a run, already projected, in the run's folder.
inline constexpr const char* scene_file = "scenes.json";

// The name as a file's or directory's: '/', '\' and control characters become '_', a '.' in front too, an empty name
// "unnamed". A name that check_problem lets through is unchanged.
std::string file_name_of(const std::string& name);

// Writes a file whole or not at all: into <path>.tmp, then renamed. Throws InputError with the system's reason.
void write_text(const std::filesystem::path& path, const std::string& text);

// Throws InputError with the system's reason.
void make_directory(const std::filesystem::path& path);

}  // namespace dygita
