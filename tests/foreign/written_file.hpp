// A file of a test's own, gone with it.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace dygita {

class WrittenFile {
 public:
  explicit WrittenFile(const std::string& text, const std::string& name = "written.inp") {
    static int n = 0;
    path_ = std::filesystem::temp_directory_path() / fmt_name(n++, name);
    write(text);
  }
  ~WrittenFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  WrittenFile(const WrittenFile&) = delete;
  WrittenFile& operator=(const WrittenFile&) = delete;

  void write(const std::string& text) const { std::ofstream(path_) << text; }
  std::string path() const { return path_.string(); }
  std::string name() const { return path_.filename().string(); }

 private:
  static std::string fmt_name(int n, const std::string& name) {
    return "dygita_" + std::to_string(getpid()) + "_" + std::to_string(n) + "_" + name;
  }
  std::filesystem::path path_;
};

}  // namespace dygita
