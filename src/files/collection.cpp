#include "files/collection.hpp"

#include "base/log.hpp"
#include "base/markup.hpp"

namespace dygita {

void Collection::add(double time, int part, const std::string& name, const std::filesystem::path& file) {
  // The shortest text that reads back as the same number: no two frames fall together.
  entries_ += fmt::format("    <DataSet timestep=\"{}\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n", time, part,
                          escaped(name), escaped(file.generic_string()));
}

std::string Collection::text() const {
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n" + entries_ +
         "  </Collection>\n</VTKFile>\n";
}

}  // namespace dygita
