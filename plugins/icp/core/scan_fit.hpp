// SPDX-License-Identifier: MIT
#pragma once

#include "icp/core/plane_map.hpp"
#include "icp/core/screw.hpp"

namespace hallway::icp {

/// How a scan is registered with a PlaneMap.
struct ScanRules {
  RangeNoise noise{};
  double reach_m = 0.3;     ///< farthest match at first: above the error of the guess
  int max_iterations = 40;  ///< steps
};

/// What registering a scan gave. Errors are of the position, then a rotation vector, both in the map's frame: true rotation = exp(error) * rotation.
struct ScanFit {
  bool converged = false;
  Pose T_map_sensor;
  Mat6 covariance = Mat6::Zero();
  double overlap = 0.0;     ///< share of the surfels that lie on a patch within the noise [1]
  double residual_m = 0.0;  ///< root of the weighted mean of squared distances of those [m]
  int iterations = 0;
  int open = 0;  ///< directions of motion that the patches leave open and the guess filled in
};

/// Registers a scan with a map: points of its surfels to planes, by Gauss-Newton steps with weights from the variances of surfels and patches and Geman and McClure's kernel, whose scale falls from the
/// reach to the noise. A direction counts as open where the matches tell no more of it than the errors of their normals do; there the guess stands.
/// @param surfels  in the sensor's frame
/// @param guess_covariance  of the guess's error; positive definite
ScanFit register_scan(const PlaneMap& map, const std::vector<Surfel>& surfels, const Pose& guess,
                      const Mat6& guess_covariance, const ScanRules& rules);

}  // namespace hallway::icp
