// SPDX-License-Identifier: MIT
#include "run/pictures/plane_layers.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <unordered_map>

#include "geom/arrays.hpp"
#include "render/colour.hpp"

namespace hallway::run {
namespace {

/// More mapped planes than this have no numbers in a picture.
constexpr std::ptrdiff_t kMostNumbers = 80;

template <std::size_t N>
Vec3 middle_of(const std::array<Vec3, N>& points) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& point : points) middle += point / static_cast<double>(N);
  return middle;
}

Vec3 middle_of(const log::PlaneLandmark& plane) {
  Vec3 middle = Vec3::Zero();
  for (const log::OutlineCorner& corner : plane.outline)
    middle += to_vec3(corner.position_m) / static_cast<double>(plane.outline.size());
  return middle;
}

void add_true_planes(render::Picture& picture, const Record& record) {
  render::Segments planes{
      .colour = render::palette::kTruth, .width_px = 5.0, .opacity = 0.45, .label = "true walls"};
  for (const log::TruePlane& plane : record.true_planes) {
    const auto outline = plane.outline();
    for (std::size_t i = 0; i < outline.size(); ++i)
      planes.pairs.push_back({to_vec3(outline[i]), to_vec3(outline[(i + 1) % outline.size()])});
  }
  if (!planes.pairs.empty()) picture.segments.push_back(std::move(planes));
}

/// The outlines of planes of one status, and dots at those of their ends that are certain.
void add_mapped(render::Picture& picture, const Record& record, const Pose& T_world_map, bool temporary) {
  render::Segments outlines{.colour = temporary ? render::palette::kMutedInk : render::palette::kEstimate,
                            .width_px = temporary ? 1.0 : 2.0,
                            .label = temporary ? "temporary walls" : "mapped walls"};
  render::Markers ends{.colour = outlines.colour, .size_px = 6.0, .label = temporary ? "" : "certain ends"};
  for (const log::PlaneLandmark& plane : record.planes) {
    if ((plane.status == log::LandmarkStatus::kTemporary) != temporary) continue;
    const std::size_t n = plane.outline.size();
    for (std::size_t i = 0; i < n; ++i) {
      const std::array<Vec3, 2> edge{T_world_map * to_vec3(plane.outline[i].position_m),
                                     T_world_map * to_vec3(plane.outline[(i + 1) % n].position_m)};
      outlines.pairs.push_back(edge);
      if (plane.outline[i].edge_certain) ends.positions.push_back(middle_of(edge));
    }
  }
  if (!outlines.pairs.empty()) picture.segments.push_back(std::move(outlines));
  if (!ends.positions.empty()) picture.markers.push_back(std::move(ends));
}

void add_stars(render::Picture& picture, const Record& record, const Pose& T_world_map) {
  std::unordered_map<std::uint64_t, Vec3> middles;
  for (const log::PlaneLandmark& plane : record.planes) {
    if (plane.status == log::LandmarkStatus::kMapped) middles[plane.id] = T_world_map * middle_of(plane);
  }
  std::map<std::uint64_t, std::vector<std::uint64_t>> members;
  for (const log::IdPair& member : record.submaps) members[member.first].push_back(member.second);
  for (const log::SubmapPose& submap : record.submap_poses) {
    const Vec3 origin = T_world_map * to_vec3(submap.position_m);
    render::Segments star{.colour = render::submap_colour(submap.id), .opacity = 0.45};
    for (const std::uint64_t member : members[submap.id]) {
      if (const auto middle = middles.find(member); middle != middles.end())
        star.pairs.push_back({origin, middle->second});
    }
    if (star.pairs.empty()) continue;
    picture.markers.push_back({.positions = {origin},
                               .shape = render::MarkerShape::kDiamond,
                               .colour = star.colour,
                               .size_px = 7.0});
    picture.segments.push_back(std::move(star));
  }
}

void add_numbers(render::Picture& picture, const Record& record, const Pose& T_world_map) {
  const auto is_mapped = [](const log::PlaneLandmark& plane) {
    return plane.status == log::LandmarkStatus::kMapped;
  };
  const auto mapped = std::count_if(record.planes.begin(), record.planes.end(), is_mapped);
  if (mapped > kMostNumbers) return;
  for (const log::PlaneLandmark& plane : record.planes) {
    if (is_mapped(plane))
      picture.labels.push_back(
          {.position = T_world_map * middle_of(plane), .text = std::to_string(plane.id)});
  }
}

}  // namespace

void add_planes(render::Picture& picture, const Record& record, const sim::PictureSpec& spec,
                const Pose& T_world_map) {
  if (record.planes.empty()) return;
  if (spec.shows(sim::PictureLayer::kTruth)) add_true_planes(picture, record);
  if (spec.shows(sim::PictureLayer::kSubmaps)) add_stars(picture, record, T_world_map);
  if (!spec.shows(sim::PictureLayer::kPlanes)) return;
  for (const bool temporary : {true, false}) add_mapped(picture, record, T_world_map, temporary);
  if (spec.shows(sim::PictureLayer::kSubmaps)) add_numbers(picture, record, T_world_map);
}

}  // namespace hallway::run
