// Files in folders that may be anybody's: what is read from there must be a regular file within a limit of size.
#pragma once

#include <filesystem>
#include <string>

namespace dygita {

// Is there something other than a file: a pipe or a socket, whose reader waits, a device, which may not end, a folder?
// Links are followed; false where nothing is there.
bool is_no_file(const std::filesystem::path& path);

// Throws InputError where `is_no_file`.
void require_file(const std::filesystem::path& path);

// Bytes that a file may have to be read at once, from now on: --memory-limit.
void set_file_limit(double bytes);

// Throws InputError where `is_no_file`, or where the file is larger than that: before anything of it is read.
void require_readable(const std::filesystem::path& path);

// The text of a file. Throws InputError where it cannot be read, or is larger than may be.
std::string text_of_file(const std::string& file);

// Removes the files in a folder that are called by numbers, as parts of ranks are, and the folder where this leaves it
// empty; of a link the link alone. What others put there stays.
void remove_parts(const std::filesystem::path& folder);

// What `errno` says of a file that could not be written.
std::string reason_not_written(int error);

}  // namespace dygita
