#include "intake/mesh_file.hpp"

#include <spdlog/fmt/fmt.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "base/error.hpp"
#include "base/names.hpp"
#include "intake/file_text.hpp"

namespace dygita {

namespace {

namespace fs = std::filesystem;

void check_file(const std::string& file) {
  if (!fs::exists(file))
    throw InputError(fmt::format("mesh file '{}' does not exist (looked for {})", file,
                                 fs::absolute(file).lexically_normal().string()));
  if (!fs::is_regular_file(file) || access(file.c_str(), R_OK) != 0)
    throw InputError(fmt::format("mesh file '{}' cannot be read", file));
}

void check_geo(const GmshOptions& options) {
  if (kind_of_file(options.file) != "geo") {
    if (options.set.empty()) return;
    throw InputError(fmt::format("mesh file '{}': 'set' applies only to the parameters of a .geo", options.file));
  }
  const GeoFacts facts = geo_facts(options.file);
  if (!facts.unfinished.empty())
    throw InputError(fmt::format("mesh file '{}' does not end with a newline: gmsh would ignore its last line",
                                 facts.unfinished.front()));
  const std::vector<std::string>& known = facts.parameters;
  for (const auto& [name, value] : options.set) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(fmt::format("mesh file '{}' has no parameter '{}' (DefineConstant)\n    {}", options.file, name,
                                   did_you_mean(name, known)));
    if (!std::isfinite(value))
      throw InputError(fmt::format("mesh file '{}': parameter '{}' must be finite", options.file, name));
  }
}

void check_lengths(const GmshOptions& options) {
  const std::string kind = kind_of_file(options.file);
  if (!(options.unit > 0) || !std::isfinite(options.unit))
    throw InputError(fmt::format("mesh file '{}': unit must be positive, not {:g} m", options.file, options.unit));
  if (options.size && (!(*options.size > 0) || !std::isfinite(*options.size)))
    throw InputError(fmt::format("mesh file '{}': size must be positive, not {:g} m", options.file, *options.size));
  if (options.size && kind == "msh")
    throw InputError(
        fmt::format("mesh file '{}': 'size' does not apply to a .msh, which is already meshed", options.file));
  if (options.order > 1 && kind == "msh")
    throw InputError(
        fmt::format("mesh file '{}': 'order' does not apply to a .msh, whose cells have a fixed order", options.file));
  const std::optional<double> stated = kind == "step" ? step_unit(options.file) : std::nullopt;
  if (stated && options.unit != 1 && std::abs(options.unit / *stated - 1) > 1e-9)
    throw InputError(fmt::format("mesh file '{}' states its unit, {:g} m, but 'unit' is {:g} m", options.file, *stated,
                                 options.unit));
}

}  // namespace

std::string kind_of_file(const std::string& file) {
  std::string kind = fs::path(file).extension().string();
  for (char& c : kind) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (kind == ".stp") kind = ".step";
  if (kind != ".geo" && kind != ".msh" && kind != ".step" && kind != ".brep")
    throw InputError(fmt::format("mesh file '{}': known kinds are .geo, .msh, .step (or .stp) and .brep", file));
  return kind.substr(1);
}

void check_options(const GmshOptions& options) {
  kind_of_file(options.file);
  check_file(options.file);
  check_geo(options);
  check_lengths(options);
}

ParameterFile::ParameterFile(const std::string& file, const std::map<std::string, double>& parameters) {
  path_ = (fs::temp_directory_path() / "dygita-XXXXXX.geo").string();
  const int descriptor = mkstemps(path_.data(), 4);
  if (descriptor < 0) throw InputError(fmt::format("cannot write to {}", fs::temp_directory_path().string()));
  close(descriptor);
  std::ofstream stream(path_);
  for (const auto& [name, value] : parameters) stream << fmt::format("{} = {:.17g};\n", name, value);
  stream << fmt::format("Include \"{}\";\n", fs::absolute(file).lexically_normal().string());
}

ParameterFile::~ParameterFile() {
  std::error_code ignored;
  fs::remove(path_, ignored);
}

}  // namespace dygita
