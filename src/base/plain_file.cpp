#include "base/plain_file.hpp"

#include <spdlog/fmt/fmt.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <vector>

#include "base/error.hpp"

namespace dygita {

namespace fs = std::filesystem;

namespace {

constexpr double megabyte = 1 << 20;

double& file_limit() {
  static double limit = 1024.0 * megabyte;
  return limit;
}

}  // namespace

bool is_no_file(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return fs::exists(status) && !fs::is_regular_file(status);
}

void require_file(const fs::path& path) {
  if (is_no_file(path)) throw InputError("'" + path.string() + "' is a pipe, a device or a folder, not a file");
}

void set_file_limit(double bytes) { file_limit() = bytes; }

void require_readable(const fs::path& path) {
  require_file(path);
  std::error_code error;
  const auto size = static_cast<double>(fs::file_size(path, error));
  if (error || size <= file_limit()) return;
  throw InputError(
      fmt::format("the file '{}' has {:.4g} MB; the limit is {:.4g} MB\n    --memory-limit raises the limit",
                  path.string(), size / megabyte, file_limit() / megabyte));
}

std::string text_of_file(const std::string& file) {
  require_readable(file);
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  if (error || !stream) throw InputError(fmt::format("cannot read the file '{}'", file));
  std::string text(size, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(size));
  if (!stream) throw InputError(fmt::format("cannot read the file '{}'", file));
  return text;
}

void remove_parts(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (fs::is_directory(fs::symlink_status(folder, error))) {
    std::vector<fs::path> parts;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
      const std::string name = entry.path().filename().string();
      if (name.find_first_not_of("0123456789") == std::string::npos && !fs::is_directory(entry.symlink_status(error)))
        parts.push_back(entry.path());
    }
    for (const fs::path& part : parts) fs::remove(part, error);
  } else if (!fs::is_symlink(fs::symlink_status(folder, error))) {
    return;
  }
  fs::remove(folder, error);  // fails, as it should, if not empty
}

std::string reason_not_written(int error) {
  if (error == EFBIG) return "the file would be larger than this process may write (ulimit -f)";
  return std::strerror(error);
}

}  // namespace dygita
