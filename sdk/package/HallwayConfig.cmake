# SPDX-License-Identifier: MIT
# find_package(Hallway) gives the target hallway::sdk, the headers that a plugin is made from, and the function hallway_add_plugin().
include(${CMAKE_CURRENT_LIST_DIR}/HallwayTargets.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/HallwayPlugin.cmake)
