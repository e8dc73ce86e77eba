// SPDX-License-Identifier: MIT
#include "foxglove/scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_map>

#include "foxglove/frames.hpp"
#include "geom/arrays.hpp"

namespace hallway::foxglove {
namespace {

constexpr Colour kTemporaryColour{0.44, 0.463, 0.502};
constexpr Colour kDynamicColour{0.667, 0.2, 0.467};
constexpr Colour kCommandColour{0.902, 0.624, 0.0};
constexpr Colour kContactColour{0.667, 0.133, 0.353};

/// After Okabe and Ito; in turn.
constexpr std::array<Colour, 6> kSubmapColours{{{0.0, 0.62, 0.451},
                                                {0.902, 0.624, 0.0},
                                                {0.337, 0.706, 0.914},
                                                {0.8, 0.475, 0.655},
                                                {0.941, 0.894, 0.259},
                                                {0.6, 0.6, 0.6}}};

/// A share of the landmarks' extent, so that they are seen in a room and in a town.
template <typename Landmarks>
double diameter_for(const Landmarks& landmarks) {
  if (landmarks.empty()) return 0.0;
  Vec3 low = to_vec3(landmarks.front().position_m);
  Vec3 high = low;
  for (const auto& landmark : landmarks) {
    low = low.cwiseMin(to_vec3(landmark.position_m));
    high = high.cwiseMax(to_vec3(landmark.position_m));
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

Vec3 middle_of(const std::vector<Vec3>& places) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& place : places) middle += place / static_cast<double>(places.size());
  return middle;
}

Vec3 middle_of(const log::PlaneLandmark& plane) {
  std::vector<Vec3> places;
  for (const log::OutlineCorner& corner : plane.outline) places.push_back(to_vec3(corner.position_m));
  return middle_of(places);
}

Line star(const Vec3& middle, const std::vector<Vec3>& places, const Colour& colour) {
  Line line{.kind = Line::Kind::kPairs, .colour = colour};
  for (const Vec3& place : places) {
    line.points.push_back(middle);
    line.points.push_back(place);
  }
  return line;
}

/// The edges of a plane that are certain, or those that are not.
Line edges_of(const log::PlaneLandmark& plane, bool certain) {
  constexpr double kCertainWidth_px = 3.0;
  Line line{.kind = Line::Kind::kPairs,
            .width_px = certain ? kCertainWidth_px : 1.0,
            .colour = colour_of(plane.status)};
  const std::vector<log::OutlineCorner>& outline = plane.outline;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    if (outline[i].edge_certain != certain) continue;
    line.points.push_back(to_vec3(outline[i].position_m));
    line.points.push_back(to_vec3(outline[(i + 1) % outline.size()].position_m));
  }
  return line;
}

}  // namespace

Entity true_landmark_balls(std::span<const log::Landmark> landmarks) {
  Entity entity{.frame = frames::kWorld, .id = "true landmarks"};
  const double diameter = diameter_for(landmarks);
  for (const log::Landmark& landmark : landmarks) {
    entity.balls.push_back({to_vec3(landmark.position_m), diameter, kTruthColour});
  }
  return entity;
}

Entity landmark_balls(std::span<const log::MapLandmark> landmarks) {
  Entity entity{.frame = frames::kMap, .id = "landmarks"};
  const double diameter = diameter_for(landmarks);
  for (const log::MapLandmark& landmark : landmarks) {
    entity.balls.push_back({to_vec3(landmark.position_m), diameter, colour_of(landmark.status)});
  }
  return entity;
}

Entity mapped_plane_outlines(std::span<const log::PlaneLandmark> planes) {
  Entity entity{.frame = frames::kMap, .id = "mapped planes"};
  for (const log::PlaneLandmark& plane : planes) {
    for (const bool certain : {false, true}) {
      Line edges = edges_of(plane, certain);
      if (!edges.points.empty()) entity.lines.push_back(std::move(edges));
    }
  }
  return entity;
}

