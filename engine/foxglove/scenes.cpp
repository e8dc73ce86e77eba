// SPDX-License-Identifier: MIT
#include "foxglove/scenes.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <unordered_map>

#include "foxglove/frames.hpp"

namespace hallway::foxglove {
namespace {

constexpr Colour kTemporaryColour{0.44, 0.463, 0.502};
constexpr Colour kDynamicColour{0.667, 0.2, 0.467};

/// After Okabe and Ito; in turn.
constexpr std::array<Colour, 6> kSubmapColours{{{0.0, 0.62, 0.451},
                                                {0.902, 0.624, 0.0},
                                                {0.337, 0.706, 0.914},
                                                {0.8, 0.475, 0.655},
                                                {0.941, 0.894, 0.259},
                                                {0.6, 0.6, 0.6}}};

Vec3 vector_of(const std::array<double, 3>& v) {
  return {v[0], v[1], v[2]};
}

/// A share of the landmarks' extent, so that they are seen in a room and in a town.
template <typename Landmarks>
double diameter_for(const Landmarks& landmarks) {
  if (landmarks.empty()) return 0.0;
  Vec3 low = vector_of(landmarks.front().position_m);
  Vec3 high = low;
  for (const auto& landmark : landmarks) {
    low = low.cwiseMin(vector_of(landmark.position_m));
    high = high.cwiseMax(vector_of(landmark.position_m));
  }
  constexpr double kShare = 0.003;
  return std::clamp(kShare * (high - low).norm(), 0.02, 2.0);
}

Colour colour_of(log::LandmarkStatus status) {
  switch (status) {
    case log::LandmarkStatus::kMapped:
      return kEstimateColour;
    case log::LandmarkStatus::kDynamic:
      return kDynamicColour;
    case log::LandmarkStatus::kTemporary:
      return kTemporaryColour;
  }
  return kTemporaryColour;
}

Line star(const std::vector<Vec3>& places, const Colour& colour) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& place : places) middle += place / static_cast<double>(places.size());
  Line line{.kind = Line::Kind::kPairs, .points = {}, .width_px = 1.0, .colour = colour};
  for (const Vec3& place : places) {
    line.points.push_back(middle);
    line.points.push_back(place);
  }
  return line;
}

}  // namespace

Entity true_landmark_balls(std::span<const log::Landmark> landmarks) {
  Entity entity{.frame = frames::kWorld, .id = "true landmarks", .lines = {}, .balls = {}};
  const double diameter = diameter_for(landmarks);
  for (const log::Landmark& landmark : landmarks) {
    entity.balls.push_back({vector_of(landmark.position_m), diameter, kTruthColour});
  }
  return entity;
}

Entity landmark_balls(std::span<const log::MapLandmark> landmarks) {
  Entity entity{.frame = frames::kMap, .id = "landmarks", .lines = {}, .balls = {}};
  const double diameter = diameter_for(landmarks);
  for (const log::MapLandmark& landmark : landmarks) {
    entity.balls.push_back({vector_of(landmark.position_m), diameter, colour_of(landmark.status)});
  }
  return entity;
}

Entity submap_stars(std::span<const log::MapLandmark> landmarks, std::span<const log::IdPair> members) {
  std::unordered_map<log::LandmarkId, Vec3> places;
  for (const log::MapLandmark& landmark : landmarks) {
    if (landmark.status == log::LandmarkStatus::kMapped) places[landmark.id] = vector_of(landmark.position_m);
  }
  std::map<std::uint64_t, std::vector<Vec3>> submaps;
  for (const log::IdPair& member : members) {
    const auto place = places.find(member.second);
    if (place != places.end()) submaps[member.first].push_back(place->second);
  }
  Entity entity{.frame = frames::kMap, .id = "submaps", .lines = {}, .balls = {}};
  for (const auto& [submap, joined] : submaps) {
    entity.lines.push_back(star(joined, kSubmapColours[entity.lines.size() % kSubmapColours.size()]));
  }
  return entity;
}

}  // namespace hallway::foxglove
