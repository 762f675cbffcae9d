# The view.py of a small run in pvpython, where there is one and something to draw on.
# Where there is no display view.py starts Xvfb by itself.
# cmake -DDYGITA=program -DSOURCE_DIR=folder -DPVPYTHON=program -DXVFB=program -P in_paraview.cmake

if(NOT PVPYTHON OR NOT EXISTS "${PVPYTHON}")
  message("SKIPPED: no pvpython here (Debian: apt-get install paraview python3-paraview)")
  return()
endif()
if("$ENV{DISPLAY}" STREQUAL "" AND (NOT XVFB OR NOT EXISTS "${XVFB}"))
  message("SKIPPED: no display and no Xvfb for pvpython to draw on (Debian: apt-get install xvfb)")
  return()
endif()
set(out ${CMAKE_CURRENT_BINARY_DIR}/in_paraview_out)
file(REMOVE_RECURSE ${out})
execute_process(COMMAND ${DYGITA} run ${SOURCE_DIR}/tests/report/deck.lua --quiet --out ${out} RESULT_VARIABLE code ERROR_VARIABLE error OUTPUT_QUIET)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "dygita run: exit code ${code}\n${error}")
endif()
execute_process(COMMAND ${PVPYTHON} ${SOURCE_DIR}/tests/report/in_paraview.py ${out}/page/base ${out}/view.png
  RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE error TIMEOUT 200)
if(NOT code EQUAL 0 OR NOT output MATCHES "view.py is as it should be")
  message(FATAL_ERROR "pvpython: exit code ${code}\n${output}${error}")
endif()
file(REMOVE_RECURSE ${out})
