// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "slam_point/core/frame/frame_matcher.hpp"
#include "slam_point/core/frame/track_book.hpp"
#include "slam_point/core/options.hpp"
#include "slam_point/core/submaps/submap_graph.hpp"

namespace hallway::slam_point {

/// Makes observations of the points given: which are usable, what each counts for, and which landmark its track says it is.
class FrameIntake {
 public:
  explicit FrameIntake(const Options& options);

  /// Puts the usable points into `frame`, in their order. `tracks`: see Mapper::process.
  void take(std::span<const Vec3> points, std::span<const TrackId> tracks, const TrackBook& book,
            const SubmapGraph& graph, std::vector<Observation>& frame);

  /// Whether all points taken so far lie in the plane z = 0.
  bool is_planar() const { return planar_; }
  /// Whether the frame taken last came with the sensor's tracks, and they count.
  bool is_followed() const { return followed_; }

 private:
  void weigh(Observation& observation) const;
  void take_tracks(std::span<const TrackId> tracks, const TrackBook& book, const SubmapGraph& graph,
                   std::vector<Observation>& frame);

  Options options_;
  bool ranges_count_;  // noise differs by range or direction
  bool planar_ = true;
  bool followed_ = false;
};

}  // namespace hallway::slam_point
