// SPDX-License-Identifier: MIT
#include "run/pictures/landmark_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <unordered_set>
#include <utility>
#include <vector>

#include "geom/box.hpp"
#include "render/colour.hpp"

namespace hallway::run {
namespace {

/// From the true to the mapped place of every matched landmark.
std::vector<std::array<Vec3, 2>> error_lines(const Record& record, const LandmarkPlaces& mapped) {
  LandmarkPlaces truth;
  for (const log::Landmark& landmark : record.true_landmarks)
    truth[landmark.id] = Vec3(landmark.position_m.data());
  std::vector<std::array<Vec3, 2>> lines;
  for (const log::IdPair& match : record.matches) {
    const auto estimate = mapped.find(match.first);
    const auto true_place = truth.find(match.second);
    if (estimate != mapped.end() && true_place != truth.end())
      lines.push_back({true_place->second, estimate->second});
  }
  return lines;
}

/// The power of ten by which lines have to be longer to be seen in a picture of this extent.
double scale_for(const std::vector<std::array<Vec3, 2>>& lines, double extent_m) {
  double sum = 0.0;
  for (const auto& line : lines) sum += (line[1] - line[0]).squaredNorm();
  const double rms = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(lines.size(), 1)));
  constexpr double kVisibleShare = 0.006;  // of the extent: some 7 px in a picture of 1200
  double scale = 1.0;
  while (rms > 0.0 && rms * scale * 3.0 < kVisibleShare * extent_m && scale < 1e6) scale *= 10.0;
  return scale;
}

/// Of true and mapped landmarks.
Box extent_of(const Record& record, const LandmarkPlaces& mapped) {
  Box extent;
  for (const auto& [id, place] : mapped) extent.extend(place);
  for (const log::Landmark& landmark : record.true_landmarks) extent.extend(Vec3(landmark.position_m.data()));
  return extent;
}

void add_submaps(render::Picture& picture, const Record& record, const LandmarkPlaces& mapped) {
  std::map<std::uint64_t, std::vector<Vec3>> members;
  for (const log::IdPair& member : record.submaps) {
    const auto place = mapped.find(member.second);
    if (place != mapped.end()) members[member.first].push_back(place->second);
  }
  for (const auto& [submap, places] : members) {
    Vec3 centre = Vec3::Zero();
    for (const Vec3& place : places) centre += place / static_cast<double>(places.size());
    render::Segments links{.colour = render::submap_colour(submap), .width_px = 0.8, .opacity = 0.22};
    for (const Vec3& place : places) links.pairs.push_back({centre, place});
    picture.segments.push_back(std::move(links));
  }
}

/// The marks of true landmarks, without any place.
render::Markers true_rings() {
  return {.shape = render::MarkerShape::kRing,
          .colour = render::palette::kTruth,
          .size_px = 7.0,
          .label = "true landmarks"};
}

/// Adds marks where there are any.
void add_marks(render::Picture& picture, render::Markers&& markers) {
  if (!markers.positions.empty()) picture.markers.push_back(std::move(markers));
}

}  // namespace

std::optional<double> error_scale_of(const Record& record, const Pose& T_world_map) {
  const LandmarkPlaces mapped = mapped_places(record, T_world_map);
  const auto lines = error_lines(record, mapped);
  if (lines.empty()) return std::nullopt;
  return scale_for(lines, extent_of(record, mapped).diagonal().norm());
}

LandmarkPlaces mapped_places(const Record& record, const Pose& T_world_map) {
  LandmarkPlaces places;
  for (const log::MapLandmark& landmark : record.landmarks) {
    if (landmark.status == log::LandmarkStatus::kMapped) {
      places[landmark.id] = T_world_map * Vec3(landmark.position_m.data());
    }
  }
  return places;
}

void add_landmarks(render::Picture& picture, const Record& record, const sim::PictureSpec& spec,
                   const Pose& T_world_map, std::optional<double> error_scale) {
  if (record.landmarks.empty() && !record.planes.empty()) return;  // what was mapped are walls
  const LandmarkPlaces mapped = mapped_places(record, T_world_map);
  const Box extent = extent_of(record, mapped);
  render::Markers estimates{
      .colour = render::palette::kEstimate, .size_px = 4.0, .label = "mapped landmarks"};
  for (const log::MapLandmark& landmark :
       record.landmarks) {  // in the file's order, so that the picture is the same
    const auto place = mapped.find(landmark.id);
    if (place == mapped.end()) continue;
    estimates.positions.push_back(place->second);
  }
  std::unordered_set<log::LandmarkId> mapped_truths;
  for (const log::IdPair& match : record.matches) {
    if (mapped.contains(match.first)) mapped_truths.insert(match.second);
  }
  render::Markers truth = true_rings();
  render::Markers others{.colour = render::palette::kMutedInk, .size_px = 1.8, .label = "not mapped"};
  for (const log::Landmark& landmark : record.true_landmarks) {
    auto& markers = mapped_truths.contains(landmark.id) ? truth : others;
    markers.positions.push_back(Vec3(landmark.position_m.data()));
  }
  if (spec.shows(sim::PictureLayer::kSubmaps)) add_submaps(picture, record, mapped);
  if (spec.shows(sim::PictureLayer::kErrors) && !extent.isEmpty()) {
    const bool is_diverged = record.metrics.value("verdict", nlohmann::ordered_json()) == "diverged";
    // Such lines say no more than the verdict, and would cover everything.
    render::Segments errors{
        .pairs = is_diverged ? decltype(render::Segments::pairs){} : error_lines(record, mapped),
        .colour = render::palette::kError,
        .width_px = 1.4,
        .opacity = 0.9};
    const double scale = error_scale ? *error_scale : scale_for(errors.pairs, extent.diagonal().norm());
    for (auto& line : errors.pairs) line[1] = line[0] + scale * (line[1] - line[0]);
    errors.label = scale > 1.0 ? fmt::format("landmark error × {:.0f}", scale) : "landmark error";
    if (!errors.pairs.empty()) picture.segments.push_back(std::move(errors));
  }
  if (spec.shows(sim::PictureLayer::kTruth)) {
    add_marks(picture, std::move(others));
    add_marks(picture, std::move(truth));
  }
  if (spec.shows(sim::PictureLayer::kLandmarks)) add_marks(picture, std::move(estimates));
}

void add_true_landmarks(render::Picture& picture, const Record& record) {
  render::Markers truth = true_rings();
  for (const log::Landmark& landmark : record.true_landmarks)
    truth.positions.push_back(Vec3(landmark.position_m.data()));
  add_marks(picture, std::move(truth));
}

}  // namespace hallway::run
