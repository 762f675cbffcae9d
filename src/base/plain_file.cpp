#include "base/plain_file.hpp"

#include "base/error.hpp"

namespace dygita {

namespace fs = std::filesystem;

bool is_no_file(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return fs::exists(status) && !fs::is_regular_file(status);
}

void require_file(const fs::path& path) {
  if (is_no_file(path)) throw InputError("'" + path.string() + "' is a pipe, a device or a folder, not a file");
}

}  // namespace dygita
