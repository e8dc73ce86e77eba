# SPDX-License-Identifier: MIT
# hallway_add_plugin(<name> SOURCES a.cpp … [LINKS …])
#
# A plugin library: <name>.so, in HALLWAY_PLUGIN_OUTPUT_DIRECTORY if that is set. It links hallway::sdk and LINKS, and shows
# one symbol, hw_entry: whatever else it is made of stays its own, so that two plugins may contain two versions of one
# library. Static libraries in LINKS must be position independent.
set(HALLWAY_PLUGIN_VERSION_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/plugin.map)

function(hallway_add_plugin name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINKS" ${ARGN})
  if(NOT arg_SOURCES)
    message(FATAL_ERROR "hallway_add_plugin(${name}): SOURCES are missing")
  endif()
  add_library(${name} MODULE ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LINKS} hallway::sdk)
  set_target_properties(${name} PROPERTIES
    PREFIX "" SUFFIX ".so"
    C_VISIBILITY_PRESET hidden CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
    POSITION_INDEPENDENT_CODE ON)
  if(HALLWAY_PLUGIN_OUTPUT_DIRECTORY)
    set_target_properties(${name} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${HALLWAY_PLUGIN_OUTPUT_DIRECTORY})
  endif()

  target_link_options(${name} PRIVATE -Wl,--version-script=${HALLWAY_PLUGIN_VERSION_SCRIPT})
  set_property(TARGET ${name} APPEND PROPERTY LINK_DEPENDS ${HALLWAY_PLUGIN_VERSION_SCRIPT})

  # A plugin must bring everything it needs. Under clang's sanitizers the run-time library stands in the executable alone,
  # which the linker cannot see.
  set(flags "${CMAKE_C_FLAGS} ${CMAKE_CXX_FLAGS} ${HALLWAY_SANITIZE}")
  if(NOT (CMAKE_CXX_COMPILER_ID MATCHES "Clang" AND (HALLWAY_SANITIZE OR flags MATCHES "-fsanitize")))
    target_link_options(${name} PRIVATE -Wl,-z,defs)
  endif()
  # Unique symbols would be shared with other plugins, and would keep the library from ever being unloaded.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${name} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-fno-gnu-unique>)
  endif()
endfunction()
