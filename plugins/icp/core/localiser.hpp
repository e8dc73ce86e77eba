// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "icp/core/options.hpp"
#include "icp/core/point_map.hpp"

namespace hallway::icp {

/// Totals since the localiser was made or reset, and facts of the last frame.
struct Counters {
  std::uint64_t lost = 0;       ///< frames without a pose
  std::uint64_t searches = 0;   ///< frames whose prediction failed, so that turns were tried
  std::uint64_t keyframes = 0;  ///< frames that others were registered with, with Against::keyframe
  std::uint64_t landmarks = 0;  ///< points of the map, with Against::map
  int iterations = 0;           ///< steps of the registration that counted
  double residual_m = 0.0;      ///< its residual [m]
  double overlap = 0.0;         ///< its overlap [1]
};

/// What one frame gave.
struct Answer {
  bool has_pose = false;
  Pose T_map_sensor;  ///< defined when has_pose
  std::vector<std::uint64_t>
      associations;  ///< with Against::map: one per point given, kNoLandmark for none; else empty
  std::uint64_t epoch =
      0;  ///< how often the map was started over: poses under one number are in one frame of reference
  Counters counters;
};

/// Where a sensor is, from frames of points alone, by registering each with an earlier one (thesis 3.2): no loop is closed and
/// nothing is corrected later, so errors add up. The map's frame is the sensor's at the first frame that determines a pose.
class Localiser {
 public:
  explicit Localiser(const Options& options) : options_(options) {}

  /// Forgets everything.
  void reset() { *this = Localiser(options_); }

  /// One iteration: the frame's points in the sensor's frame [m]; those that are not usable are passed over.
  const Answer& process(const Points& points);

  /// The points of the map, by number; empty but with Against::map.
  std::vector<Landmark> landmarks() const;

 private:
  /// A cloud that frames are registered with.
  struct Reference {
    Target target;
    Rules rules;
    Pose T_map_target;
  };

  Points sample_of(const Points& points) const;
  Reference make_reference(const Points& points, const Pose& T_map_target) const;
  bool start(const Points& points);
  void prepare_map_reference(const Points& points);
  Registration locate(const Points& sample);
  Registration locate_from(const Points& sample, double turn) const;
  void pass_keyframe_on();
  bool accepted(const Registration& registration) const;
  void keep(const Points& points, const Registration& registration);
  void add_to_map(const Points& points);

  Options options_;
  std::optional<Reference> reference_;
  std::optional<PointMap> map_;
  Pose T_map_predicted_;  // of the frame that comes
  Pose motion_;           // T_last_this of the last two frames with a pose
  Pose T_map_last_;
  Points
      last_points_;  // with Against::keyframe: of the last frame with a pose, where that is not the keyframe
  std::uint64_t frames_ = 0;  // with a pose
  Answer answer_;
};

}  // namespace hallway::icp
