// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "slam_point/core/frame/frame.hpp"
#include "slam_point/core/options.hpp"
#include "slam_point/core/places/constellation_index.hpp"
#include "slam_point/core/places/relocaliser.hpp"

namespace hallway::slam_point {

/// Knows places of the map by their constellations of landmarks: finds a frame, or what is about the sensor, without any idea of where
/// it is. The index grows with the map: every submap that closes is noted.
class PlaceRecogniser {
 public:
  /// `graph` must outlive it.
  PlaceRecogniser(const Options& options, const SubmapGraph& graph);

  /// Takes note of a submap that closed.
  void note(Index submap) { constellations_.note(submap); }
  /// Indexes some of what was noted. To be called once a frame.
  void advance() { constellations_.advance(kIndexedPerFrame); }

  /// Finds a frame in any part of the map, the active submap's landmarks included. See Relocaliser::locate.
  bool find_frame(const Observations& frame, Relocalisation& found);
  /// Finds points in all parts of the map but `except`, likewise.
  bool find_elsewhere(const std::vector<Vec3>& points, Index except, Relocalisation& found);
  /// Whether a frame may agree as well with the current part at T_map_sensor by chance, wherever it was seen (more than one time in a thousand).
  bool may_be_chance(const Observations& frame, const Pose& T_map_sensor);

  void clear() { constellations_.clear(); }

 private:
  static constexpr int kIndexedPerFrame = 8;  // landmarks whose constellations are noted

  void gather(const Observations& frame);

  double noise_;
  const SubmapGraph& graph_;
  ConstellationIndex constellations_;
  Relocaliser relocaliser_;
  std::vector<Vec3> view_;      // points of a frame, sensor frame
  std::vector<double> noises_;  // of each: standard deviation of a coordinate [m]
};

}  // namespace hallway::slam_point
