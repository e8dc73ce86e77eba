# SPDX-License-Identifier: MIT
# hallway_add_library(<name> SOURCES a.cpp … [LINKS …] [PRIVATE_LINKS …])
#
# One engine library: target hallway_<name>, included as "<name>/….hpp". LINKS are the libraries to its left in
# docs/architecture.md and whatever its headers expose; PRIVATE_LINKS are what only its sources use.
function(hallway_add_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  add_library(hallway_${name} STATIC ${arg_SOURCES})
  target_include_directories(hallway_${name} PUBLIC ${PROJECT_SOURCE_DIR}/engine)
  target_link_libraries(hallway_${name} PUBLIC ${arg_LINKS} PRIVATE ${arg_PRIVATE_LINKS})
endfunction()
