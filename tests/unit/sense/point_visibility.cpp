// SPDX-License-Identifier: MIT
//
// What a sensor sees in a furnished room, against the definition written out with other means: angles by
// atan2, and solids as sets of half-spaces instead of triangles.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.hpp"
#include "sense/landmarks.hpp"
#include "sense/occluders.hpp"
#include "support/long_mode.hpp"
#include "unit/sense/map_text.hpp"
#include "unit/sense/sensor_fixture.hpp"

namespace hallway::sense {
namespace {

/// A room of 20 by 20 by 3 m with walls, floor and ceiling, and 25 boxes that stand, hang and overlap in it.
map::Document furnished_room() {
  std::vector<std::string> brushes = {
      test::box_brush({-10.1, -10.1, -0.1}, {10.1, 10.1, 0}),
      test::box_brush({-10.1, -10.1, 3}, {10.1, 10.1, 3.1}),
      test::box_brush({-10.1, -10.1, 0}, {-10, 10.1, 3}),
      test::box_brush({10, -10.1, 0}, {10.1, 10.1, 3}),
      test::box_brush({-10, -10.1, 0}, {10, -10, 3}),
      test::box_brush({-10, 10, 0}, {10, 10.1, 3}),
      test::box_brush({-0.001, -8, 0}, {0.001, 4, 2.5}),  // a partition of two millimetres
  };
  const Random random(17, stream_id("test"));
  for (std::uint64_t i = 0; i < 25; ++i) {
    const Vec3 low(random.uniform(0, 6 * i, -9.5, 8), random.uniform(0, 6 * i + 1, -9.5, 8),
                   random.uniform(0, 6 * i + 2, -0.5, 2));
    const Vec3 size(random.uniform(0, 6 * i + 3, 0.05, 2), random.uniform(0, 6 * i + 4, 0.05, 2),
                    random.uniform(0, 6 * i + 5, 0.05, 2));
    brushes.push_back(test::box_brush(low, low + size));
  }
  return test::parse_map(test::worldspawn({{"_points_per_m2", "2"}}, brushes));
}

/// Metres of the segment inside a solid; below zero if it passes by.
double inside_length(const map::Solid& solid, const Vec3& from, const Vec3& to) {
  double enter = 0.0;
  double leave = 1.0;
  for (const Plane& plane : solid.planes) {
    const double start = plane.distance(from);
    const double end = plane.distance(to);
    if (start > 0.0 && end > 0.0) return -std::min(start, end);
    if (start > 0.0) enter = std::max(enter, start / (start - end));
    if (end > 0.0) leave = std::min(leave, start / (start - end));
  }
  return (leave - enter) * (to - from).norm();
}

enum class Verdict { kSeen, kHidden, kUndecided };

Verdict verdict(const PointSensorSpec& spec, const map::World& world, const Pose& T_world_sensor,
                const Vec3& landmark) {
  constexpr double kClose = 1e-9;
  const Vec3 point = T_world_sensor.inverse() * landmark;
  const double azimuth = std::abs(std::atan2(point.y(), point.x())) - 0.5 * spec.horizontal_fov;
  const double elevation = std::abs(std::atan2(point.z(), point.x())) - 0.5 * spec.vertical_fov;
  const double outside =
      std::max({azimuth, elevation, point.norm() - spec.max_range_m, spec.min_range_m - point.norm()});
  if (outside > kClose) return Verdict::kHidden;
  bool undecided = outside > -kClose;
  for (const map::Solid& solid : world.solids) {
    const double length = inside_length(solid, landmark, T_world_sensor.t);
    if (length > kClose) return Verdict::kHidden;
    undecided = undecided || length > -kClose;
  }
  return undecided ? Verdict::kUndecided : Verdict::kSeen;
}

TEST(PointVisibility, IsWhatTheDefinitionSays) {
  const map::Document document = furnished_room();
  const map::World world = map::build_world(document);
  ASSERT_TRUE(world.problems.empty());
  const std::vector<Vec3> landmarks = make_landmarks(document, world, csg::build_surface(world));
  ASSERT_GT(landmarks.size(), 1000u);
  const trace::TriangleMesh occluders = make_occluders(csg::build_surface(world));
  const trace::Scene scene(occluders, trace::Backend::kBruteForce);
  PointSensorSpec spec = test::camera();
  spec.min_range_m = 0.5;
  spec.max_range_m = 12.0;
  spec.T_body_sensor = {from_yaw_pitch_roll(0.3, -0.1, 0.05), {0.1, -0.05, 0.4}};
  const LandmarkIndex landmark_index(landmarks);
  const PointSensor sensor(spec, landmark_index, scene, 5);

  const Random random(23, stream_id("test"));
  std::size_t seen_count = 0;
  std::size_t undecided_count = 0;
  const std::uint32_t frames = test::sized(60u, 2000u);
  for (std::uint32_t frame = 0; frame < frames; ++frame) {
    const auto draw = [&](std::uint64_t index, double low, double high) {
      return random.uniform(frame, index, low, high);
    };
    const Pose T_world_body{from_yaw_pitch_roll(draw(0, -3.1, 3.1), draw(1, -0.4, 0.4), draw(2, -0.4, 0.4)),
                            {draw(3, -9.8, 9.8), draw(4, -9.8, 9.8), draw(5, 0.1, 2.5)}};
    const auto observations = test::observe(sensor, T_world_body, frame, 2);
    std::vector<bool> is_seen(landmarks.size(), false);
    for (const auto& observation : observations) {
      ASSERT_FALSE(is_seen[observation.landmark]) << "seen twice";
      is_seen[observation.landmark] = true;
    }
    seen_count += observations.size();
    for (std::size_t i = 0; i < landmarks.size(); ++i) {
      const Verdict expected = verdict(spec, world, T_world_body * spec.T_body_sensor, landmarks[i]);
      undecided_count += expected == Verdict::kUndecided ? 1 : 0;
      if (expected == Verdict::kUndecided) continue;
      ASSERT_EQ(is_seen[i], expected == Verdict::kSeen) << "frame " << frame << ", landmark " << i;
    }
  }
  EXPECT_GT(seen_count, 20u * frames);
  EXPECT_LT(undecided_count, frames) << "the definition leaves next to nothing open";
}

}  // namespace
}  // namespace hallway::sense
