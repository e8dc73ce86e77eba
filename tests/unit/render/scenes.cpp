// SPDX-License-Identifier: MIT
#include "unit/render/scenes.hpp"

#include <cmath>
#include <numbers>

#include "base/random.hpp"

namespace hallway::render::test {
namespace {

Surface face(std::vector<Vec3> corners, Rgb colour) {
  Surface out;
  const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  out.polygon.plane = {normal, normal.dot(corners[0])};
  out.polygon.vertices = std::move(corners);
  out.colour = colour;
  return out;
}

constexpr double kWallHeight = 2.6;
constexpr double kThickness = 0.15;

void wall(std::vector<Surface>& out, double x0, double y0, double x1, double y1) {
  const double h = 0.5 * kThickness;
  add_box(out, {x0 - h, y0 - h, 0.0}, {x1 + h, y1 + h, kWallHeight}, material_colour("wall/plaster"));
}

std::vector<Vec3> noisy(const std::vector<Vec3>& points, double sigma, double drift, const char* stream) {
  const Random random(7, stream_id(stream));
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto n = [&](std::uint64_t axis) {
      return sigma * random.normal(static_cast<std::uint32_t>(i), axis);
    };
    const double along = drift * static_cast<double>(i) / static_cast<double>(points.size());
    out.push_back(points[i] + Vec3(n(0) + along, n(1) - 0.6 * along, n(2)));
  }
  return out;
}

std::vector<std::array<Vec3, 2>> pairs(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  std::vector<std::array<Vec3, 2>> out;
  for (std::size_t i = 0; i < a.size(); ++i) out.push_back({a[i], b[i]});
  return out;
}

void add_run(Picture& picture, const std::vector<Vec3>& path, const std::vector<Vec3>& estimate,
             const std::vector<Vec3>& landmarks, const std::vector<Vec3>& mapped, double dot_px) {
  picture.segments.push_back({pairs(landmarks, mapped), palette::kError, 1.2, 0.9, "landmark error"});
  picture.polylines.push_back({path, palette::kTruth, 4.0, false, "true path"});
  picture.polylines.push_back({estimate, palette::kEstimate, 1.8, false, "estimated path"});
  picture.markers.push_back({landmarks, MarkerShape::kRing, palette::kTruth, 1.7 * dot_px, "true landmark"});
  picture.markers.push_back({mapped, MarkerShape::kDot, palette::kEstimate, dot_px, "mapped landmark"});
}

void add_office_walls(std::vector<Surface>& s) {
  add_box(s, {-0.2, -0.2, -0.2}, {16.2, 10.2, 0.0}, material_colour("floor"));
  add_box(s, {-0.2, -0.2, kWallHeight}, {16.2, 10.2, kWallHeight + 0.2}, material_colour("ceiling"));
  wall(s, 0, 0, 16, 0);
  wall(s, 0, 10, 16, 10);
  wall(s, 0, 0, 0, 10);
  wall(s, 16, 0, 16, 10);
  for (const double y : {4.2, 5.8}) {
    wall(s, 0, y, 1.6, y);
    wall(s, 2.6, y, 7.0, y);
    wall(s, 8.0, y, 12.6, y);
    wall(s, 13.6, y, 16, y);
  }
  for (const double x : {5.3, 10.6}) {
    wall(s, x, 0, x, 4.2);
    wall(s, x, 5.8, x, 10);
  }
}

void add_furniture(std::vector<Surface>& s) {
  const Rgb wood = material_colour("desk");
  add_box(s, {0.5, 0.5, 0.0}, {2.1, 1.3, 0.75}, wood);
  add_box(s, {3.2, 2.0, 0.0}, {4.8, 2.8, 0.75}, wood);
  add_box(s, {6.2, 1.2, 0.0}, {9.4, 2.4, 0.75}, wood);
  add_box(s, {11.2, 0.3, 0.0}, {15.4, 0.8, 1.9}, material_colour("shelf"));
  add_box(s, {12.2, 2.0, 0.0}, {13.8, 2.9, 0.75}, wood);
  add_box(s, {0.4, 8.6, 0.0}, {2.0, 9.5, 0.75}, wood);
  add_box(s, {6.0, 9.0, 0.0}, {9.8, 9.6, 1.0}, material_colour("cabinet"));
  add_box(s, {13.0, 7.6, 0.0}, {13.5, 8.1, kWallHeight}, material_colour("column"));
}

}  // namespace

