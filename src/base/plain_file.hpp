// Files in folders that may be anybody's: what is opened there to be read must have an end.
#pragma once

#include <filesystem>

namespace dygita {

// Is there something other than a file: a pipe or a socket, whose reader waits, a device, which may not end, a folder?
// Links are followed; false where nothing is there.
bool is_no_file(const std::filesystem::path& path);

// Throws InputError where `is_no_file`.
void require_file(const std::filesystem::path& path);

}  // namespace dygita
