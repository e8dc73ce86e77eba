// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "slam_point/core/frame/frame_matcher.hpp"
#include "slam_point/core/frame/motion_prediction.hpp"
#include "slam_point/core/options.hpp"
#include "slam_point/core/places/place_recogniser.hpp"
#include "slam_point/core/submaps/submap_graph.hpp"
#include "slam_point/core/submaps/submap_sequence.hpp"

namespace hallway::slam_point {

/// Places frames against the map: predicts where the sensor is, matches and fits from there, searches where that fails, and judges
/// whether the frame has a pose (Mapper::process has the rule).
///
/// Per frame: begin(), match(), fit(), and where that is not sure search(); is_placed() then says whether there is a pose, and
/// accept() or lose() is told what came of it.
class FramePlacer {
 public:
  /// All but `options` must outlive it.
  FramePlacer(const Options& options, const SubmapGraph& graph, const SubmapSequence& submaps,
              FrameMatcher& matcher, PlaceRecogniser& places);

  /// A frame begins. `planar`: every z is 0; `followed`: it came with the sensor's tracks, and they count.
  void begin(bool planar, bool followed);

  /// Predicts where the frame is, and matches it to the active submap, and what is left to the map.
  void match(std::vector<Observation>& frame);
  /// Fits the frame to the map. Whether so much agrees that no better pose need be searched.
  bool fit(const std::vector<Observation>& frame);

  /// Looks for the frame by its constellations, unless `by_place` is false, then for a turn about the z axis. Whether it was found by its
  /// constellations; not where it was followed to, if found_elsewhere() is set.
  bool search(bool by_place, std::vector<Observation>& frame);
  /// Where this frame was found by what it sees alone, where tracking cannot go on to; its part is kNone else.
  const Placement& found_elsewhere() const { return found_; }

  /// Whether the frame has a pose.
  bool is_placed(const std::vector<Observation>& frame);

  /// The frame is placed: drops matches that are strays, and learns how the sensor moved.
  void accept(std::vector<Observation>& frame);
  /// The frame has no pose: unmatches it. Returns how many degrees of freedom of its pose it determines nevertheless.
  int lose(std::vector<Observation>& frame);

  /// The sensor is at T_map_sensor, all that was before left behind: a new map or part.
  void restart(const Pose& T_map_sensor);
  /// The sensor is at T_map_sensor, as the frame's constellations tell: matches and fits the frame to the map there.
  void enter(const Pose& T_map_sensor, std::vector<Observation>& frame);
  /// Another submap is active from now on, in which the frame lies at T_submap_sensor.
  void enter_submap(const Pose& T_submap_sensor);

  /// The map has changed under the frame: fits it again.
  void refit(const std::vector<Observation>& frame);
  /// The map's frame has changed: T_new_old moves from the old one to the new one.
  void move_frame(const Pose& T_new_old) { T_map_sensor_ = T_new_old * T_map_sensor_; }

  /// Takes note of how many landmarks the placed frame saw.
  void note_seen(std::size_t landmarks) { last_seen_ = landmarks; }

  const Pose& T_map_sensor() const { return T_map_sensor_; }
  /// Where the frame lies in the active submap.
  const Pose& T_submap_sensor() const { return fit_.T_submap_sensor; }
  /// Frames in a row without a pose, this one included once it is lost.
  int frames_without_pose() const { return frames_without_pose_; }

 private:
  const Pose& T_map_submap() const { return graph_.poses[graph_.active()]; }
  void match_active_submap(std::vector<Observation>& frame);
  void match_map(std::vector<Observation>& frame);
  bool recognise(std::vector<Observation>& frame);
  void search_turn(std::vector<Observation>& frame);
  bool look_from(const Pose& T_map_sensor, std::vector<Observation>& frame);
  int least_agreeing(std::size_t points) const;
  bool is_expected() const;
  bool contradicts(const std::vector<Observation>& frame) const;
  std::size_t comparable_points(const std::vector<Observation>& frame) const;
  int determined_by_few(const std::vector<Observation>& frame) const;

  Options options_;
  const SubmapGraph& graph_;
  const SubmapSequence& submaps_;
  FrameMatcher& matcher_;
  PlaceRecogniser& places_;
  MotionPrediction prediction_;

  // Of this frame.
  bool planar_ = true;
  bool followed_ = false;
  FrameMatcher::Fit fit_;
  Pose predicted_;  // T_submap_sensor
  Pose T_map_sensor_;
  int agreeing_ = 0;   // points that lie on their landmark up to noise
  bool fits_ = false;  // the matches determine a pose, whether they agree with it or not
  bool searched_ = false;
  Placement found_;
  std::vector<Pose> search_bases_;

  // Of those before.
  Pose last_T_submap_sensor_;  // of the last frame with a pose
  std::size_t last_seen_ = 0;  // landmarks seen by it
  int frames_without_pose_ = 0;
  bool contradicted_ = false;  // the prediction, by one of them
};

}  // namespace hallway::slam_point
