// SPDX-License-Identifier: MIT
#include "sense/face_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
#include "sense/false_plane.hpp"
#include "sense/spec_check.hpp"

namespace hallway::sense {
namespace {

constexpr std::uint64_t kOfFace = 4096;  ///< random numbers of a face in a step: three, and two an edge
constexpr double kFlatOfNoise_m = 1e-9;

FaceViewSpec view_of(const PlaneSensorSpec& spec) {
  checked(spec);
  const auto refuse = [&](const std::string& problem) {
    throw Error(ErrorCode::kBadInput, problem, {.element = "sensor `" + printable(spec.name) + "`"});
  };
  if (std::max(spec.view.horizontal_fov, spec.vertical_fov) >= std::numbers::pi)
    refuse("a sensor of whole faces sees a pyramid: both angles of view are below 180 degrees");
  if (spec.view.bounded_sides) refuse("the ranges of a sensor of whole faces are depths: no bounded_sides");
  return {spec.view.horizontal_fov, spec.vertical_fov,   spec.view.min_range_m,
          spec.view.max_range_m,    spec.view.occlusion, spec.view.min_length_m};
}

Vec2 middle_of(const Convex& polygon) {
  Vec2 sum = Vec2::Zero();
  double twice = 0.0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i - 1] - polygon[0], b = polygon[i] - polygon[0];
    const double part = cross(a, b);
    sum += part * (a + b) / 3.0;
    twice += part;
  }
  return polygon[0] + sum / twice;
}

/// A rectangle around a polygon, along its longest edge; counter-clockwise.
std::array<Vec2, 4> rectangle_around(const Convex& polygon) {
  Vec2 along = Vec2::UnitX();
  double longest = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 way = polygon[(i + 1) % polygon.size()] - polygon[i];
    if (way.norm() <= longest) continue;
    longest = way.norm();
    along = way / longest;
  }
  const Vec2 across(-along.y(), along.x());
  Vec2 low = Vec2::Constant(HUGE_VAL), high = -low;
  for (const Vec2& p : polygon) {
    const Vec2 at(along.dot(p), across.dot(p));
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  const auto corner = [&](double s, double t) { return Vec2(s * along + t * across); };
  return {corner(low.x(), low.y()), corner(high.x(), low.y()), corner(high.x(), high.y()),
          corner(low.x(), high.y())};
}

}  // namespace

FaceSensor::FaceSensor(PlaneSensorSpec spec, const FacePlan& plan, std::uint64_t seed)
    : spec_(std::move(spec)),
      view_(view_of(spec_), plan),
      detection_(spec_.detection, spec_.name, seed),
      noise_(seed, stream_id("sensor.noise." + spec_.name)),
      order_(seed, stream_id("sensor.order." + spec_.name)) {}

void FaceSensor::check_pose(const Pose& T_world_body, std::uint32_t step) const {
  sense::check_pose(spec_.name, step, T_world_body * spec_.T_body_sensor);
}

void FaceSensor::observe(const Pose& T_world_body, std::uint32_t step,
                         std::vector<PlaneObservation>& out) const {
  check_pose(T_world_body, step);
  std::vector<VisibleFace> pieces;
  view_.find(T_world_body * spec_.T_body_sensor, pieces);
  std::vector<Placed> all;
  for (const VisibleFace& piece : pieces) {
    if (detection_.misses(step, piece.face)) continue;
    auto seen = make_seen(piece, step);
    if (!seen) continue;
    const auto bits = order_.bits(step, piece.face);
    all.emplace_back(std::uint64_t{bits[0]} << 32 | bits[1], piece.face, std::move(*seen));
  }
  add_clutter(step, all);
  std::sort(all.begin(), all.end(), [](const Placed& a, const Placed& b) {
    return std::tie(std::get<0>(a), std::get<1>(a)) < std::tie(std::get<0>(b), std::get<1>(b));
  });
  out.clear();
  for (Placed& placed : all) out.push_back(std::move(std::get<2>(placed)));
}

void FaceSensor::add_clutter(std::uint32_t step, std::vector<Placed>& all) const {
  const WallViewSpec& view = spec_.view;
  const FalsePlaneSpec spec{
      .view = FieldOfView(view.horizontal_fov, spec_.vertical_fov, view.min_range_m, view.max_range_m),
      .depths = true,
      .min_length_m = view.min_length_m};
  const std::uint32_t n = detection_.false_count(step);
  for (std::uint32_t i = 0; i < n; ++i)
    all.emplace_back(detection_.place(step, i), ~std::uint32_t{0} - i, false_face(detection_, spec, step, i));
}

std::optional<PlaneObservation> FaceSensor::make_seen(const VisibleFace& piece, std::uint32_t step) const {
  const auto deviate = [&](std::uint64_t which, double sigma) {
    return sigma * noise_.normal(step, kOfFace * piece.face + which);
  };
  const Plane& plane = piece.seen.plane;
  const PlaneAxes axes(plane.normal);
  Convex outline;
  for (const Vec3& vertex : piece.seen.vertices) outline.push_back(axes.flat(vertex));
  const Vec2 centre = middle_of(outline);

  // Each edge of the outline is moved; the outline is what all of them bound.
  Convex moved;
  for (const Vec2& p : outline) moved.push_back(centre + 2.0 * (p - centre));
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const Vec2 outward = Vec2(b.y() - a.y(), a.x() - b.x()).normalized();
    const Vec2 from = a + deviate(3 + 2 * i, spec_.noise_end_m) * outward;
    const Vec2 to = b + deviate(4 + 2 * i, spec_.noise_end_m) * outward;
    const Vec2 normal(to.y() - from.y(), from.x() - to.x());
    moved = clip(moved, normal, normal.dot(from));
  }
  moved = hull_of(std::move(moved), kFlatOfNoise_m);
  if (moved.size() < 3 || polygon_area(moved) <= 0.0) return std::nullopt;

  const Vec3 tilt = deviate(1, spec_.noise_angle) * axes.u + deviate(2, spec_.noise_angle) * axes.v;
  const Quat turn = tilt.norm() > 0.0 ? rotation_by(tilt) : Quat::Identity();
  const Vec3 hinge = axes.lift(centre, plane.offset);
  const Vec3 shift = hinge + deviate(0, spec_.noise_m) * plane.normal;
  const auto place = [&](const Vec2& p) { return Vec3(shift + turn * (axes.lift(p, plane.offset) - hinge)); };
  PlaneObservation seen;
  seen.true_plane = piece.face;
  seen.plane.normal = (turn * plane.normal).normalized();
  seen.plane.offset = seen.plane.normal.dot(shift);
  if (seen.plane.offset > 0.0) return std::nullopt;
  seen.centroid = place(middle_of(moved));
  const std::array<Vec2, 4> corners = rectangle_around(moved);
  for (std::size_t i = 0; i < 4; ++i) seen.corners[i] = place(corners[i]);
  for (const Vec2& p : moved) seen.hull.push_back(place(p));
  return seen;
}

}  // namespace hallway::sense
