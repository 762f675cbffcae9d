# A table with one entry for each file of a folder: src/<module>/<folder>/*.cpp each define
# `Entry <folder>::<file name>()`, and the function `table()` that lists them is written here. A file that lacks its
# entry does not link; nothing registers itself, so a static library drops nothing.
#
# dygita_table(law laws LawEntry law_table law/law.hpp)
function(dygita_table module folder entry table header)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/${module}/${folder}/*.cpp)
  set(declarations "")
  set(calls "")
  foreach(source ${sources})
    get_filename_component(name ${source} NAME_WE)
    string(APPEND declarations "${entry} ${name}();\n")
    string(APPEND calls "${folder}::${name}(), ")
  endforeach()
  set(written ${CMAKE_BINARY_DIR}/${table}.cpp)
  file(CONFIGURE OUTPUT ${written} @ONLY CONTENT "// Written by CMake from src/${module}/${folder}/.
#include \"${header}\"

namespace dygita {

namespace ${folder} {
${declarations}}

const std::vector<${entry}>& ${table}() {
  static const std::vector<${entry}> entries = {${calls}};
  return entries;
}

}
")
  target_sources(dygita_${module} PRIVATE ${sources} ${written})
endfunction()
