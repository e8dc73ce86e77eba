// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "geometry/se3.hpp"
#include "sense/point_sensor.hpp"
#include "trace/scene.hpp"

namespace hallway::test {

inline const trace::Scene& empty_scene() {
  static const trace::Scene scene(trace::TriangleMesh{}, trace::Backend::kBruteForce);
  return scene;
}

/// A camera of 90 by 60 degrees at the body's origin, without noise.
inline sense::PointSensorSpec camera() {
  sense::PointSensorSpec spec;
  spec.name = "camera";
  return spec;
}

inline std::vector<sense::PointObservation> observe(const sense::PointSensor& sensor,
                                                    const Pose& T_world_body, std::uint32_t step = 0,
                                                    unsigned threads = 1) {
  std::vector<sense::PointObservation> observations;
  sensor.observe(T_world_body, step, threads, observations);
  return observations;
}

/// The landmarks seen, in ascending order.
inline std::vector<std::uint32_t> seen(const std::vector<sense::PointObservation>& observations) {
  std::vector<std::uint32_t> landmarks;
  for (const auto& observation : observations) landmarks.push_back(observation.landmark);
  std::sort(landmarks.begin(), landmarks.end());
  return landmarks;
}

}  // namespace hallway::test
