// SPDX-License-Identifier: MIT
#pragma once

#include "slam_point/core/frame/frame.hpp"
#include "slam_point/core/frame/frame_matcher.hpp"
#include "slam_point/core/frame/placement.hpp"
#include "slam_point/core/frame/tracking.hpp"
#include "slam_point/core/places/map_parts.hpp"
#include "slam_point/core/places/place_recogniser.hpp"
#include "slam_point/core/stage_clock.hpp"
#include "slam_point/core/submaps/submap_sequence.hpp"

namespace hallway::slam_point {

/// Places frames in the map: predicts where the sensor is, associates and fits from there, searches where that fails, and judges whether the
/// frame has a pose (Mapper::process has the rule). It keeps nothing from frame to frame: what it predicts from is Tracking.
class FramePlacer {
 public:
  /// All but `options` must outlive it.
  FramePlacer(const Options& options, const SubmapSequence& submaps, const MapParts& parts,
              const Tracking& tracking, FrameMatcher& matcher, PlaceRecogniser& places, StageClock& clock)
      : options_(options),
        graph_(submaps.graph()),
        submaps_(submaps),
        parts_(parts),
        tracking_(tracking),
        matcher_(matcher),
        places_(places),
        clock_(clock) {}

  /// Associates the frame's points with landmarks (thesis 6.2.5, 6.5.1) and finds its pose (6.3.2). Outliers are left unassociated; without a
  /// pose, all points are.
  Placement place(Frame& frame);

  /// The same for a frame whose constellations have it at `T_map_sensor`, in the graph's current part.
  Placement place_at(const Pose& T_map_sensor, Frame& frame);

 private:
  const Pose& T_map_submap() const { return graph_.poses[graph_.active()]; }
  Placement look_from(const Pose& predicted, Frame& frame);
  bool associate(const Pose& predicted, Frame& frame, Placement& placement);
  void fit(bool is_in_submap, const Frame& frame, Placement& placement);
  Placement search(const Placement& tracked, Frame& frame);
  Placement recognised(const Relocalisation& found, const Placement& tracked, Frame& frame);
  Placement search_turn(const Placement& tracked, Frame& frame);
  Placement look_elsewhere(const Pose& T_map_sensor, Frame& frame);
  bool is_placed(const Placement& placement, const Frame& frame);
  int least_agreeing(const Placement& placement, const Frame& frame) const;
  bool is_expected(const Placement& placement) const;
  int comparable_points(const Frame& frame) const;
  void give_up(Frame& frame, Placement& placement) const;

  Options options_;
  const SubmapGraph& graph_;
  const SubmapSequence& submaps_;
  const MapParts& parts_;
  const Tracking& tracking_;
  FrameMatcher& matcher_;
  PlaceRecogniser& places_;
  StageClock& clock_;
};

}  // namespace hallway::slam_point
