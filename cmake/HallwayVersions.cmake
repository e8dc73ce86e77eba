# SPDX-License-Identifier: MIT
# Libraries whose CMake files refuse a newer major version that works as well. The sources' side of each version is in one file of its own
# (engine/trace/embree_library.hpp).

# hallway_find_package(<package> <least version>): any version from there on.
macro(hallway_find_package package least)
  find_package(${package} REQUIRED CONFIG)
  if("${${package}_VERSION}" VERSION_LESS "${least}")
    message(FATAL_ERROR "${package} ${${package}_VERSION} is too old; ${least} is needed")
  endif()
endmacro()

hallway_find_package(Eigen3 3.4)
if(Eigen3_VERSION VERSION_GREATER_EQUAL 4)
  # Eigen 5 wants to be told in the type which singular vectors are asked for, which 3.4 does not know, and calls the way that both know deprecated.
  target_compile_definitions(Eigen3::Eigen INTERFACE EIGEN_NO_DEPRECATED_WARNING)
endif()
hallway_find_package(assimp 5.2)
hallway_find_package(embree 3.13)

add_library(hallway_embree INTERFACE)
target_link_libraries(hallway_embree INTERFACE embree)
string(REGEX MATCH "^[0-9]+" HALLWAY_EMBREE_MAJOR "${embree_VERSION}")
target_compile_definitions(hallway_embree INTERFACE HALLWAY_EMBREE_MAJOR=${HALLWAY_EMBREE_MAJOR})

# Debian's next versions may leave out implicit conversions, as upstream announces: nothing here relies on them.
find_package(nlohmann_json 3.11 REQUIRED)
target_compile_definitions(nlohmann_json::nlohmann_json INTERFACE JSON_USE_IMPLICIT_CONVERSIONS=0)
