// SPDX-License-Identifier: MIT
#include "slam_point/core/places/place_recogniser.hpp"

#include <cmath>

namespace hallway::slam_point {
namespace {

constexpr double kIndexNoises = 4.0;
constexpr int kIndexedPerFrame = 8;  // landmarks whose constellations are noted
constexpr int kIndexedAtOnce = 64;   // landmarks of the active submap, when a frame is looked for
constexpr int kTriedAfterGap = 300;  // places, as many as the turns that are tried
constexpr double kMostAfterGap = 1e-3;

}  // namespace

PlaceRecogniser::PlaceRecogniser(const Options& options, const FrameMatcher& matcher)
    : noise_(options.noise_m),
      constellations_(kIndexNoises * options.noise_m, static_cast<std::uint32_t>(options.min_observations)),
      relocaliser_(options, matcher.rules(true), matcher.rules(false), options.map_bound()) {}

void PlaceRecogniser::advance(const SubmapGraph& graph) {
  constellations_.advance(graph, kIndexedPerFrame);
}

bool PlaceRecogniser::find_frame(const SubmapGraph& graph, const std::vector<Observation>& frame, bool planar,
                                 Placement& found) {
  constellations_.add_now(graph, graph.active(), kIndexedAtOnce);
  gather(frame);
  return find_elsewhere(graph, view_, kNone, planar, found);
}

bool PlaceRecogniser::find_elsewhere(const SubmapGraph& graph, const std::vector<Vec3>& points, Index except,
                                     bool planar, Placement& found) {
  return relocaliser_.locate(graph, constellations_, points, except, planar, found);
}

bool PlaceRecogniser::may_be_chance(const SubmapGraph& graph, const std::vector<Observation>& frame,
                                    const Pose& T_map_sensor, bool planar) {
  gather(frame);
  return relocaliser_.chance_at(graph, view_, noises_, T_map_sensor, planar, kTriedAfterGap) > kMostAfterGap;
}

void PlaceRecogniser::gather(const std::vector<Observation>& frame) {
  view_.clear();
  noises_.clear();
  for (const Observation& observation : frame) {
    view_.push_back(observation.point);
    noises_.push_back(noise_ / std::sqrt(observation.weight));
  }
}

}  // namespace hallway::slam_point
