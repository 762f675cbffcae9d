#include "base/plain_file.hpp"

#include <spdlog/fmt/fmt.h>

#include <cerrno>
#include <cstring>
#include <fstream>

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

std::string reason_not_written(int error) {
  if (error == EFBIG) return "the file would be larger than this process may write (ulimit -f)";
  return std::strerror(error);
}

}  // namespace dygita
