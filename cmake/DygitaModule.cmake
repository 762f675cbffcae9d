# One library per folder of src/. A module is its folder: a new law is one new file.

# Faster, but the last bits of a result and the program itself then belong to this kind of processor.
option(DYGITA_NATIVE "Compile for the processor at hand (-march=native)" ON)
option(DYGITA_SANITIZE "Stop at memory errors, leaks and undefined behaviour" OFF)
# Without the checks of each dereferenced pointer: the address sanitizer stops there too, and a quarter of the compile time is theirs.
set(dygita_sanitizers -fsanitize=address,undefined -fno-sanitize=null,alignment,object-size,vptr -fno-sanitize-recover=undefined
  -fno-omit-frame-pointer)
option(DYGITA_SANITIZE_THREADS "Stop at data races (clang)" OFF)
# For libFuzzer, which is clang's: with the sanitizers, and every branch counted.
option(DYGITA_FUZZ "Build the programs of tests/fuzz with libFuzzer (clang)" OFF)
if(DYGITA_FUZZ)
  list(APPEND dygita_sanitizers -fsanitize=fuzzer-no-link)
endif()

# g++ 12 sees overruns in Eigen's vectorised small products and in std::string that are not there (its bugs 105329, 106247).
set(dygita_gnu_false_alarms -Wno-uninitialized -Wno-maybe-uninitialized -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow
  -Wno-aggressive-loop-optimizations)

# Eigen, fmt and the standard library's headers are read once for all modules. A compiler cache does the same and more.
option(DYGITA_PRECOMPILED_HEADERS "Read common headers once" ON)
if(CMAKE_CXX_COMPILER_LAUNCHER)
  set(DYGITA_PRECOMPILED_HEADERS OFF)
endif()

# dygita_precompiled_headers(NAME [LIBRARIES ...] HEADERS ...): a set that targets with the same compile options and
# definitions of those libraries take by dygita_take_precompiled_headers(target NAME).
function(dygita_precompiled_headers name)
  cmake_parse_arguments(arg "" "" "LIBRARIES;HEADERS" ${ARGN})
  if(NOT DYGITA_PRECOMPILED_HEADERS)
    return()
  endif()
  set(source ${CMAKE_BINARY_DIR}/precompiled_${name}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "// Carries the precompiled headers '${name}'.\n")
  add_library(dygita_precompiled_${name} OBJECT ${source})
  target_link_libraries(dygita_precompiled_${name} PRIVATE Eigen3::Eigen spdlog::spdlog ${arg_LIBRARIES})
  target_compile_definitions(dygita_precompiled_${name} PRIVATE EIGEN_DONT_PARALLELIZE EIGEN_FAST_MATH=0)
  dygita_target_options(dygita_precompiled_${name})
  target_precompile_headers(dygita_precompiled_${name} PRIVATE ${arg_HEADERS})
endfunction()

function(dygita_take_precompiled_headers target name)
  if(DYGITA_PRECOMPILED_HEADERS)
    target_precompile_headers(${target} REUSE_FROM dygita_precompiled_${name})
  endif()
endfunction()

function(dygita_target_options target)
  # Files compiled in one batch shadow each other's constants, which is no fault of theirs.
  set(shadow -Wshadow)
  if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    set(shadow -Wshadow=local)
  endif()
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic ${shadow} -Wnon-virtual-dtor
    -Woverloaded-virtual "$<$<CXX_COMPILER_ID:GNU>:${dygita_gnu_false_alarms}>"
    $<$<BOOL:${DYGITA_WARNINGS_AS_ERRORS}>:-Werror>)
  target_compile_options(${target} PRIVATE -fopenmp-simd)
  # g++ collects no garbage below 1 GB: a twelfth less time for a fifth more memory, the same objects.
  target_compile_options(${target} PRIVATE "$<$<CXX_COMPILER_ID:GNU>:SHELL:--param ggc-min-heapsize=1000000>")
  target_link_libraries(${target} PRIVATE Threads::Threads)
  if(DYGITA_NATIVE)
    target_compile_options(${target} PRIVATE -march=native)
  endif()
  if(DYGITA_SANITIZE)
    target_compile_options(${target} PRIVATE ${dygita_sanitizers})
    target_link_options(${target} PRIVATE ${dygita_sanitizers})
  endif()
  if(DYGITA_SANITIZE_THREADS)
    target_compile_options(${target} PRIVATE -fsanitize=thread -fno-omit-frame-pointer)
    target_link_options(${target} PRIVATE -fsanitize=thread)
  endif()
endfunction()

# What computes little and waits for files, users and libraries: optimised less, it compiles in two thirds of the time.
function(dygita_optimise_less target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

set(dygita_common_headers <Eigen/Core> <Eigen/Geometry> <Eigen/LU> <Eigen/SparseCore> <spdlog/fmt/fmt.h> <algorithm>
  <array> <cmath> <filesystem> <functional> <map> <memory> <optional> <string> <unordered_map> <variant> <vector>)
dygita_precompiled_headers(engine HEADERS ${dygita_common_headers})
dygita_precompiled_headers(json HEADERS ${dygita_common_headers} <nlohmann/json.hpp>)

# dygita_module(NAME [COLD] DEPENDS lower modules... PRIVATE_LIBRARIES third-party libraries nobody above may name)
function(dygita_module name)
  cmake_parse_arguments(arg "COLD" "" "DEPENDS;PRIVATE_LIBRARIES" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/src/${name}/*.cpp)
  add_library(dygita_${name} STATIC ${sources})
  target_include_directories(dygita_${name} PUBLIC ${CMAKE_SOURCE_DIR}/src)
  list(TRANSFORM arg_DEPENDS PREPEND dygita_)
  target_link_libraries(dygita_${name}
    PUBLIC ${arg_DEPENDS} Eigen3::Eigen spdlog::spdlog PRIVATE ${arg_PRIVATE_LIBRARIES})
  target_compile_definitions(dygita_${name} PUBLIC EIGEN_DONT_PARALLELIZE EIGEN_FAST_MATH=0)
  dygita_target_options(dygita_${name})
  if(arg_COLD)
    dygita_optimise_less(dygita_${name})
  endif()
  if("nlohmann_json::nlohmann_json" IN_LIST arg_PRIVATE_LIBRARIES)
    dygita_take_precompiled_headers(dygita_${name} json)
  else()
    dygita_take_precompiled_headers(dygita_${name} engine)
  endif()
endfunction()
