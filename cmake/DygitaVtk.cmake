# VTK: as its own CMake configuration has it; else from headers in DYGITA_VTK_ROOT, where ./run.sh unpacks those of Debian's
# libvtk9-dev without installing it (its dependency python3-vtk9 and ParaView's python3-paraview exclude each other), and the
# libraries that the system has.

set(DYGITA_VTK_ROOT ${CMAKE_SOURCE_DIR}/build/vtk CACHE PATH "Root that VTK's headers are unpacked in, where VTK is not installed for development")
# What files for ParaView are written with, and what these are made of.
set(dygita_vtk_modules IOXML IOXMLParser IOCore CommonExecutionModel CommonDataModel CommonTransforms CommonMath CommonCore sys)

function(dygita_vtk_of_root headers)
  string(REGEX REPLACE ".*/include/vtk-([0-9.]+)$" "\\1" version ${headers})
  add_library(dygita_vtk INTERFACE)
  target_include_directories(dygita_vtk SYSTEM INTERFACE ${headers})
  foreach(module IN LISTS dygita_vtk_modules)
    file(GLOB library /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/libvtk${module}-${version}.so.[0-9]*)
    if(NOT library)
      message(FATAL_ERROR "libvtk${module}-${version}.so is not installed, and VTK's headers in ${headers} need it: ./run.sh build installs both")
    endif()
    list(SORT library)
    list(GET library 0 library)
    target_link_libraries(dygita_vtk INTERFACE ${library})
  endforeach()
  message(STATUS "VTK ${version}: headers in ${headers}")
endfunction()

find_package(VTK QUIET COMPONENTS CommonCore CommonDataModel IOXML)
file(GLOB dygita_vtk_headers ${DYGITA_VTK_ROOT}/usr/include/vtk-9.[0-9]*)
if(NOT VTK_FOUND AND dygita_vtk_headers)
  dygita_vtk_of_root(${dygita_vtk_headers})
else()
  find_package(VTK REQUIRED COMPONENTS CommonCore CommonDataModel IOXML)
  add_library(dygita_vtk INTERFACE)
  target_link_libraries(dygita_vtk INTERFACE VTK::CommonCore VTK::CommonDataModel VTK::IOXML)
endif()
add_library(dygita::vtk ALIAS dygita_vtk)
