// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/se3.hpp"

namespace hallway::slam_point {

using Mat6 = Eigen::Matrix<double, 6, 6>;

/// Adds a * b^T to `sum`. Written by pairs of rows, which a register holds, because it stands in the innermost loops: of the product as a
/// whole Eigen makes a call and a copy. (always_inline, here and elsewhere: in a long source compilers cease to inline even what is called once a point.)
[[gnu::always_inline]] inline void add_outer(const Vec3& a, const Vec3& b, Mat3& sum) {
  for (int column = 0; column < 3; ++column) {
    sum.col(column).head<2>() += a.head<2>() * b[column];
    sum(2, column) += a[2] * b[column];
  }
}

/// The pose with no zero of negative sign, so that what is printed of it does not depend on rounding.
inline Pose without_negative_zeros(const Pose& pose) {
  Pose positive;
  positive.t = pose.t + Vec3::Zero();
  positive.q.coeffs() = pose.q.coeffs() + Eigen::Vector4d::Zero();
  return positive;
}

/// A pose as a matrix, to move many points by; written as add_outer() is.
class PointMotion {
 public:
  explicit PointMotion(const Pose& pose) : rotation_(pose.q.toRotationMatrix()), t_(pose.t) {}

  [[gnu::always_inline]] Vec3 operator*(const Vec3& p) const { return turned(p) + t_; }
  /// The rotation alone.
  [[gnu::always_inline]] Vec3 turned(const Vec3& p) const {
    Vec3 turned;
    turned.head<2>() = rotation_.col(0).head<2>() * p[0] + rotation_.col(1).head<2>() * p[1] +
                       rotation_.col(2).head<2>() * p[2];
    turned[2] = rotation_(2, 0) * p[0] + rotation_(2, 1) * p[1] + rotation_(2, 2) * p[2];
    return turned;
  }

 private:
  Mat3 rotation_;
  Vec3 t_;
};

/// Names one landmark for the life of a mapper; numbered from 0 in the order of first observation.
using LandmarkId = std::uint64_t;
/// "This observation belongs to no landmark."
inline constexpr LandmarkId kNoLandmark = ~std::uint64_t{0};

/// Names one point of the world for as long as the sensor itself follows it from frame to frame.
using TrackId = std::uint64_t;
/// "The sensor does not follow this point."
inline constexpr TrackId kNoTrack = ~std::uint64_t{0};

/// How far a landmark is trusted; `dynamic`: it moves.
enum class LandmarkStatus { temporary, mapped, dynamic };

/// One point of the map.
struct Landmark {
  LandmarkId id = kNoLandmark;
  Vec3 position = Vec3::Zero();    ///< map frame [m]; of one that moves: where it was last seen
  std::uint32_t observations = 0;  ///< how many observations its position averages
  LandmarkStatus status = LandmarkStatus::temporary;  ///< mapped from Options::min_observations on
  /// Of its position's error relative to the map as a whole [m^2]: see RefinedMap. Empty where it is not known.
  std::optional<Mat3> covariance{};
};

/// One submap: what was seen from about one place.
struct Submap {
  std::uint64_t id = 0;             ///< numbered from 0 in the order of creation
  Pose T_map_submap;                ///< the sensor pose of its first frame, as the map now has it
  std::vector<LandmarkId> members;  ///< in the order in which they joined
};

/// The whole map. Its frame is the sensor frame of the frame that started the map.
struct Map {
  std::vector<Landmark> landmarks;  ///< by id
  std::vector<Submap> submaps;      ///< by id
};

/// Totals since the mapper was made or reset.
struct Counters {
  std::uint64_t iterations = 0;    ///< calls of process()
  std::uint64_t lost = 0;          ///< iterations without a pose
  std::uint64_t landmarks = 0;     ///< landmarks in the map, temporary ones included
  std::uint64_t submaps = 0;       ///< submaps in the map
  std::uint64_t closes = 0;        ///< times a submap was closed
  std::uint64_t reopened = 0;      ///< times an old submap was taken up again
  std::uint64_t global_steps = 0;  ///< times all submaps were re-placed together online
  std::uint64_t merged = 0;        ///< landmarks that turned out to be another one
  std::uint64_t found_moving = 0;  ///< frames that found landmarks to move
  std::uint64_t searches = 0;      ///< times the motion prediction failed and turns were tried
  std::uint64_t relocalised = 0;  ///< times a frame without a pose was found in the map by what it sees alone
  std::uint64_t parts = 0;        ///< parts that the map has: maps whose place to each other is not known
  std::uint64_t joined = 0;       ///< times two parts became one
};

/// What one frame gave.
struct Answer {
  bool has_pose = false;  ///< see Mapper::process for the rule
  Pose T_map_sensor;      ///< defined when has_pose
  int determined =
      0;  ///< degrees of freedom of the pose that the frame determines: 6, or 3 in a plane, when it is placed
  bool in_part = false;  ///< the frame was placed in the part of the map that is numbered `part`
  std::uint64_t part =
      0;  ///< parts are numbered in the order of their first frames; the map's own frame is that of part 0
  /// Which map the pose is in, and which part of it: poses under one number are in one frame of reference. A map that is started over goes on with
  /// numbers that were never used.
  std::uint64_t epoch = 0;
  /// Of the pose's error against the map, as PoseInformation has it [m, rad]: where the map's landmarks in view lie is taken
  /// as known but for the noise of their own observations. Empty without a pose and while the noise is not known yet.
  std::optional<Mat6> covariance{};
  std::vector<LandmarkId> associations;  ///< one per point given, in their order; kNoLandmark for none
  Counters counters;
};

}  // namespace hallway::slam_point
