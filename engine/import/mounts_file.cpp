// SPDX-License-Identifier: MIT
// mounts.toml of a folder of clouds and an IMU.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "base/error.hpp"
#include "base/text.hpp"
#include "base/toml_reader.hpp"
#include "base/unit_quaternion.hpp"
#include "geom/arrays.hpp"
#include "import/pcd_imu_folder.hpp"

namespace hallway::import {
namespace {

/// Errors at the keys of a table of a file.
struct MountKey {
  const std::string& file;
  const std::string& table;
  const TomlEntry& entry;

  Error error(const std::string& message) const {
    return Error(ErrorCode::kBadInput, message,
                 {.file = file,
                  .line = entry.node.line,
                  .element = fmt::format("key {}.{}", table, printable(entry.key, 40))});
  }
};

template <std::size_t kCount>
std::array<double, kCount> numbers_at(const MountKey& key) {
  const auto* list = std::get_if<TomlArray>(&key.entry.node.value);
  if (list == nullptr || list->size() != kCount)
    throw key.error(fmt::format("a list of {} numbers is needed", kCount));
  std::array<double, kCount> numbers{};
  for (std::size_t i = 0; i < kCount; ++i) {
    const TomlNode& node = (*list)[i];
    if (const auto* whole = std::get_if<std::int64_t>(&node.value)) {
      numbers[i] = static_cast<double>(*whole);
    } else if (const auto* number = std::get_if<double>(&node.value)) {
      numbers[i] = *number;
    } else {
      throw key.error(fmt::format("a list of {} numbers is needed; it has {}", kCount, kind_name(node)));
    }
    if (!(std::abs(numbers[i]) <= kMaxImport_m))
      throw key.error(fmt::format("a number is not finite, or beyond {:g}", kMaxImport_m));
  }
  return numbers;
}

Pose mount_of(const std::string& file, const std::string& name, const TomlTable& table) {
  Pose pose;
  for (const TomlEntry& entry : table) {
    const MountKey key{file, name, entry};
    if (entry.key == "position_m") {
      pose.t = to_vec3(numbers_at<3>(key));
    } else if (entry.key == "orientation_wxyz") {
      const auto wxyz = numbers_at<4>(key);
      if (!is_unit_quaternion(wxyz, kUnitFileTolerance))
        throw key.error("the quaternion does not have unit length");
      pose.q = Quat(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).normalized();
    } else {
      throw key.error("there are position_m and orientation_wxyz" +
                      suggestion(entry.key, {"position_m", "orientation_wxyz"}));
    }
  }
  return pose;
}

std::string print_mount_table(const char* name, const Pose& pose) {
  const auto t = to_array(pose.t);
  const auto q = to_array(pose.q);
  return fmt::format("[{}]\nposition_m = [{}, {}, {}]\norientation_wxyz = [{}, {}, {}, {}]\n", name,
                     format_double(t[0]), format_double(t[1]), format_double(t[2]), format_double(q[0]),
                     format_double(q[1]), format_double(q[2]), format_double(q[3]));
}

}  // namespace

RigMounts parse_mounts(std::string_view text, const std::string& file) {
  RigMounts mounts;
  for (const TomlEntry& entry : parse_toml(text, file)) {
    const auto* table = std::get_if<TomlTable>(&entry.node.value);
    if ((entry.key != "lidar" && entry.key != "imu") || table == nullptr) {
      throw Error(ErrorCode::kBadInput,
                  "there are the tables [lidar] and [imu]" + suggestion(entry.key, {"lidar", "imu"}),
                  {.file = file,
                   .line = entry.node.line,
                   .element = fmt::format("key {}", printable(entry.key, 40))});
    }
    (entry.key == "lidar" ? mounts.T_body_lidar : mounts.T_body_imu) = mount_of(file, entry.key, *table);
  }
  return mounts;
}

std::string print_mounts(const RigMounts& mounts) {
  return print_mount_table("lidar", mounts.T_body_lidar) + "\n" + print_mount_table("imu", mounts.T_body_imu);
}

}  // namespace hallway::import
