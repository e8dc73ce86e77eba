# SPDX-License-Identifier: MIT
# hallway_add_library(<name> SOURCES a.cpp … [APART a.cpp …] [LINKS …] [PRIVATE_LINKS …] [PRECOMPILED target])
#
# One engine library: target hallway_<name>, included as "<name>/….hpp". LINKS are the libraries to its left in
# docs/architecture.md and whatever its headers expose; PRIVATE_LINKS are what only its sources use. APART: see hallway_compile_together.
#
# With HALLWAY_PRECOMPILE the headers that nearly every source includes are read once. They are no substitute for includes: the clang preset builds
# all but the tests without.
set(HALLWAY_PRECOMPILE ON CACHE STRING "Precompile Eigen and the common standard headers: ON, OFF, TESTS for the tests alone")

# hallway_is_on(<setting> <target> <result>): whether a setting that is ON, OFF or TESTS holds for the target.
function(hallway_is_on setting target result)
  if("${${setting}}" STREQUAL "TESTS")
    string(REGEX MATCH "^test_|_test_precompiled$" on ${target})
  else()
    set(on ${${setting}})
  endif()
  set(${result} "${on}" PARENT_SCOPE)
endfunction()

# hallway_precompile(<target> LIBRARY|EXECUTABLE …headers [LINKS …]): the headers as one precompiled header that other targets of that kind may reuse (the
# two differ in how they address code: -fPIC and -fPIE). LINKS: the libraries that it and those targets link; by default what nearly all link.
function(hallway_precompile target kind)
  hallway_is_on(HALLWAY_PRECOMPILE ${target} precompile)
  if(NOT precompile OR HALLWAY_FUZZ)
    return()
  endif()
  cmake_parse_arguments(arg "" "" "LINKS" ${ARGN})
  if(NOT arg_LINKS)
    set(arg_LINKS fmt::fmt Eigen3::Eigen Threads::Threads)
  endif()
  set(source ${CMAKE_BINARY_DIR}/precompiled/${target}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "")
  add_library(${target} OBJECT ${source})  # which nobody links: CMake ties a precompiled header to a target with a source
  if(kind STREQUAL EXECUTABLE)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
    target_compile_options(${target} PRIVATE ${CMAKE_CXX_COMPILE_OPTIONS_PIE})
  endif()
  if("<nlohmann/json.hpp>" IN_LIST arg_UNPARSED_ARGUMENTS)
    list(APPEND arg_LINKS nlohmann_json::nlohmann_json)  # its users are compiled with the same definitions
  endif()
  target_link_libraries(${target} PRIVATE ${arg_LINKS})
  set_target_properties(${target} PROPERTIES HALLWAY_LINKS "${arg_LINKS}")
  target_precompile_headers(${target} PRIVATE ${arg_UNPARSED_ARGUMENTS})
endfunction()

# hallway_reuse_precompiled(<target> <owner>): the target reads the owner's precompiled header, if there is one.
function(hallway_reuse_precompiled target owner)
  if(TARGET ${owner})
    get_target_property(links ${owner} HALLWAY_LINKS)
    target_link_libraries(${target} PRIVATE ${links})
    target_precompile_headers(${target} REUSE_FROM ${owner})
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      # g++ 12 forgets that precompiled code is a system's, and reports reads in the inlined string class that do not happen.
      target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread)
    endif()
  endif()
endfunction()

# hallway_compile_quickly(<target>): less optimization for code whose speed does not matter: the command line, the editor, and tests of code that is
# itself fast. What headers define is linked once, perhaps as compiled here: so such code is never left without any. Newer g++ read a precompiled header
# only where the machine's options agree, some of which -O2 sets and -O1 does not: they are set here for x86-64, and elsewhere -O2 stays.
function(hallway_compile_quickly target)
  if(NOT TARGET ${target})
    return()
  endif()
  set(optimization -O1)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
    if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
      list(APPEND optimization -munroll-only-small-loops -mvzeroupper)
    else()
      return()
    endif()
  endif()
  foreach(option IN LISTS optimization)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:${option}>)
  endforeach()
endfunction()

# hallway_compile_fast(<target>): more optimization, for algorithms whose time is measured.
function(hallway_compile_fast target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O3>)
endfunction()

# hallway_compile_plainly(<target>): no optimization at all, for tests.
function(hallway_compile_plainly target)
  if(TARGET ${target})
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O0>)
  endif()
endfunction()

# hallway_compile_together(<target> [APART a.cpp …]): up to eight sources are read as one, so that the templates that they share are made once. It is no
# substitute for includes either: the clang preset compiles each by itself, but for the tests. APART names sources that stand alone, because they define
# names of their own that others define too.
set(HALLWAY_TOGETHER ON CACHE STRING "Compile several sources of a target at once: ON, OFF, TESTS for the tests alone")
function(hallway_compile_together target)
  cmake_parse_arguments(arg "" "" "APART" ${ARGN})
  hallway_is_on(HALLWAY_TOGETHER ${target} together)
  if(together AND TARGET ${target})
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    if(arg_APART)
      set_source_files_properties(${arg_APART} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endif()
endfunction()

function(hallway_add_library name)
  cmake_parse_arguments(arg "" "PRECOMPILED" "SOURCES;APART;LINKS;PRIVATE_LINKS" ${ARGN})
  if(NOT arg_PRECOMPILED)
    set(arg_PRECOMPILED hallway_precompiled)
  endif()
  add_library(hallway_${name} STATIC ${arg_SOURCES})
  target_include_directories(hallway_${name} PUBLIC ${PROJECT_SOURCE_DIR}/engine)
  target_link_libraries(hallway_${name} PUBLIC ${arg_LINKS} PRIVATE ${arg_PRIVATE_LINKS})
  hallway_reuse_precompiled(hallway_${name} ${arg_PRECOMPILED})
  hallway_compile_together(hallway_${name} APART ${arg_APART})
endfunction()
