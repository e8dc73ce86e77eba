// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>

#include "slam_point/core/options.hpp"
#include "slam_point/core/stage_clock.hpp"
#include "slam_point/core/types.hpp"

namespace hallway::slam_point {

/// Maps points seen by a moving sensor, without odometry and without identities (thesis chapter 6).
///
/// Deterministic: the same frames give the same bits. Not thread-safe; separate mappers are independent.
class Mapper {
 public:
  /// Throws std::invalid_argument when an option is out of range.
  explicit Mapper(const Options& options);
  ~Mapper();
  Mapper(Mapper&&) noexcept;
  Mapper& operator=(Mapper&&) noexcept;

  /// Takes one frame: points in the sensor frame [m], x forward, y left, z up, any number, in any order.
  ///
  /// A point that is not finite, or farther than 1e6 m, is skipped and belongs to no landmark.
  ///
  /// The first frame whose points determine a pose starts the map and has the identity pose. A later frame has a
  /// pose when the points matched to the map determine one: at least three (two in a plane of three in view or more; four after a frame without a
  /// pose, five after more than three such frames), spread so that the rotation's standard deviation is below 0.1 rad; and when
  /// enough of them agree with the map: at least two fifths of the points in view, or of those the last placed frame saw if
  /// fewer. Up to three frames that showed what was expected (six points, and half of those comparable) and did not
  /// determine a pose do not count as frames without one there. Where that fails, the frame is looked for in all of
  /// the map by its constellations of points (Relocaliser).
  ///
  /// A frame without a pose leaves the map unchanged, and the prediction goes on; but while only one frame is placed,
  /// a frame that does not fit it starts the map over if it can, with new landmark ids. After Options::bridge_frames such frames
  /// the next one that determines a pose of its own begins another part of the map. Its frames are placed in it (`in_part`) and
  /// have no pose in the map, until the part is found to meet the first one; then the two are one, and poses are told again.
  ///
  /// Cost: proportional to the points in view, independent of the size of the map, but for a windowed step over the
  /// last submaps when a submap closes. The answer lives until the next call.
  const Answer& process(std::span<const Vec3> points) { return process(points, {}); }

  /// The same for points that the sensor follows: `tracks` is empty or has one entry for each point, kNoTrack for none. With
  /// Options::association `sensor`, a point is the landmark that its track was given when it was new, as long as it lies
  /// where that is within the bounds; a track that does not so thrice in a row gets a new landmark. Else tracks are not
  /// looked at.
  const Answer& process(std::span<const Vec3> points, std::span<const TrackId> tracks);

  /// The map as it stands. O(map).
  Map map() const;

  /// The map as all evidence places it together (refine_map), with covariances. The online state is not changed.
  Map refined_map() const;

  /// Forgets everything but the options.
  void reset();

  const Options& options() const;

  /// Adds what each stage of process() takes to `times` [us, wall clock] from now on, until reset(); null: to nothing. `times` must live as long as
  /// it is added to.
  void time_stages(StageTimes* times);

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace hallway::slam_point
