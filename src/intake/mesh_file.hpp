// The file to be read, before gmsh sees it: checks, and parameters given to a .geo.
#pragma once

#include "intake/gmsh_reader.hpp"

namespace dygita {

// "geo", "msh", "step" or "brep"; throws InputError for any other extension.
std::string kind_of_file(const std::string& file);

// Throws InputError: kind, file missing or unreadable, unit or size not positive, a parameter in `set` that the file
// does not declare, `size` for a .msh, `set` for anything but a .geo, `unit` against the one that a STEP file states.
void check_options(const GmshOptions& options);

// A temporary .geo that gives parameters their values and includes the file itself: DefineConstant keeps what is
// defined already. gmsh's other ways do not do: -setnumber holds for the rest of the process, onelab needs a `Name` in
// the file.
class ParameterFile {
 public:
  ParameterFile(const std::string& file, const std::map<std::string, double>& parameters);
  ~ParameterFile();
  ParameterFile(const ParameterFile&) = delete;
  ParameterFile& operator=(const ParameterFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace dygita
