// SPDX-License-Identifier: MIT
#include "run/pictures/pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "base/file.hpp"
#include "log/observations.hpp"
#include "log/plane_observations.hpp"
#include "log/poses.hpp"
#include "render/colour.hpp"
#include "render/draw.hpp"
#include "run/pictures/plane_layers.hpp"

namespace hallway::run {
namespace {

namespace fs = std::filesystem;
using sim::PictureLayer;

Vec3 place_in(const Pose& T, const std::array<double, 3>& v) {
  return T * Vec3(v.data());
}

/// Largest z of the normal of a plane that counts as upright: floors would cover all else.
constexpr double kUpright = 0.5;

/// What one frame saw and which upright planes were found in it, world.
struct Moment {
  std::uint32_t iteration = 0;
  std::vector<Vec3> points;
  std::vector<std::array<Vec3, 4>> planes;
};

/// The first of the frames with the most planes; frame 0 where none were found.
std::uint32_t fullest_frame(const std::vector<log::IterationPlane>& planes) {
  std::map<std::uint32_t, std::size_t> count;
  for (const log::IterationPlane& plane : planes) ++count[plane.iteration];
  const auto most = std::max_element(count.begin(), count.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == count.end() ? 0 : most->first;
}

std::optional<Pose> true_pose(const fs::path& folder, std::uint32_t iteration) {
  const fs::path file = folder / files::kTruePoses;
  if (!fs::exists(file)) return std::nullopt;
  for (const log::IterationPose& pose : log::read_poses(file)) {
    if (pose.iteration != iteration) continue;
    return pose_of(log::StampedPose{.position_m = pose.position_m, .orientation = pose.orientation});
  }
  return std::nullopt;
}

Moment read_moment(const Record& record) {
  const fs::path& folder = record.folder;
  Moment moment;
  std::vector<log::IterationPlane> planes;
  const fs::path found = folder / files::kFoundPlanes, seen = folder / files::kObservations;
  if (fs::exists(found)) planes = log::parse_planes(read_file(found), found.string());
  moment.iteration = fullest_frame(planes);
  const std::optional<Pose> T_world_body = true_pose(folder, moment.iteration);
  if (!T_world_body) return moment;
  const Pose T_world_sensor = *T_world_body * mount_of(sensor_of(record));
  for (const log::IterationPlane& plane : planes) {
    if (plane.iteration != moment.iteration || std::abs(plane.plane.normal[2]) > kUpright) continue;
    std::array<Vec3, 4>& corners = moment.planes.emplace_back();
    for (std::size_t i = 0; i < 4; ++i) corners[i] = place_in(T_world_sensor, plane.plane.corners_m[i]);
  }
  if (!fs::exists(seen)) return moment;
  const log::ReadLog log = log::parse_observations(read_file(seen), seen.string());
  for (const log::Observation& point : log.log.frame(moment.iteration))
    moment.points.push_back(place_in(T_world_sensor, point.point));
  return moment;
}

sim::PictureSpec layers(std::vector<PictureLayer> show) {
  sim::PictureSpec spec;
  spec.show = std::move(show);
  return spec;
}

/// A panel with the true planes, which all four have, so that they show the same part of the world.
render::Picture panel(const Record& record, std::string title, std::string subtitle) {
  render::Picture picture;
  picture.title = std::move(title);
  picture.subtitle = std::move(subtitle);
  add_planes(picture, record, layers({PictureLayer::kTruth}), Pose());
  return picture;
}

render::Picture points_panel(const Record& record, const Moment& moment) {
  render::Picture picture =
      panel(record, "points in view", fmt::format("{} in frame {}", moment.points.size(), moment.iteration));
  picture.markers.push_back({.positions = moment.points,
                             .shape = render::MarkerShape::kDot,
                             .colour = render::palette::kSensor,
                             .size_px = 1.8,
                             .label = "points"});
  return picture;
}

render::Picture planes_panel(const Record& record, const Moment& moment) {
  render::Picture picture = panel(record, "upright planes found",
                                  fmt::format("{} in frame {}", moment.planes.size(), moment.iteration));
  for (std::size_t i = 0; i < moment.planes.size(); ++i) {
    render::Segments outline{.colour = render::submap_colour(i), .width_px = 2.0};
    for (std::size_t k = 0; k < 4; ++k)
      outline.pairs.push_back({moment.planes[i][k], moment.planes[i][(k + 1) % 4]});
    picture.segments.push_back(std::move(outline));
  }
  return picture;
}

}  // namespace

render::Image draw_panels(const Record& record, const sim::PictureSpec& spec, render::Renderer renderer) {
  const Moment moment = read_moment(record);
  sim::PictureSpec plain = layers({PictureLayer::kTruth, PictureLayer::kEstimate, PictureLayer::kPlanes});
  render::Picture truth_and_map = compose_picture(record, plain);
  render::Picture map = compose_picture(record, layers({PictureLayer::kPlanes, PictureLayer::kSubmaps}));
  map.title = "the map and its submaps";
  map.subtitle.clear();
  const render::Picture panels[] = {std::move(truth_and_map), points_panel(record, moment),
                                    planes_panel(record, moment), std::move(map)};
  const int width = spec.width_px / 2, height = spec.height_px / 2;
  render::check_image_size(width, height);
  render::Image image = render::blank_image(2 * width, 2 * height);
  for (int i = 0; i < 4; ++i) {
    const render::View view{.renderer = renderer};
    render::paste(render::draw(panels[i], view, width, height), (i % 2) * width, (i / 2) * height, image);
  }
  return image;
}

}  // namespace hallway::run
