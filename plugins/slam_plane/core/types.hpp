// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "geometry/convex2.hpp"

namespace hallway::slam_plane {

using Mat2 = Eigen::Matrix2d;

/// Index of a landmark or of a submap.
using Index = std::size_t;
inline constexpr Index kNone = ~std::size_t{0};

/// Sorts a list and leaves one of equal ones.
template <typename T>
void make_set(std::vector<T>& list) {
  std::ranges::sort(list);
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

/// An angle in radians.
constexpr double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

/// A vector turned by 90 degrees to the left.
inline Vec2 left_of(const Vec2& v) {
  return {-v.y(), v.x()};
}

/// The angle from direction a to direction b, in (-pi, pi] [rad].
inline double angle_between(const Vec2& a, const Vec2& b) {
  return std::atan2(cross(a, b), a.dot(b));
}

/// A rigid motion of the plane: `T_a_b * p_b` is the point in frame a.
struct Pose2 {
  Vec2 t = Vec2::Zero();    ///< translation [m]
  Vec2 r = Vec2(1.0, 0.0);  ///< cosine and sine of the heading

  /// The pose at `t` [m] with a heading [rad].
  static Pose2 at(const Vec2& t, double heading) { return {t, Vec2(std::cos(heading), std::sin(heading))}; }

  double heading() const { return std::atan2(r.y(), r.x()); }
  Vec2 rotate(const Vec2& v) const { return {r.x() * v.x() - r.y() * v.y(), r.y() * v.x() + r.x() * v.y()}; }
  Vec2 unrotate(const Vec2& v) const {
    return {r.x() * v.x() + r.y() * v.y(), -r.y() * v.x() + r.x() * v.y()};
  }
  Vec2 operator*(const Vec2& p) const { return rotate(p) + t; }
  Pose2 operator*(const Pose2& other) const { return {*this * other.t, rotate(other.r).normalized()}; }
  Pose2 inverse() const { return {-unrotate(t), Vec2(r.x(), -r.y())}; }
  /// Moved by `step` [m] and turned about its own origin by `turn` [rad].
  Pose2 moved(const Vec2& step, double turn) const {
    return {t + step, Pose2::at(Vec2::Zero(), turn).rotate(r).normalized()};
  }
};

/// The two ends of a wall; an index into pairs of things.
enum End : int { kEndA = 0, kEndB = 1 };

/// The direction along a wall in which it ends there: -1 at a, 1 at b.
constexpr double outward(int end) {
  return end == kEndA ? -1.0 : 1.0;
}

/// The part of a wall, which is an upright plane, that one frame saw: a plane observation laid into the level of the robot, in the robot's frame (x forward, y left, z
/// up) [m]. The robot sees `a` on the left.
struct WallObservation {
  Vec2 a = Vec2::Zero();
  Vec2 b = Vec2::Zero();
  double z_low = 0.0;
  double z_high = 0.0;
};

/// Where a landmark is in the map's submaps.
struct Membership {
  Index submap = kNone;
  Index member = kNone;  ///< of that one's members
};

/// Appends a value that a list does not have yet. O(list).
template <typename T>
void add_new(std::vector<T>& list, const T& value) {
  if (std::ranges::find(list, value) == list.end()) list.push_back(value);
}

/// What bounds a frame.
struct View {
  double horizontal_fov_rad = 1.5707963267948966;  ///< full angle, symmetric about the x axis
  double max_range_m = 12.0;                       ///< farthest depth (x); 0: no bound
  bool range_bounds_sides = false;                 ///< the bound is one of the range, not of the depth
};

/// Names a landmark for the life of a mapper.
using LandmarkId = std::uint64_t;
/// No landmark: of an unassociated observation.
inline constexpr LandmarkId kNoLandmark = ~std::uint64_t{0};

/// How far a landmark is trusted.
enum class LandmarkStatus {
  temporary,  ///< seen too seldom
  mapped,
  dynamic,  ///< it moves: it is where it was seen last, and tells nothing of any pose
};

/// A wall of the map: a plane landmark that is upright, as a facing segment.
struct WallLandmark {
  LandmarkId id = kNoLandmark;
  Vec2 a = Vec2::Zero();             ///< map frame [m]; on the left for who sees the wall
  Vec2 b = Vec2::Zero();             ///< likewise, on the right
  bool certain[2] = {false, false};  ///< that the end is a true corner; else the wall was seen up to there
  double z_low = 0.0;                ///< lowest seen, averaged [m]
  double z_high = 0.0;               ///< highest seen, averaged [m]
  std::uint32_t observations = 0;    ///< that it was made from
  LandmarkStatus status = LandmarkStatus::temporary;  ///< mapped from Options::min_observations on
};

/// One submap of a map that is reported: what was seen from about one place.
template <typename Pose>
struct SubmapAt {
  std::uint64_t id = 0;
  Pose T_map_submap;                ///< the pose of its first frame, as the map now has it
  bool lines_only = false;          ///< of frames that left a direction unobservable
  std::vector<LandmarkId> members;  ///< in the order in which they joined
};
using Submap = SubmapAt<Pose2>;

/// The whole map. Its frame is the robot's at the frame that started it.
struct Map {
  std::vector<WallLandmark> walls;  ///< by id
  std::vector<Submap> submaps;      ///< by id
};

/// Totals since the mapper was made or reset.
struct Counters {
  std::uint64_t iterations = 0;       ///< calls of process()
  std::uint64_t lost = 0;             ///< iterations without a pose
  std::uint64_t landmarks = 0;        ///< in the map, temporary ones included
  std::uint64_t submaps = 0;          ///< in the map
  std::uint64_t closes = 0;           ///< times a submap was closed
  std::uint64_t reopened = 0;         ///< times an old submap was taken up again
  std::uint64_t degenerate = 0;       ///< iterations that left a direction unobservable
  std::uint64_t gaps = 0;             ///< times the place along a direction was lost
  std::uint64_t gaps_closed = 0;      ///< times it was found again
  std::uint64_t global_steps = 0;     ///< times all submaps were placed together
  std::uint64_t merged = 0;           ///< walls that turned out to be another one
  std::uint64_t dynamic = 0;          ///< walls that turned out to move
  std::uint64_t corners_revoked = 0;  ///< ends taken for corners that turned out not to be any
};

/// Why a frame has no pose.
enum class Lost {
  no,
  nothing_seen,
  nothing_known,  ///< too little of the map is in view
  unobservable,   ///< what is in view of it leaves directions of the pose open
};

/// What one frame gave.
struct Answer {
  bool has_pose = false;
  Lost lost = Lost::nothing_seen;  ///< `no` when has_pose
  Pose2 T_map_robot;               ///< defined when has_pose
  /// Of x, y [m] and heading [rad], in the map's frame, given the walls as they are.
  Mat3 covariance = Mat3::Zero();
  /// Unit vector of the map's frame along which the frame does not tell where the robot is, or zero.
  Vec2 unobservable = Vec2::Zero();
  /// Unit vector of the map's frame along which the ground about the robot is not tied to that seen earlier, or zero.
  Vec2 untied = Vec2::Zero();
  std::uint32_t part = 0;                ///< of the map, that the pose is in; see Mapper::joined_parts()
  std::vector<LandmarkId> associations;  ///< one per observation given, in their order; kNoLandmark for none
  Counters counters;
};

}  // namespace hallway::slam_plane
