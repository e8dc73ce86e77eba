// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "geometry/se3.hpp"
#include "log/plane_landmarks.hpp"

namespace hallway::eval {

/// A plane observation that a mapper was given, with what it is of and what the mapper made of it.
struct AssociatedPlane {
  log::LandmarkId true_plane = log::kNoLandmark;  ///< that it is of
  log::LandmarkId landmark = log::kNoLandmark;    ///< that it was associated with
  Vec3 normal = Vec3::Zero();                     ///< unit, body frame; zero: its place is not known
  Vec3 centroid = Vec3::Zero();                   ///< body frame [m]
  std::vector<Vec3> bounds{};                     ///< its hull or corners, body frame [m]
};

/// The path as the map of planes at the end shows it: each frame placed anew where the planes that it was given, as they were associated while the run went on, lie
/// best on those of that map. Keeps the planes until then, at most kMaxPoints of their points.
class RefittedPlanes {
 public:
  /// Above so many points nothing is kept and nothing is placed.
  static constexpr std::size_t kMaxPoints = std::size_t{1} << 22;
  /// Standard deviation of a position, in its worst direction, from which on a frame is left out [m].
  static constexpr double kUndetermined_m = 0.1;

  /// Adds a frame that was answered with a pose.
  void add(std::uint32_t iteration, const Pose& T_map_body, std::span<const AssociatedPlane> observations);

  struct Placed {
    std::uint32_t iteration = 0;
    Pose T_map_body;
  };
  /// The frames whose planes determine where they are, in their order. Least squares over the turn of each plane against the one of the map, the distance of
  /// its middle from that, and how far it reaches at those edges that are certain there, if it ends at them. Each kind is weighted by the scatter that all frames
  /// show of it (median absolute deviation); what is farther off than four times that does not count. Whether a plane ends at an edge is asked where the
  /// frame lies by its planes alone, so that a cut near an edge does not decide where the frame is. A plane that is not in the map any more stands for the one in which most of what was
  /// taken for it lies. Directions that the planes leave open, as heights where all are upright,
  /// stay as they were answered. Empty beyond kMaxPoints. O(points), and planes of the map for each plane that is not in it any more.
  std::vector<Placed> place(std::span<const log::PlaneLandmark> map) const;

 private:
  struct Sight {
    log::LandmarkId plane = 0;
    Vec3 normal, middle;
    std::size_t end = 0;  // of its bounds
  };
  struct Frame {
    std::uint32_t iteration = 0;
    Pose T_map_body;
    std::size_t end = 0;  // of its sights
  };
  /// What has become of planes that are not in the map any more.
  std::map<log::LandmarkId, log::LandmarkId> heirs_in(std::span<const log::PlaneLandmark> map) const;

  std::vector<Vec3> bounds_;
  std::vector<Sight> sights_;
  std::vector<Frame> frames_;
  bool complete_ = true;
};

}  // namespace hallway::eval