Entity robot_body(std::span<const Vec2> corners, double bottom_m, double top_m) {
  Line edges{.kind = Line::Kind::kPairs, .width_px = 2.0, .colour = kTruthColour};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
    for (const double z : {bottom_m, top_m}) {
      edges.points.emplace_back(a.x(), a.y(), z);
      edges.points.emplace_back(b.x(), b.y(), z);
    }
    edges.points.emplace_back(a.x(), a.y(), bottom_m);
    edges.points.emplace_back(a.x(), a.y(), top_m);
  }
  return {.frame = frames::kTrueBody, .id = "robot", .lines = {std::move(edges)}};
}

Entity command_arrow(const log::ObeyedCommand& command) {
  constexpr double kBarbShare = 0.25, kBarbAngle = 0.45, kArcRadius_m = 0.5;
  constexpr int kArcSteps = 16;
  Entity entity{.frame = frames::kTrueBody, .id = "command"};
  const Vec2 way(command.linear_m_s, command.lateral_m_s);
  if (way.norm() > 0.0) {
    Line arrow{.kind = Line::Kind::kPairs, .width_px = 3.0, .colour = kCommandColour};
    const Vec3 tip(way.x(), way.y(), 0.0);
    arrow.points = {Vec3::Zero(), tip};
    for (const double angle : {kBarbAngle, -kBarbAngle}) {
      const Vec2 barb = way - kBarbShare * (Eigen::Rotation2Dd(angle) * way);
      arrow.points.insert(arrow.points.end(), {tip, Vec3(barb.x(), barb.y(), 0.0)});
    }
    entity.lines.push_back(std::move(arrow));
  }
  if (command.angular_rad_s != 0.0) {
    Line arc{.width_px = 3.0, .colour = kCommandColour};
    const double swept = std::clamp(command.angular_rad_s, -6.0, 6.0);
    for (int i = 0; i <= kArcSteps; ++i) {
      const double angle = swept * i / kArcSteps;
      arc.points.emplace_back(kArcRadius_m * std::cos(angle), kArcRadius_m * std::sin(angle), 0.0);
    }
    entity.lines.push_back(std::move(arc));
  }
  return entity;
}

Entity contact_ball(const log::ContactRow& contact, std::uint32_t number) {
  constexpr double kDiameter_m = 0.1;
  return {.frame = frames::kWorld,
          .id = "contact " + std::to_string(number),
          .balls = {{to_vec3(contact.position_m), kDiameter_m, kContactColour}}};
}

Entity submap_stars(const log::MapAnswer& map) {
  std::unordered_map<log::LandmarkId, Vec3> points, planes;
  for (const log::MapLandmark& landmark : map.landmarks) {
    if (landmark.status == log::LandmarkStatus::kMapped) points[landmark.id] = to_vec3(landmark.position_m);
  }
  for (const log::PlaneLandmark& plane : map.planes) {
    if (plane.status == log::LandmarkStatus::kMapped) planes[plane.id] = middle_of(plane);
  }
  struct Star {
    std::vector<Vec3> points, planes;
  };
  std::map<std::uint64_t, Star> stars;
  for (const log::IdPair& member : map.submap_members) {
    if (const auto place = points.find(member.second); place != points.end())
      stars[member.first].points.push_back(place->second);
    if (const auto place = planes.find(member.second); place != planes.end())
      stars[member.first].planes.push_back(place->second);
  }
  std::unordered_map<std::uint64_t, Vec3> origins;
  for (const log::SubmapPose& submap : map.submaps) origins[submap.id] = to_vec3(submap.position_m);
  Entity entity{.frame = frames::kMap, .id = "submaps"};
  std::size_t n = 0;
  for (const auto& [submap, joined] : stars) {
    const Colour& colour = kSubmapColours[n++ % kSubmapColours.size()];
    if (!joined.points.empty()) entity.lines.push_back(star(middle_of(joined.points), joined.points, colour));
    const auto origin = origins.find(submap);
    if (!joined.planes.empty())
      entity.lines.push_back(
          star(origin != origins.end() ? origin->second : middle_of(joined.planes), joined.planes, colour));
  }
  return entity;
}

}  // namespace hallway::foxglove
