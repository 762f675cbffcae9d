# Scripts of pages and of ParaView travel inside the program: the files of src/report/embedded/ become one source with raw strings, so
# that they stay files that editors and linters know. Included to define dygita_embed_text; run with -P to write the source.

function(dygita_embed_text target)
  file(GLOB files CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/report/embedded/*)
  set(source ${CMAKE_BINARY_DIR}/embedded_text.cpp)
  add_custom_command(OUTPUT ${source}
    COMMAND ${CMAKE_COMMAND} -DFOLDER=${CMAKE_SOURCE_DIR}/src/report/embedded -DSOURCE=${source}
      -P ${CMAKE_SOURCE_DIR}/cmake/DygitaEmbedText.cmake
    DEPENDS ${files} ${CMAKE_SOURCE_DIR}/cmake/DygitaEmbedText.cmake
    VERBATIM)
  target_sources(${target} PRIVATE ${source})
endfunction()

if(CMAKE_SCRIPT_MODE_FILE AND DEFINED SOURCE)
  file(GLOB files ${FOLDER}/*)
  set(entries "")
  foreach(file ${files})
    get_filename_component(name ${file} NAME)
    file(READ ${file} text)
    string(APPEND entries "      {\"${name}\", R\"_text_(${text})_text_\"},\n")
  endforeach()
  file(WRITE ${SOURCE}
    "// Written from src/report/embedded/ at build time.\n#include \"report/embedded.hpp\"\n\n#include <map>\n\nnamespace dygita {\n\n"
    "const std::string& embedded_text(const std::string& name) {\n"
    "  static const std::map<std::string, std::string> texts = {\n${entries}  };\n  return texts.at(name);\n}\n\n}\n")
endif()
