// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/output.h>
#include <sensor_msgs/PointCloud2.h>

namespace hallway::ros1 {

/// The landmarks as a cloud that RViz and PCL show: x, y, z (float32, map frame, metres), id and id_high (uint32: the lower and the upper half of
/// the id), observations (uint32), status (uint8, HW_LANDMARK_…). The header is left empty.
sensor_msgs::PointCloud2 landmark_cloud(const hw_landmarks_t& landmarks);

}  // namespace hallway::ros1
