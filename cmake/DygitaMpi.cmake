# Runs on several ranks need MPI (libopenmpi-dev); a build without it runs on one and lacks nothing else.
set(DYGITA_MPI AUTO CACHE STRING "Runs on several ranks: ON, OFF, or AUTO where MPI is found")
set_property(CACHE DYGITA_MPI PROPERTY STRINGS AUTO ON OFF)

# dygita_mpi(target): the one module that names MPI.
function(dygita_mpi target)
  if(NOT DYGITA_MPI)
    return()
  endif()
  if(DYGITA_MPI STREQUAL "AUTO")
    find_package(MPI QUIET COMPONENTS CXX)
  else()
    find_package(MPI REQUIRED COMPONENTS CXX)
  endif()
  if(NOT MPI_CXX_FOUND)
    message(STATUS "MPI was not found: runs on one rank only (libopenmpi-dev)")
    return()
  endif()
  # The C interface alone.
  target_compile_definitions(${target} PRIVATE DYGITA_HAS_MPI OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
  target_link_libraries(${target} PRIVATE MPI::MPI_CXX)
  set(DYGITA_MPIRUN ${MPIEXEC_EXECUTABLE} CACHE INTERNAL "Where MPI is part of the build: what starts several ranks")
endfunction()
