// SPDX-License-Identifier: MIT
#include "unit/slam_plane/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/random.hpp"

namespace hallway::slam_plane::test {
namespace {

using Interval = std::pair<double, double>;  // of the share of the way from a to b

/// Walls of a closed outline. Inside on the left of the way round: seen from there.
void add_outline(std::vector<TrueWall>& walls, const std::vector<Vec2>& corners) {
  for (std::size_t i = 0; i < corners.size(); ++i)
    walls.push_back({corners[(i + 1) % corners.size()], corners[i]});
}

/// The same seen from outside of it; corners counter-clockwise.
void add_block(std::vector<TrueWall>& walls, std::vector<Vec2> corners) {
  std::reverse(corners.begin(), corners.end());
  add_outline(walls, corners);
}

void add_box(std::vector<TrueWall>& walls, double x0, double y0, double x1, double y1) {
  add_block(walls, {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}

/// A niche in an outline's straight side: from `from` to `to` along the side a->b, `depth` to the right of it (outwards).
struct Niche {
  double from, to, depth;
};

void add_side(std::vector<Vec2>& outline, const Vec2& a, const Vec2& b, const std::vector<Niche>& niches) {
  const Vec2 d = (b - a).normalized();
  const Vec2 out = -left_of(d);
  outline.push_back(a);
  for (const Niche& niche : niches) {
    outline.push_back(a + niche.from * d);
    outline.push_back(a + niche.from * d + niche.depth * out);
    outline.push_back(a + niche.to * d + niche.depth * out);
    outline.push_back(a + niche.to * d);
  }
}

/// Keeps the part of [0, 1] where f0 + t (f1 - f0) >= 0.
bool clip(double f0, double f1, Interval& part) {
  if (f0 < 0.0 && f1 < 0.0) return false;
  const double t = f0 / (f0 - f1);
  if (f0 < 0.0) part.first = std::max(part.first, t);
  if (f1 < 0.0) part.second = std::min(part.second, t);
  return part.first < part.second;
}

bool clip_to_view(const View& view, const Vec2& a, const Vec2& b, Interval& part) {
  if (view.horizontal_fov_rad < std::numbers::pi) {
    const double half = 0.5 * view.horizontal_fov_rad;
    const Vec2 left(std::sin(half), -std::cos(half));  // inwards of the left side
    const Vec2 right(std::sin(half), std::cos(half));
    if (!clip(left.dot(a), left.dot(b), part) || !clip(right.dot(a), right.dot(b), part)) return false;
  }
  if (view.max_range_m <= 0.0) return true;
  if (!view.range_bounds_sides) return clip(view.max_range_m - a.x(), view.max_range_m - b.x(), part);
  // |a + t d|^2 <= r^2
  const Vec2 d = b - a;
  const double A = d.squaredNorm(), B = a.dot(d), C = a.squaredNorm() - view.max_range_m * view.max_range_m;
  const double root2 = B * B - A * C;
  if (root2 <= 0.0) return false;
  part.first = std::max(part.first, (-B - std::sqrt(root2)) / A);
  part.second = std::min(part.second, (-B + std::sqrt(root2)) / A);
  return part.first < part.second;
}

/// Takes from the parts of a->b what c->d hides from the origin.
void hide(const Vec2& a, const Vec2& b, Vec2 c, Vec2 d, std::vector<Interval>& parts) {
  constexpr double kEps = 1e-9;
  const double na = cross(a, b);
  // The shadow: behind the segment, between the rays through its ends. Only what of the segment is before a->b counts.
  if (cross(c, d) > 0.0) std::swap(c, d);
  Interval shadow{0.0, 1.0};
  // Rays: right of the ray through c, left of the ray through d.
  if (!clip(-cross(c, a), -cross(c, b), shadow) || !clip(cross(d, a), cross(d, b), shadow)) return;
  const Vec2 e = d - c;
  const double side = cross(e, -c);  // of the origin
  const double fa = -cross(e, a - c) * (side > 0.0 ? 1.0 : -1.0) - kEps;
  const double fb = -cross(e, b - c) * (side > 0.0 ? 1.0 : -1.0) - kEps;
  if (std::abs(side) < kEps || std::abs(na) < kEps || !clip(fa, fb, shadow)) return;
  if (shadow.second - shadow.first < kEps) return;
  std::vector<Interval> left;
  for (const Interval& part : parts) {
    if (shadow.first > part.first) left.emplace_back(part.first, std::min(part.second, shadow.first));
    if (shadow.second < part.second) left.emplace_back(std::max(part.first, shadow.second), part.second);
  }
  std::erase_if(left, [](const Interval& part) { return part.second - part.first < 1e-6; });
  parts = std::move(left);
}

struct Noise3 {
  double across, turn, along, end_a, end_b;
};

WallObservation observation_with_noise(const Vec2& a, const Vec2& b, const Noise3& noise) {
  const Vec2 d = (b - a).normalized();
  const Vec2 middle = 0.5 * (a + b) + noise.across * left_of(d);
  const Vec2 turned = Pose2::at(Vec2::Zero(), noise.turn).rotate(d);
  const double half = 0.5 * (b - a).norm();
  return {middle + (-half + noise.along + noise.end_a) * turned,
          middle + (half + noise.along + noise.end_b) * turned, 0.0, 2.5};
}

}  // namespace

std::vector<Pose2> drive(const std::vector<Vec2>& corners, double step_m, double turn_rad, int pause) {
  std::vector<Pose2> path;
  Vec2 at = corners.front();
  Vec2 direction = (corners[1] - corners[0]).normalized();
  double heading = std::atan2(direction.y(), direction.x());
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Vec2 way = corners[i] - at;
    const double turn = std::remainder(std::atan2(way.y(), way.x()) - heading, 2.0 * std::numbers::pi);
    const int turns = static_cast<int>(std::ceil(std::abs(turn) / turn_rad));
    for (int k = 1; k <= turns; ++k) path.push_back(Pose2::at(at, heading + turn * k / turns));
    heading += turn;
    const int steps = static_cast<int>(std::ceil(way.norm() / step_m));
    for (int k = 1; k <= steps; ++k)
      path.push_back(Pose2::at(at + way * (static_cast<double>(k) / steps), heading));
    at = corners[i];
    for (int k = 0; k < pause; ++k) path.push_back(Pose2::at(at, heading));
  }
  return path;
}

Scene four_walls(int frames) {
  Scene scene{"four_walls", {}, {}};
  add_outline(scene.walls, {{-5, -4}, {5, -4}, {5, 4}, {-5, 4}});
  for (int i = 0; i < frames; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 250.0;
    scene.path.push_back(
        Pose2::at(Vec2(2.0 * std::cos(angle), 1.5 * std::sin(angle)), angle + std::numbers::pi / 2.0));
  }
  return scene;
}

Scene corridor_loop(int laps) {
  Scene scene{"corridor_loop", {}, {}};
  // Outer 30 x 20, corridor 2.4 wide about a block; niches (doors) in both outlines at uneven places, one where each side ends.
  std::vector<Vec2> outer, inner;
  add_side(outer, {0, 0}, {30, 0},
           {{1.7, 2.7, 0.3}, {9.5, 10.5, 0.3}, {17.0, 18.2, 0.25}, {24.0, 25.0, 0.3}});
  add_side(outer, {30, 0}, {30, 20}, {{1.7, 2.7, 0.3}, {12.0, 13.0, 0.4}});
  add_side(outer, {30, 20}, {0, 20},
           {{1.7, 2.7, 0.3}, {11.0, 12.0, 0.3}, {15.5, 16.5, 0.25}, {23.0, 24.2, 0.3}});
  add_side(outer, {0, 20}, {0, 0}, {{1.7, 2.7, 0.3}, {11.5, 12.7, 0.3}});
  add_outline(scene.walls, outer);
  // The block's outline clockwise, so that the corridor is on its left; niches go into the block.
  add_side(inner, {2.4, 2.4}, {2.4, 17.6}, {{4.0, 5.0, 0.3}, {9.0, 10.0, 0.3}, {12.5, 13.5, 0.3}});
  add_side(inner, {2.4, 17.6}, {27.6, 17.6}, {{5.0, 6.0, 0.3}, {11.0, 12.0, 0.3}, {16.0, 17.0, 0.3}});
  add_side(inner, {27.6, 17.6}, {27.6, 2.4}, {{2.5, 3.7, 0.3}, {6.5, 7.5, 0.3}});
  add_side(inner, {27.6, 2.4}, {2.4, 2.4}, {{6.0, 7.0, 0.3}, {14.5, 15.5, 0.3}});
  add_outline(scene.walls, inner);
  // Pillars.
  add_box(scene.walls, 13.0, 0.15, 13.4, 0.55);
  add_box(scene.walls, 29.4, 8.5, 29.8, 8.9);
  add_box(scene.walls, 7.0, 19.4, 7.4, 19.8);
  add_box(scene.walls, 0.2, 13.6, 0.6, 14.0);
  std::vector<Vec2> corners{{3.0, 1.3}};
  for (int i = 0; i < laps; ++i) {
    corners.push_back({28.8, 1.2});
    corners.push_back({28.7, 18.8});
    corners.push_back({1.2, 18.7});
    corners.push_back({1.3, 1.2});
  }
  corners.push_back({9.0, 1.3});
  scene.path = drive(corners, 0.08, 0.05, 10);
  return scene;
}

Scene corridor_return() {
  Scene scene{"corridor_return", {}, {}};
  std::vector<Vec2> outline;
  add_side(outline, {0, 0}, {22, 0}, {{3.0, 4.0, 0.3}, {8.0, 9.2, 0.3}, {14.0, 15.0, 0.25}});
  // The end opens into a hall whose far wall fills the view.
  outline.push_back({22, 0});
  outline.push_back({22, -7});
  outline.push_back({26, -7});
  outline.push_back({26, 10});
  outline.push_back({22, 10});
  add_side(outline, {22, 2.4}, {0, 2.4}, {{5.0, 6.0, 0.3}, {10.5, 11.5, 0.3}, {17.0, 18.0, 0.3}});
  outline.push_back({0, 2.4});
  add_outline(scene.walls, outline);
  add_box(scene.walls, 11.0, 0.1, 11.3, 0.4);
  scene.path = drive({{1.5, 1.2}, {24.0, 1.3}, {1.5, 1.2}}, 0.08, 0.05, 10);
  return scene;
}

Scene featureless_loop(int laps) {
  Scene scene{"featureless_loop", {}, {}};
  std::vector<Vec2> outer, inner;
  add_side(outer, {0, 0}, {40, 0},
           {{1.7, 2.7, 0.3}, {11.0, 12.0, 0.3}, {19.0, 20.2, 0.3}, {27.0, 28.0, 0.25}, {34, 35, 0.3}});
  add_side(outer, {40, 0}, {40, 18}, {{1.7, 2.7, 0.3}, {9.0, 10.0, 0.4}});
  add_side(outer, {40, 18}, {0, 18}, {{1.7, 2.7, 0.3}, {6.0, 7.0, 0.3}});
  add_side(outer, {0, 18}, {0, 0}, {{1.7, 2.7, 0.3}, {8.2, 9.4, 0.3}});
  add_outline(scene.walls, outer);
  add_side(inner, {2.4, 2.4}, {2.4, 15.6}, {{4.0, 5.0, 0.3}});
  add_side(inner, {2.4, 15.6}, {37.6, 15.6}, {});
  add_side(inner, {37.6, 15.6}, {37.6, 2.4}, {{5.0, 6.0, 0.3}});
  add_side(inner, {37.6, 2.4}, {2.4, 2.4}, {{6.0, 7.0, 0.3}, {14.5, 15.5, 0.3}, {24.0, 25.0, 0.3}});
  add_outline(scene.walls, inner);
  const auto add_path = [&](const std::vector<Vec2>& corners, double step) {
    const std::vector<Pose2> part = drive(corners, step, 0.05, 0);
    const double turn = scene.path.empty() ? 0.0 : angle_between(scene.path.back().r, part.front().r);
    const int turns = static_cast<int>(std::ceil(std::abs(turn) / 0.05));
    for (int k = 1; k <= turns; ++k) {
      const Pose2 last = scene.path.back();
      scene.path.push_back(last.moved(Vec2::Zero(), turn / turns));
    }
    scene.path.insert(scene.path.end(), part.begin(), part.end());
  };
  for (int i = 0; i < laps; ++i) {
    add_path({{i == 0 ? 5.0 : 1.2, 1.2}, {38.8, 1.2}, {38.8, 16.8}, {21.0, 16.8}}, 0.08);
    add_path({{21.0, 16.8}, {1.2, 16.8}}, 0.12);
    add_path({{1.2, 16.8}, {1.2, 1.2}}, 0.08);
  }
  add_path({{1.2, 1.2}, {12.0, 1.2}}, 0.08);
  return scene;
}

std::vector<TrueWall> Scene::walls_at(std::size_t frame) const {
  std::vector<TrueWall> now = walls;
  for (const Motion& motion : motions) {
    const std::size_t past = frame > motion.first ? std::min(frame - motion.first, motion.frames) : 0;
    const auto n = static_cast<double>(past);
    TrueWall& wall = now[motion.wall];
    const Vec2 reach = Pose2::at(Vec2::Zero(), n * motion.turn_rad).rotate(wall.b - wall.a);
    wall.a += n * motion.step;
    wall.b = wall.a + reach;
  }
  return now;
}

std::vector<TrueFrame> observe(const Scene& scene, const Sensor& sensor, std::uint64_t seed) {
  const Random random(seed, stream_id("slam_plane.scenes"));
  std::vector<TrueFrame> frames;
  for (std::uint32_t i = 0; i < scene.path.size(); ++i) {
    TrueFrame frame;
    frame.T_world_robot = scene.path[i];
    const Pose2 T_robot_world = scene.path[i].inverse();
    std::vector<TrueWall> local;
    for (const TrueWall& wall : scene.walls_at(i))
      local.push_back({T_robot_world * wall.a, T_robot_world * wall.b});
    std::uint64_t index = 0;
    for (std::size_t w = 0; w < local.size(); ++w) {
      const auto& [a, b] = local[w];
      if (cross(a, b) >= -1e-9) continue;  // seen from behind
      Interval whole{0.0, 1.0};
      if (!clip_to_view(sensor.view, a, b, whole)) continue;
      std::vector<Interval> parts{whole};
      for (std::size_t o = 0; o < local.size() && sensor.occlusion; ++o) {
        if (o != w) hide(a, b, local[o].a, local[o].b, parts);
      }
      for (const auto& [from, to] : parts) {
        const Vec2 p = a + from * (b - a);
        const Vec2 q = a + to * (b - a);
        if ((q - p).norm() < sensor.least_length_m) continue;
        const std::uint64_t key = 1000 * w + 10 * (index++ % 10);
        const Noise3 noise{
            sensor.noise_m * random.normal(i, key), sensor.noise_angle_rad * random.normal(i, key + 1),
            sensor.noise_along_m * random.normal(i, key + 2), sensor.noise_end_m * random.normal(i, key + 3),
            sensor.noise_end_m * random.normal(i, key + 4)};
        if (random.uniform(i, key + 5) < sensor.missed) continue;
        const WallObservation observation = observation_with_noise(p, q, noise);
        if (cross(observation.a, observation.b) >= 0.0) continue;
        frame.observations.push_back(observation);
        frame.wall.push_back(static_cast<int>(w));
        frame.corner[kEndA].push_back(from == 0.0);
        frame.corner[kEndB].push_back(to == 1.0);
      }
    }
    if (random.uniform(i, 5000000) < sensor.spurious) {
      const Vec2 middle(random.uniform(i, 5000001, 2.0, 8.0), random.uniform(i, 5000002, -2.0, 2.0));
      const double angle = random.uniform(i, 5000003, -0.7, 0.7) - std::numbers::pi / 2.0;
      const Vec2 half =
          Pose2::at(Vec2::Zero(), angle).rotate(Vec2(random.uniform(i, 5000004, 0.1, 1.0), 0.0));
      frame.observations.push_back({middle - half, middle + half, 0.0, 2.5});
      frame.wall.push_back(-1);
      frame.corner[kEndA].push_back(false);
      frame.corner[kEndB].push_back(false);
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

}  // namespace hallway::slam_plane::test
