#include "output/files.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "base/error.hpp"

namespace dygita {

namespace fs = std::filesystem;

std::string file_name_of(const std::string& name) {
  if (name.empty()) return "unnamed";
  std::string file_name = name;
  for (char& c : file_name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f || c == '/' || c == '\\') c = '_';
  }
  if (file_name.front() == '.') file_name.front() = '_';
  return file_name;
}

void write_text(const fs::path& path, const std::string& text) {
  const fs::path temporary = path.string() + ".tmp";
  errno = 0;
  std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  if (!file) throw InputError("cannot write '" + path.string() + "': " + std::strerror(errno));
  std::error_code error;
  fs::rename(temporary, path, error);
  if (error) throw InputError("cannot write '" + path.string() + "': " + error.message());
}

void make_directory(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (!error && !fs::is_directory(path)) error = std::make_error_code(std::errc::not_a_directory);
  if (error) throw InputError("cannot make the output directory '" + path.string() + "': " + error.message());
}

}  // namespace dygita
