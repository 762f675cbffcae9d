// Contents of files.
#pragma once

#include <filesystem>
#include <string>

#include "base/names.hpp"
#include "model/own_files.hpp"

namespace dygita {

// What a report draws of a run, already projected, in the run's folder.
inline constexpr const char* scene_file = own_file::scenes;

// Writes a file whole or not at all: into <path>.tmp, then renamed. Throws InputError with the system's reason.
void write_text(const std::filesystem::path& path, const std::string& text);

// Throws InputError with the system's reason.
void make_directory(const std::filesystem::path& path);

// Throws InputError where a folder of `relative`, or its last member, is a link: what is written there would go
// elsewhere.
void refuse_links(const std::filesystem::path& home, const std::filesystem::path& relative);

}  // namespace dygita
