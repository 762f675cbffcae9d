# The Lua side travels inside the program: lua/*.lua become one source with a raw string each, so that the program
# runs from anywhere. Included to define dygita_embed_lua; run with -P to write the source.

function(dygita_embed_lua target)
  file(GLOB lua_files CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/lua/*.lua)
  set(source ${CMAKE_BINARY_DIR}/embedded_lua.cpp)
  add_custom_command(OUTPUT ${source}
    COMMAND ${CMAKE_COMMAND} -DFOLDER=${CMAKE_SOURCE_DIR}/lua -DSOURCE=${source}
      -P ${CMAKE_SOURCE_DIR}/cmake/DygitaEmbedLua.cmake
    DEPENDS ${lua_files} ${CMAKE_SOURCE_DIR}/cmake/DygitaEmbedLua.cmake
    VERBATIM)
  target_sources(${target} PRIVATE ${source})
endfunction()

if(CMAKE_SCRIPT_MODE_FILE AND DEFINED SOURCE)
  file(GLOB lua_files ${FOLDER}/*.lua)
  set(entries "")
  foreach(lua_file ${lua_files})
    get_filename_component(name ${lua_file} NAME_WE)
    file(READ ${lua_file} text)
    string(APPEND entries "      {\"${name}\", R\"_lua_(${text})_lua_\"},\n")
  endforeach()
  file(WRITE ${SOURCE}
    "// Written from lua/ at build time.\n#include \"deck/embedded_lua.hpp\"\n\nnamespace dygita {\n\n"
    "const std::map<std::string, std::string>& embedded_lua() {\n"
    "  static const std::map<std::string, std::string> texts = {\n${entries}  };\n  return texts;\n}\n\n}\n")
endif()
