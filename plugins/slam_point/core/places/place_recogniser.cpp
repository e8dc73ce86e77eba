// SPDX-License-Identifier: MIT
#include "slam_point/core/places/place_recogniser.hpp"

#include <cmath>

namespace hallway::slam_point {
namespace {

constexpr double kIndexNoises = 4.0;
constexpr int kIndexedAtOnce = 64;   // landmarks of the active submap, when a frame is looked for
constexpr int kTriedAfterGap = 300;  // places, as many as the turns that are tried
constexpr double kMostAfterGap = 1e-3;

}  // namespace

PlaceRecogniser::PlaceRecogniser(const Options& options, const SubmapGraph& graph)
    : noise_(options.noise_m),
      graph_(graph),
      constellations_(graph, kIndexNoises * options.noise_m,
                      static_cast<std::uint32_t>(options.min_observations)),
      relocaliser_(options, graph, constellations_) {}

bool PlaceRecogniser::find_frame(const Observations& frame, Relocalisation& found) {
  constellations_.add_now(graph_.active(), kIndexedAtOnce);
  gather(frame);
  return find_elsewhere(view_, kNone, found);
}

bool PlaceRecogniser::find_elsewhere(const std::vector<Vec3>& points, Index except, Relocalisation& found) {
  return relocaliser_.locate(points, except, found);
}

bool PlaceRecogniser::may_be_chance(const Observations& frame, const Pose& T_map_sensor) {
  gather(frame);
  return relocaliser_.chance_at(view_, noises_, T_map_sensor, kTriedAfterGap) > kMostAfterGap;
}

void PlaceRecogniser::gather(const Observations& frame) {
  view_.clear();
  noises_.clear();
  for (const Observation& observation : frame) {
    view_.push_back(observation.point);
    noises_.push_back(noise_ / std::sqrt(observation.weight));
  }
}

}  // namespace hallway::slam_point
