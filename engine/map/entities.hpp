// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/se3.hpp"
#include "map/document.hpp"

namespace hallway::map {

/// Entity `hw_robot_start`: where a robot stands at first.
struct RobotStart {
  std::string name{};  ///< empty for the unnamed one, which is the default
  Pose T_world_body;   ///< level, turned by `angle` about z
  int entity = 0;      ///< index in Document::entities
  int line = 0;
};

/// How the moving points of a cloud move: each on a way of its own, or in groups that keep their shape.
enum class CloudMotion { kIndependent, kGroup };

/// Entity `hw_landmark_cloud`: points scattered along a path.
struct LandmarkCloud {
  std::string name;
  std::string path;         ///< name of the hw_path
  double per_100m = 0.0;    ///< points on 100 m of path
  double sideways_m = 0.0;  ///< largest distance to either side of the path, level
  double height_m = 0.0;    ///< largest distance above and below the path
  std::uint64_t seed = 0;
  double moving_share = 0.0;  ///< of its points, how many move: 0 to 1
  double speed_m_s = 0.0;     ///< of those, root mean square over time
  CloudMotion motion = CloudMotion::kIndependent;
  std::uint32_t groups = 0;  ///< how many groups they move in
  int entity = 0;
  int line = 0;
};

/// Keys `_points_per_m2` and `_point_seed` of worldspawn: points scattered on the brushes' faces.
struct FacePoints {
  double per_m2 = 0.0;  ///< 0 where the map has none
  std::uint64_t seed = 0;
};

/// A name that no robot start may have: scenarios mean any free place by it.
inline constexpr std::string_view kFreeStart = "free";

/// All robot starts in the order of the file. Throws Error{kBadInput} for two unnamed ones, two of one name, or a bad key.
std::vector<RobotStart> robot_starts(const Document& document);

/// The start of a robot that is given none: the only start, or the unnamed one among others. None where the map has no start, or several
/// that are all named. Throws as robot_starts() does.
std::optional<RobotStart> default_robot_start(const Document& document);

/// The start of that name; by an empty name the default. None only where no name is given and the map has no start at all. Throws
/// Error{kBadInput} with the starts there are for a name that no start has, and where no name is given and several starts have one each; and
/// as robot_starts() does.
std::optional<RobotStart> find_robot_start(const Document& document, std::string_view name = {});

/// All clouds in the order of the file. Throws Error{kBadInput} for a bad key or two clouds of one name; whether the path
/// exists is find_path()'s to say.
std::vector<LandmarkCloud> landmark_clouds(const Document& document);

/// Throws Error{kBadInput} for a value that is negative or no number.
FacePoints face_points(const Document& document);

}  // namespace hallway::map
