// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "eval/evaluator.hpp"
#include "run/frame_feed.hpp"
#include "run/source.hpp"

namespace hallway::run {

/// Makes what an evaluator needs of the frames of a source and the answers to them.
class IterationMaker {
 public:
  /// Keeps a reference to `source`.
  explicit IterationMaker(const Source& source);

  /// Without the pose's covariance, the part of the map that it is in, and planes. Its spans are valid until the next call.
  eval::Iteration make(const FrameAnswer& answer);

 private:
  const Source& source_;
  Pose T_body_sensor_;
  std::vector<log::LandmarkId> identities_;
  std::vector<log::LandmarkId> none_;
  std::vector<Vec3> points_;  ///< body frame
};

}  // namespace hallway::run
