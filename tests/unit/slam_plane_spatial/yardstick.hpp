// SPDX-License-Identifier: MIT
#pragma once

#include "unit/slam_plane_spatial/scene.hpp"

namespace hallway::slam_plane::spatial::test {

/// What the data allow: batch least squares over all frames, each with a pose of its own, with the true association and the true edges,
/// begun at the true poses.
Outcome yardstick(const Scene& scene, const std::vector<TrueFrame>& frames, const Options& options);

}  // namespace hallway::slam_plane::spatial::test
