// A file that is closed with its owner.
#pragma once

#include <cstdio>
#include <memory>

namespace dygita {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using OpenFile = std::unique_ptr<std::FILE, CloseFile>;

}  // namespace dygita