void add_box(std::vector<Surface>& out, const Vec3& l, const Vec3& h, Rgb colour) {
  const auto at = [&](int x, int y, int z) {
    return Vec3(x ? h.x() : l.x(), y ? h.y() : l.y(), z ? h.z() : l.z());
  };
  out.push_back(face({at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)}, colour));
  out.push_back(face({at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0)}, colour));
  out.push_back(face({at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0)}, colour));
  out.push_back(face({at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)}, colour));
  out.push_back(face({at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)}, colour));
  out.push_back(face({at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)}, colour));
}

Picture office() {
  Picture picture;
  picture.title = "office";
  picture.subtitle = "420 steps, seed 1, slam_point: aligned landmark error 0.021 m";
  add_office_walls(picture.surfaces);
  add_furniture(picture.surfaces);
  const std::vector<Vec3> corners{{2.1, 3.2, 0.4},  {2.1, 5.0, 0.4},  {7.5, 5.0, 0.4},
                                  {7.5, 7.4, 0.4},  {7.5, 5.0, 0.4},  {13.1, 5.0, 0.4},
                                  {13.1, 3.4, 0.4}, {13.1, 6.8, 0.4}, {14.6, 7.2, 0.4}};
  std::vector<Vec3> path;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    for (int k = 0; k < 20; ++k) path.push_back(corners[i - 1] + (k / 20.0) * (corners[i] - corners[i - 1]));
  }
  const Random random(3, stream_id("test.landmarks"));
  std::vector<Vec3> landmarks;
  for (std::uint32_t i = 0; i < 160; ++i) {
    const double along = random.uniform(i, 0, 0.2, 15.8);
    const double z = random.uniform(i, 1, 0.2, 2.4);
    constexpr std::array<double, 4> kWalls{0.08, 4.28, 5.72, 9.92};
    landmarks.emplace_back(along, kWalls[i % 4], z);
  }
  const std::vector<Vec3> mapped = noisy(landmarks, 0.05, 0.1, "test.mapped");
  add_run(picture, path, noisy(path, 0.012, 0.15, "test.estimate"), landmarks, mapped, 4.5);
  picture.frustums.push_back(FrustumMark{look_along({13.1, 6.8, 0.4}, {1.0, 0.35, 0.0}), 1.5, 0.9, 3.0,
                                         palette::kSensor, "field of view"});
  picture.labels = {{{2.6, 1.8, 0.1}, "room 1"}, {{7.9, 3.2, 0.1}, "room 2"}, {{2.1, 3.2, 0.4}, "start"}};
  return picture;
}

Picture figure_eight() {
  Picture picture;
  picture.title = "figure_eight";
  picture.subtitle = "3800 steps, seed 1";
  std::vector<Vec3> path;
  const double size = 218.0;
  for (int i = 0; i <= 3800; ++i) {
    const double t = 2.0 * std::numbers::pi * i / 3800.0 + 0.5 * std::numbers::pi;
    const double d = 1.0 + std::sin(t) * std::sin(t);
    path.emplace_back(-size * std::cos(t) / d, -size * std::sin(t) * std::cos(t) / d,
                      6.0 * (1.0 - std::cos(2.0 * std::numbers::pi * i / 3800.0)));
  }
  const Random random(5, stream_id("test.cloud"));
  std::vector<Vec3> landmarks;
  for (std::uint32_t i = 0; i < 1145; ++i) {
    const Vec3& at = path[i * path.size() / 1145];
    landmarks.push_back(
        at + Vec3(random.uniform(i, 0, -15, 15), random.uniform(i, 1, -15, 15), random.uniform(i, 2, -5, 5)));
  }
  const std::vector<Vec3> mapped = noisy(landmarks, 0.3, 3.0, "test.mapped");
  for (std::size_t submap = 0; submap < 20; ++submap) {
    Segments links;
    const Vec3& centre = path[submap * 190 + 95];
    for (std::size_t i = submap * 57; i < submap * 57 + 57; ++i) links.pairs.push_back({centre, mapped[i]});
    links.colour = submap_colour(submap);
    links.opacity = 0.55;
    if (submap == 0) links.label = "submap members";
    picture.segments.push_back(links);
  }
  add_run(picture, path, noisy(path, 0.05, 3.0, "test.estimate"), landmarks, mapped, 3.0);
  picture.frustums.push_back(FrustumMark{look_along(path[1500], path[1501] - path[1500]), 1.5708, 1.0472,
                                         100.0, palette::kSensor, "field of view"});
  picture.labels = {{path.front(), "start"}, {path.back(), "end"}};
  return picture;
}

}  // namespace hallway::render::test
