// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "slam_point/core/places/map_parts.hpp"
#include "slam_point/core/places/place_recogniser.hpp"
#include "slam_point/core/submaps/submap_graph.hpp"

namespace hallway::slam_point {

/// Watches when another part of the map is to begin, when one is to be given up, and when two parts are found to meet.
class PartWatch {
 public:
  /// All but `options` must outlive it.
  PartWatch(const Options& options, const SubmapGraph& graph, const MapParts& parts, PlaceRecogniser& places);

  /// Whether a part with so many frames is too young to be kept when the sensor gets lost in it.
  static bool is_young(std::uint64_t frames);

  /// Whether another part may begin with a frame of so many points, after so many frames without a pose.
  bool is_time_to_begin(std::size_t points, int frames_without_pose) const;
  /// Another part begins in place of the current one. Before MapParts::begin.
  void note_begin();

  /// Where another part lies to the current one.
  struct Meeting {
    Index other = kNone;
    Pose T_other_here;
  };
  /// Looks for what is about the sensor in other parts, every few frames. Set when it was found twice in a row at the same place.
  /// O(landmarks of the active submap).
  std::optional<Meeting> look(const Pose& T_map_sensor, std::uint64_t iteration);

  /// Forgets meetings.
  void clear();

 private:
  int frames_to_bridge(bool false_start) const;
  void gather_view(std::uint64_t frames, const Pose& T_map_sensor);

  int bridge_frames_;
  double tolerance_;
  const SubmapGraph& graph_;
  const MapParts& parts_;
  PlaceRecogniser& places_;
  PartMeeting meeting_;
  std::vector<Vec3> view_;  // what is looked for, sensor frame
  int false_parts_ = 0;     // parts begun that no second frame was placed in, since one was
};

}  // namespace hallway::slam_point
