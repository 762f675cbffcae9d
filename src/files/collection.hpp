// ParaView's list of files over time (.pvd).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace dygita {

class Collection {
 public:
  // `time` strictly increases from frame to frame (equal for the parts of one frame); `file` is relative to the .pvd.
  void add(double time, int part, const std::string& name, const std::filesystem::path& file);

  std::string text() const;
  bool is_empty() const { return entries_.empty(); }

 private:
  std::string entries_;
};

}  // namespace dygita
