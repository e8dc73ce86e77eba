// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "map/path.hpp"
#include "sim/motion.hpp"
#include "sim/smooth_pace.hpp"

namespace hallway::sim {

/// A robot that its path moves. It meets nothing, and has no wheels.
class MotionOnPath : public Motion {
 public:
  std::vector<sense::BumpContact> contacts_in(std::int64_t, std::int64_t) const final { return {}; }
  std::vector<double> wheel_travel_at(std::int64_t) const final { return {}; }
};

/// A robot that its path moves, at constant speed from time 0 on until the path ends or an obstacle stops it, where it stands from one moment to the next.
/// Its acceleration jumps where the path's curvature does: at the begin and the end of a corner's arc.
class PathMotion final : public MotionOnPath {
 public:
  /// Keeps a reference to the path.
  /// @param step_length_m  metres of path from frame to frame, from 0
  /// @param period_ns      from frame to frame, above 0
  /// @param stop_m         of the path, where it stops
  PathMotion(const map::Path& path, double step_length_m, std::int64_t period_ns,
             double stop_m = std::numeric_limits<double>::infinity());

  /// At the time of a frame that of the path after so many steps, to the last bit.
  Pose pose_at(std::int64_t t_ns) const override;
  sense::Kinematics kinematics_at(std::int64_t t_ns, double after_s, sense::Side side) const override;
  std::vector<double> breaks_in(std::int64_t begin_ns, std::int64_t end_ns) const override;

 private:
  double way_at(std::int64_t t_ns) const;

  const map::Path& path_;
  double step_length_m_;
  std::int64_t period_ns_;
  double speed_m_s_;
  double stop_m_;  ///< where it stands at last; infinite: it goes on
};

/// A robot that its path moves by a SmoothPace. On a path whose curvature has a continuous slope no member of Kinematics jumps, ever.
class SmoothPathMotion final : public MotionOnPath {
 public:
  /// Keeps a reference to the path.
  SmoothPathMotion(const map::Path& path, const SmoothPace& pace) : path_(path), pace_(pace) {}

  Pose pose_at(std::int64_t t_ns) const override;
  sense::Kinematics kinematics_at(std::int64_t t_ns, double after_s, sense::Side side) const override;
  std::vector<double> breaks_in(std::int64_t begin_ns, std::int64_t end_ns) const override;

 private:
  const map::Path& path_;
  SmoothPace pace_;
};

}  // namespace hallway::sim
