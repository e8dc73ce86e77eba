// SPDX-License-Identifier: MIT
#include "sense/plane_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "base/text.hpp"
#include "sense/false_plane.hpp"
#include "sense/spec_check.hpp"

namespace hallway::sense {
namespace {

constexpr double kSameHeight_m = 1e-6;
constexpr double kLevel = 1e-6;  ///< radians
constexpr std::uint64_t kDeviates = 4;

Vec3 at_height(const Vec2& point, double z) {
  return {point.x(), point.y(), z};
}

/// Of its random numbers.
std::uint64_t key_of(const VisibleWall& piece) {
  return std::uint64_t{piece.wall} << 24 | piece.part;
}

bool is_level(const Pose& T_world_sensor) {
  const Vec3 up = T_world_sensor.q * Vec3::UnitZ();
  return up.head<2>().norm() <= kLevel && up.z() >= 0.0;
}

}  // namespace

const PlaneSensorSpec& checked(const PlaneSensorSpec& spec) {
  const SpecCheck check(spec.name);
  check.angle("horizontal_fov", spec.view.horizontal_fov);
  check.angle("vertical_fov", spec.vertical_fov);
  check.ranges(spec.view.min_range_m, spec.view.max_range_m);
  check.not_negative("min_length_m", spec.view.min_length_m);
  check.not_negative("noise_m", spec.noise_m);
  check.not_negative("noise_angle", spec.noise_angle);
  check.not_negative("noise_end_m", spec.noise_end_m);
  check.mount(spec.T_body_sensor);
  check_detection(check, spec.detection);
  return spec;
}

PlaneSensor::PlaneSensor(PlaneSensorSpec spec, const WallPlan& plan, std::uint64_t seed)
    : spec_(std::move(spec)),
      plan_(plan),
      view_(checked(spec_).view, plan),
      detection_(spec_.detection, spec_.name, seed),
      noise_(seed, stream_id("sensor.noise." + spec_.name)),
      order_(seed, stream_id("sensor.order." + spec_.name)) {}

bool PlaneSensor::sees_from(const Pose& T_world_body) const {
  const Pose T_world_sensor = T_world_body * spec_.T_body_sensor;
  return is_level(T_world_sensor) && std::abs(T_world_sensor.t.z() - plan_.height_m) <= kSameHeight_m;
}

void PlaneSensor::check_pose(const Pose& T_world_body, std::uint32_t step) const {
  const Pose T_world_sensor = T_world_body * spec_.T_body_sensor;
  sense::check_pose(spec_.name, step, T_world_sensor);
  if (!is_level(T_world_sensor)) refuse_pose(spec_.name, step, "is not level, as a sensor of planes must be");
  const double height_m = T_world_sensor.t.z();
  if (std::abs(height_m - plan_.height_m) > kSameHeight_m) {
    refuse_pose(spec_.name, step,
                "is at the height " + format_double(height_m) + " m; a sensor of planes stays at one, here " +
                    format_double(plan_.height_m) + " m");
  }
}

void PlaneSensor::observe(const Pose& T_world_body, std::uint32_t step,
                          std::vector<PlaneObservation>& out) const {
  check_pose(T_world_body, step);
  const Pose T_world_sensor = T_world_body * spec_.T_body_sensor;
  const Vec3 forward = T_world_sensor.q * Vec3::UnitX();
  std::vector<VisibleWall> pieces;
  view_.find(T_world_sensor.t.head<2>(), forward.head<2>().normalized(), pieces);
  std::vector<Seen> all;
  all.reserve(pieces.size());
  for (const VisibleWall& piece : pieces) {
    if (detection_.misses(step, key_of(piece))) continue;
    if (const auto seen = make_seen(piece, step)) all.push_back(*seen);
  }
  add_clutter(step, all);
  std::sort(all.begin(), all.end(),
            [](const Seen& a, const Seen& b) { return std::tie(a.place, a.key) < std::tie(b.place, b.key); });
  out.clear();
  out.reserve(all.size());
  for (const Seen& seen : all) out.push_back(seen.observation);
}

void PlaneSensor::add_clutter(std::uint32_t step, std::vector<Seen>& all) const {
  constexpr double kAnyHeight = 1.0;
  const WallViewSpec& view = spec_.view;
  const FalsePlaneSpec spec{
      .view = FieldOfView(view.horizontal_fov, kAnyHeight, view.min_range_m, view.max_range_m),
      .depths = !view.bounded_sides && view.horizontal_fov < std::numbers::pi,
      .min_length_m = view.min_length_m};
  const std::uint32_t n = detection_.false_count(step);
  for (std::uint32_t i = 0; i < n; ++i) {
    all.push_back({.place = detection_.place(step, i),
                   .key = ~std::uint64_t{0} - i,
                   .observation = false_wall(detection_, spec, step, i)});
  }
}

std::optional<PlaneSensor::Seen> PlaneSensor::make_seen(const VisibleWall& piece, std::uint32_t step) const {
  const std::uint64_t key = key_of(piece);
  const auto deviate = [&](std::uint64_t which, double sigma) {
    return sigma * noise_.normal(step, kDeviates * key + which);
  };
  const Vec2 way = piece.right - piece.left;
  const double length_m = way.norm();
  const Eigen::Rotation2Dd turn(deviate(1, spec_.noise_angle));
  const Vec2 true_normal = Vec2(way.y(), -way.x()) / length_m;
  const Vec2 middle = 0.5 * (piece.left + piece.right) + deviate(0, spec_.noise_m) * true_normal;
  const Vec2 along = turn * (way / length_m);
  const Vec2 normal(along.y(), -along.x());
  const double left_m = -0.5 * length_m + deviate(2, spec_.noise_end_m);
  const double right_m = 0.5 * length_m + deviate(3, spec_.noise_end_m);
  const double offset_m = normal.dot(middle);
  if (offset_m > 0.0 || left_m >= right_m) return std::nullopt;

  const Wall& wall = plan_.walls[piece.wall];
  const double low_m = wall.low_m - plan_.height_m, high_m = wall.high_m - plan_.height_m;
  const Vec2 left = middle + left_m * along, right = middle + right_m * along;
  const auto bits = order_.bits(step, key);
  Seen seen{.place = std::uint64_t{bits[0]} << 32 | bits[1], .key = key, .observation = {}};
  seen.observation.true_plane = piece.wall;
  seen.observation.plane = {at_height(normal, 0.0), offset_m};
  seen.observation.centroid = at_height(0.5 * (left + right), 0.5 * (low_m + high_m));
  seen.observation.corners = {at_height(left, low_m), at_height(right, low_m), at_height(right, high_m),
                              at_height(left, high_m)};
  return seen;
}

}  // namespace hallway::sense
