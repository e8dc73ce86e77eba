// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "eval/evaluator.hpp"
#include "run/feed/frame_feed.hpp"
#include "run/sources/sensor_poses.hpp"
#include "run/sources/source.hpp"

namespace hallway::run {

/// Makes what an evaluator needs of the frames of a source and the answers to them. Its observations are the points that sensors gave; of a source
/// without sensors of points they are the planes.
class IterationMaker {
 public:
  explicit IterationMaker(const Source& source);

  /// Without the pose's covariance, the part of the map that it is in, and planes. Its spans are valid until the next call.
  eval::Iteration make(const FrameAnswer& answer);

 private:
  void add_sample(const SourceFrame& frame, std::uint32_t k, const host::Outputs* outputs);

  SensorPoses sensor_poses_;
  std::uint32_t kind_;  ///< of the samples whose elements count
  std::vector<log::LandmarkId> identities_;
  std::vector<log::LandmarkId> associations_;
  std::vector<Vec3> points_;  ///< body frame
};

}  // namespace hallway::run
