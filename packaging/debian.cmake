# SPDX-License-Identifier: MIT
# The Debian packages. Components are packages: hallway, robot, dev. What of ROS 1 may be built is of no package: it would make a robot's program
# depend on ROS.
set(HALLWAY_MAINTAINER "The Hallway authors <authors@hallway.invalid>" CACHE STRING "Who answers for the Debian packages: NAME <ADDRESS>")
set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL hallway robot dev)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGE_CONTACT "${HALLWAY_MAINTAINER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_THREADS 0)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(version "${PROJECT_VERSION}")

# The plugins and the helper in which they run are needed by both programs. They are in the package of the robot's program, which is small and needs
# neither maps nor pictures, so that there are three packages and not four.
set(CPACK_DEBIAN_ROBOT_PACKAGE_NAME hallway-robot)
set(CPACK_DEBIAN_ROBOT_PACKAGE_SECTION science)
set(CPACK_DEBIAN_ROBOT_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_ROBOT_PACKAGE_SUGGESTS hallway)
set(CPACK_DEBIAN_ROBOT_DESCRIPTION "mapping algorithms on a robot
hallway-robot runs mapping algorithms, plugins of Hallway, on a robot. A driver
gives frames of what the sensors see and takes commands, a watchdog stops the
robot when a plugin is late or fails, and what is recorded can be replayed on
another machine to the same bytes.

This package contains the program, drivers for recordings and for a UDP
protocol, and the plugins slam_point, slam_plane, em, icp, wall_follower,
wanderer and dead_reckoning.")

set(CPACK_DEBIAN_HALLWAY_PACKAGE_NAME hallway)
set(CPACK_DEBIAN_HALLWAY_PACKAGE_SECTION science)
set(CPACK_DEBIAN_HALLWAY_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_HALLWAY_PACKAGE_DEPENDS "hallway-robot (= ${version}), fonts-dejavu-core")
# Either renders in software: OSMesa by itself, EGL with Mesa's drivers.
set(CPACK_DEBIAN_HALLWAY_PACKAGE_RECOMMENDS "libosmesa6 | libegl1, libosmesa6 | libgl1-mesa-dri")
set(CPACK_DEBIAN_HALLWAY_PACKAGE_SUGGESTS "hallway-dev (= ${version})")
set(CPACK_DEBIAN_HALLWAY_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_SOURCE_DIR}/prerm)
set(CPACK_DEBIAN_HALLWAY_DESCRIPTION "map editor, simulator and plugin host for mapping algorithms
Hallway is a laboratory for robot mapping algorithms. It edits maps from a
shell, drives a simulated robot through them, runs an algorithm as a plugin on
what the robot sees, compares the result with the truth and draws it. It also
replays recordings of real sensors, and finds planes in point clouds.

This package contains the program hallway, its maps and its documentation.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME hallway-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_RECOMMENDS "cmake, g++ | c++-compiler")
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS hallway)
set(CPACK_DEBIAN_DEV_DESCRIPTION "headers for plugins and drivers of Hallway
Hallway runs mapping algorithms as plugins, on a simulator, on recordings and
on a robot, and reaches robots through drivers.

This package contains the C headers and the C++ headers for both, the CMake
package Hallway, a pkg-config file, and examples. It has no library: a plugin
needs nothing of Hallway when it runs.")

# Installed for a package alone: what Debian wants beside its name.
foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} upper)
  set(package ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  if(NOT package STREQUAL "hallway")
    install(FILES copyright DESTINATION share/doc/${package} COMPONENT ${component} EXCLUDE_FROM_ALL)
  endif()
  install(CODE "set(package ${package})\nset(version ${version})\nset(maintainer \"${HALLWAY_MAINTAINER}\")\nset(source \"${PROJECT_SOURCE_DIR}\")"
          COMPONENT ${component} EXCLUDE_FROM_ALL)
  install(SCRIPT package_files.cmake COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()
include(CPack)
