#include "files/files.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "base/error.hpp"
#include "base/plain_file.hpp"

namespace dygita {

namespace fs = std::filesystem;

void write_text(const fs::path& path, const std::string& text) {
  const fs::path temporary = path.string() + ".tmp";
  std::error_code error;
  fs::remove(temporary, error);  // a link there would lead to a file of somebody's
  errno = 0;
  std::FILE* file = std::fopen(temporary.c_str(), "wbx");  // new, or not at all
  bool is_good = file && std::fwrite(text.data(), 1, text.size(), file) == text.size();
  int reason = errno;
  if (file && std::fclose(file) != 0 && is_good) is_good = false, reason = errno;
  if (!is_good) {
    fs::remove(temporary, error);
    throw InputError("cannot write '" + path.string() + "': " + reason_not_written(reason));
  }
  fs::rename(temporary, path, error);
  if (error) throw InputError("cannot write '" + path.string() + "': " + error.message());
}

void make_directory(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (!error && !fs::is_directory(path)) error = std::make_error_code(std::errc::not_a_directory);
  if (error) throw InputError("cannot make the output directory '" + path.string() + "': " + error.message());
}

void refuse_links(const fs::path& home, const fs::path& relative) {
  fs::path path = home;
  for (const fs::path& part : relative) {
    path /= part;
    std::error_code ignored;
    if (fs::is_symlink(fs::symlink_status(path, ignored)))
      throw InputError("'" + path.string() + "' is a link, and files would be written where it leads: remove it");
  }
}

}  // namespace dygita
