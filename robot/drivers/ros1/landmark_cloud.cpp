// SPDX-License-Identifier: MIT
#include "ros1/landmark_cloud.hpp"

#include <sensor_msgs/PointField.h>

#include <cstring>

namespace hallway::ros1 {
namespace {

using sensor_msgs::PointField;

/// A point of the cloud as it stands in the message.
struct CloudPoint {
  float x = 0, y = 0, z = 0;
  std::uint32_t id = 0, id_high = 0;
  std::uint32_t observations = 0;
  std::uint8_t status = 0;
  std::uint8_t unused[3] = {};
};
static_assert(sizeof(CloudPoint) == 28);

PointField field(const char* name, std::size_t offset, std::uint8_t datatype) {
  PointField result;
  result.name = name;
  result.offset = static_cast<std::uint32_t>(offset);
  result.datatype = datatype;
  result.count = 1;
  return result;
}

CloudPoint point_of(const hw_landmark_t& landmark) {
  CloudPoint point;
  point.x = static_cast<float>(landmark.position[0]);
  point.y = static_cast<float>(landmark.position[1]);
  point.z = static_cast<float>(landmark.position[2]);
  point.id = static_cast<std::uint32_t>(landmark.id & 0xffffffffu);
  point.id_high = static_cast<std::uint32_t>(landmark.id >> 32);
  point.observations = landmark.observations;
  point.status = static_cast<std::uint8_t>(landmark.status);
  return point;
}

}  // namespace

sensor_msgs::PointCloud2 landmark_cloud(const hw_landmarks_t& landmarks) {
  sensor_msgs::PointCloud2 cloud;
  cloud.fields = {field("x", offsetof(CloudPoint, x), PointField::FLOAT32),
                  field("y", offsetof(CloudPoint, y), PointField::FLOAT32),
                  field("z", offsetof(CloudPoint, z), PointField::FLOAT32),
                  field("id", offsetof(CloudPoint, id), PointField::UINT32),
                  field("id_high", offsetof(CloudPoint, id_high), PointField::UINT32),
                  field("observations", offsetof(CloudPoint, observations), PointField::UINT32),
                  field("status", offsetof(CloudPoint, status), PointField::UINT8)};
  cloud.is_bigendian = 0;
  cloud.is_dense = true;
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(landmarks.count);
  cloud.point_step = sizeof(CloudPoint);
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.data.resize(landmarks.count * sizeof(CloudPoint));
  const char* at = static_cast<const char*>(landmarks.landmarks);
  for (std::uint64_t i = 0; i < landmarks.count; ++i, at += landmarks.stride) {
    hw_landmark_t landmark;
    std::memcpy(&landmark, at, sizeof landmark);
    const CloudPoint point = point_of(landmark);
    std::memcpy(cloud.data.data() + i * sizeof point, &point, sizeof point);
  }
  return cloud;
}

}  // namespace hallway::ros1
