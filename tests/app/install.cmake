# `cmake --install` puts everything in its place, and the program runs from there: cmake -DBUILD_DIR=folder
# -DZSH_COMPLETIONS=folder -P install.cmake

set(prefix ${CMAKE_CURRENT_BINARY_DIR}/install_out)
file(REMOVE_RECURSE ${prefix})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix} RESULT_VARIABLE code OUTPUT_QUIET ERROR_VARIABLE error)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "cmake --install: exit code ${code}\n${error}")
endif()
foreach(file bin/dygita share/man/man1/dygita.1 share/bash-completion/completions/dygita ${ZSH_COMPLETIONS}/_dygita
    share/fish/vendor_completions.d/dygita.fish share/dygita/editor/dygita.lua share/dygita/decks/crush.lua share/dygita/decks/verification/patch.lua
    share/dygita/meshes share/doc/dygita/README.md share/doc/dygita/LICENSE share/doc/dygita/copyright
    share/doc/dygita/CHANGELOG.md share/doc/dygita/CITATION.cff share/doc/dygita/manual/index.md
    share/doc/dygita/manual/pictures/bolted_flanges.png share/doc/dygita/manual/bar.lua)
  if(NOT EXISTS ${prefix}/${file})
    message(SEND_ERROR "not installed: ${file}")
  endif()
endforeach()
file(GLOB_RECURSE scripts ${prefix}/*.py ${prefix}/*.cpp)
if(scripts)
  message(SEND_ERROR "installed, and nobody's business: ${scripts}")
endif()

# From a folder that is not the sources', with a mesh of gmsh.
foreach(deck crush verification/patch bolted_flanges)
  execute_process(COMMAND ${prefix}/bin/dygita check ${prefix}/share/dygita/decks/${deck}.lua --quiet WORKING_DIRECTORY ${prefix}
    RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE error)
  if(NOT code EQUAL 0 OR NOT output MATCHES "nothing was solved")
    message(SEND_ERROR "dygita check of the installed ${deck}.lua: exit code ${code}\n${output}${error}")
  endif()
endforeach()
