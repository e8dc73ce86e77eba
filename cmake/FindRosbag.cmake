# SPDX-License-Identifier: MIT
# ROS 1's reader of bags and the messages that are imported, as Debian packages them: librosbag-storage-dev, libsensor-msgs-dev, libnav-msgs-dev,
# libgeometry-msgs-dev. Defines Rosbag::Rosbag and Rosbag_PACKAGE_DIR. Their own CMake and pkg-config files ask for packages that using them does not need.
# Where its plugins are told of: it finds packages of ROS by the folders of ROS_PACKAGE_PATH.
find_path(Rosbag_PACKAGE_DIR encryptor_plugins.xml PATH_SUFFIXES share/rosbag_storage)
find_path(Rosbag_INCLUDE_DIR rosbag/bag.h)
find_path(Rosbag_SENSOR_MSGS_DIR sensor_msgs/PointCloud2.h)
find_path(Rosbag_NAV_MSGS_DIR nav_msgs/Odometry.h)
find_path(Rosbag_GEOMETRY_MSGS_DIR geometry_msgs/PoseStamped.h)
find_path(Rosbag_PLUGINLIB_DIR pluginlib/class_loader.hpp PATH_SUFFIXES pluginlib)
find_path(Rosbag_CLASS_LOADER_DIR class_loader/class_loader.hpp PATH_SUFFIXES class_loader)
find_path(Rosbag_AMENT_INDEX_DIR ament_index_cpp/get_resource.hpp PATH_SUFFIXES ament_index_cpp)
find_path(Rosbag_RCPPUTILS_DIR rcpputils/shared_library.hpp PATH_SUFFIXES rcpputils)
find_path(Rosbag_RCUTILS_DIR rcutils/shared_library.h PATH_SUFFIXES rcutils)
set(Rosbag_VARIABLES Rosbag_INCLUDE_DIR Rosbag_SENSOR_MSGS_DIR Rosbag_NAV_MSGS_DIR Rosbag_GEOMETRY_MSGS_DIR Rosbag_PLUGINLIB_DIR
                     Rosbag_CLASS_LOADER_DIR Rosbag_AMENT_INDEX_DIR Rosbag_RCPPUTILS_DIR Rosbag_RCUTILS_DIR)
set(Rosbag_INCLUDE_DIRS)
foreach(variable ${Rosbag_VARIABLES})
  list(APPEND Rosbag_INCLUDE_DIRS ${${variable}})
endforeach()
list(REMOVE_DUPLICATES Rosbag_INCLUDE_DIRS)
set(Rosbag_LIBRARIES)
foreach(library rosbag_storage roscpp_serialization rostime cpp_common console_bridge)
  find_library(Rosbag_${library}_LIBRARY ${library})
  list(APPEND Rosbag_VARIABLES Rosbag_${library}_LIBRARY)
  list(APPEND Rosbag_LIBRARIES ${Rosbag_${library}_LIBRARY})
endforeach()
list(APPEND Rosbag_VARIABLES Rosbag_PACKAGE_DIR)
mark_as_advanced(${Rosbag_VARIABLES})

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Rosbag REQUIRED_VARS ${Rosbag_VARIABLES})
if(Rosbag_FOUND AND NOT TARGET Rosbag::Rosbag)
  add_library(Rosbag::Rosbag INTERFACE IMPORTED)
  set_target_properties(Rosbag::Rosbag PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${Rosbag_INCLUDE_DIRS}"
                                                  INTERFACE_LINK_LIBRARIES "${Rosbag_LIBRARIES}")
endif()
