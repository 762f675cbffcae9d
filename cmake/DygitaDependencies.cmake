# Every library comes from a Debian package. gmsh, CHOLMOD, METIS, OpenBLAS and Lua's C++ build
# ship no CMake configuration there: they are found by header and library name.

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(spdlog REQUIRED)
find_package(CLI11 REQUIRED)
find_package(Threads REQUIRED)
find_package(nlohmann_json REQUIRED)
include(DygitaVtk)

function(dygita_find_library name header library package)
  cmake_parse_arguments(arg "" "" "SUFFIXES" ${ARGN})
  find_path(DYGITA_${name}_INCLUDE ${header} PATH_SUFFIXES ${arg_SUFFIXES} REQUIRED)
  find_library(DYGITA_${name}_LIBRARY ${library} REQUIRED)
  add_library(dygita::${name} UNKNOWN IMPORTED GLOBAL)
  set_target_properties(dygita::${name} PROPERTIES
    IMPORTED_LOCATION ${DYGITA_${name}_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${DYGITA_${name}_INCLUDE})
endfunction()

dygita_find_library(cholmod cholmod.h cholmod libsuitesparse-dev SUFFIXES suitesparse)
dygita_find_library(suitesparseconfig SuiteSparse_config.h suitesparseconfig libsuitesparse-dev SUFFIXES suitesparse)
dygita_find_library(metis metis.h metis libmetis-dev)
dygita_find_library(gmsh gmsh.h gmsh libgmsh-dev)
dygita_find_library(seccomp seccomp.h seccomp libseccomp-dev)
# Lua's C++ build only: with the C build a Lua error would skip destructors.
dygita_find_library(lua lua.hpp lua5.4-c++ liblua5.4-dev SUFFIXES lua5.4)
dygita_find_library(openblas cblas.h openblas libopenblas-dev
  SUFFIXES openblas-pthread openblas ${CMAKE_LIBRARY_ARCHITECTURE}/openblas-pthread x86_64-linux-gnu/openblas-pthread)
