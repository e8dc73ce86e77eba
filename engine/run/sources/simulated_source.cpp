// SPDX-License-Identifier: MIT
#include "run/sources/simulated_source.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <variant>

#include "base/error.hpp"
#include "base/text.hpp"
#include "geom/arrays.hpp"
#include "host/samples/plane_kind.hpp"
#include "host/samples/point_kind.hpp"
#include "record/plane_observations.hpp"
#include "run/sources/abi_pose.hpp"
#include "sense/describe.hpp"

namespace hallway::run {

namespace {

/// Four corners for a face: its own, the last one twice where it has three, or those of a rectangle around it.
std::array<std::array<double, 3>, 4> corners_of(const Polygon& face) {
  std::vector<Vec3> own = face.vertices;
  const auto height = [&](std::size_t i) { return own[i].z() + own[(i + 1) % own.size()].z(); };
  std::size_t lowest = 0;  // edge, with which walls begin
  for (std::size_t i = 1; i < own.size(); ++i) lowest = height(i) < height(lowest) ? i : lowest;
  std::rotate(own.begin(), own.begin() + static_cast<std::ptrdiff_t>(lowest), own.end());
  if (own.size() <= 4) return {to_array(own[0]), to_array(own[1]), to_array(own[2]), to_array(own.back())};
  const PlaneAxes axes(face.plane.normal);
  Vec2 low = axes.flat(own[0]), high = low;
  for (const Vec3& p : own) {
    low = low.cwiseMin(axes.flat(p));
    high = high.cwiseMax(axes.flat(p));
  }
  const auto corner = [&](double x, double y) { return to_array(axes.lift({x, y}, face.plane.offset)); };
  return {corner(low.x(), low.y()), corner(high.x(), low.y()), corner(high.x(), high.y()),
          corner(low.x(), high.y())};
}

log::PlaneObservation observation_of(const PlaneObservation& seen, std::uint64_t id) {
  log::PlaneObservation observation{.id = id,
                                    .normal = to_array(seen.plane.normal),
                                    .offset_m = seen.plane.offset,
                                    .centroid_m = to_array(seen.centroid),
                                    .exclusive_share = 1.0};
  for (std::size_t i = 0; i < seen.corners.size(); ++i) observation.corners_m[i] = to_array(seen.corners[i]);
  for (const Vec3& p : seen.hull) observation.hull_m.push_back(to_array(p));
  return observation;
}

std::vector<log::TruePlane> true_planes_of(const sense::WallPlan& plan) {
  std::vector<log::TruePlane> planes;
  for (const sense::Wall& wall : plan.walls) {
    const Vec2 &l = wall.left, &r = wall.right;
    planes.push_back({.corners_m = {{{l.x(), l.y(), wall.low_m},
                                     {r.x(), r.y(), wall.low_m},
                                     {r.x(), r.y(), wall.high_m},
                                     {l.x(), l.y(), wall.high_m}}}});
  }
  return planes;
}

std::vector<log::TruePlane> true_planes_of(const sense::FacePlan& plan) {
  std::vector<log::TruePlane> planes;
  for (const Polygon& face : plan.faces) {
    log::TruePlane& plane = planes.emplace_back();
    plane.corners_m = corners_of(face);
    if (face.vertices.size() <= plane.corners_m.size()) continue;
    for (const Vec3& corner : face.vertices) plane.hull_m.push_back(to_array(corner));
  }
  return planes;
}

/// Whether two lists are of the same planes, by where these are.
bool are_the_same(std::span<const log::TruePlane> a, std::span<const log::TruePlane> b) {
  return std::ranges::equal(a, b, [](const log::TruePlane& p, const log::TruePlane& q) {
    return p.corners_m == q.corners_m && p.hull_m == q.hull_m;
  });
}

}  // namespace

SimulatedSource::SimulatedSource(const sim::Simulator& simulator) : simulator_(simulator) {
  facts_.has_identities = true;
  const sim::Scenario& scenario = simulator.scenario();
  const Where where{.file = printable(scenario.file)};
  if (scenario.sensors.empty()) {
    throw Error(
        ErrorCode::kBadInput,
        "a run takes a sensor, a [sensor.NAME] of the scenario or, where it has none, an hw_sensor of its "
        "map; there is none",
        where);
  }
  for (const sim::SensorSpec& sensor : scenario.sensors)
    std::visit([this](const auto& spec) { add_sensor(spec); }, sensor);
}

void SimulatedSource::add_sensor(const sense::PointSensorSpec& spec) {
  facts_.sensors.push_back(sense::describe(spec, static_cast<std::uint32_t>(facts_.sensors.size())));
  first_true_plane_.emplace_back();
  if (facts_.true_landmarks) return;
  facts_.true_landmarks.emplace();
  for (const Vec3& place : simulator_.landmarks()) {
    const auto id = static_cast<std::uint32_t>(facts_.true_landmarks->size());
    facts_.true_landmarks->push_back(
        {.id = id, .position_m = to_array(place), .moving = simulator_.moving_landmarks().moves(id)});
  }
}

void SimulatedSource::add_sensor(const sense::PlaneSensorSpec& spec) {
  const std::size_t index = facts_.sensors.size();
  facts_.sensors.push_back(sense::describe(spec, static_cast<std::uint32_t>(index)));
  const sense::WallPlan* walls = simulator_.walls(index);
  first_true_plane_.emplace_back(
      add_true_planes(walls != nullptr ? true_planes_of(*walls) : true_planes_of(*simulator_.faces(index))));
}

void SimulatedSource::add_walls() {
  if (facts_.true_planes) return;
  const double height_m = (simulator_.pose_at(0) * pose_of(facts_.sensors.front().T_body_sensor)).t.z();
  add_true_planes(true_planes_of(simulator_.walls_at(height_m)));
}

/// Adds what a sensor can see; sensors that see the same planes share them.
/// @return the number of the first one
std::uint64_t SimulatedSource::add_true_planes(std::vector<log::TruePlane> planes) {
  if (!facts_.true_planes) facts_.true_planes.emplace();
  std::vector<log::TruePlane>& all = *facts_.true_planes;
  for (const auto& first : first_true_plane_) {
    if (!first) continue;
    const auto known = std::span(all).subspan(*first);
    if (known.size() >= planes.size() && are_the_same(known.first(planes.size()), planes)) return *first;
  }
  const std::uint64_t first = all.size();
  for (log::TruePlane& plane : planes) {
    plane.id = all.size();
    all.push_back(std::move(plane));
  }
  return first;
}

void SimulatedSource::add_reading(const sense::PointSensorSpec&, const sim::Reading& reading,
                                  SourceFrame& frame, host::FrameBuilder& builder) const {
  std::vector<hw_point3_t>& points = host::add_points(builder, facts_.sensors[reading.sensor].id);
  for (const sense::PointObservation& seen : reading.observations) {
    points.push_back({seen.point.x(), seen.point.y(), seen.point.z()});
    frame.identities.push_back(seen.landmark);
  }
}

void SimulatedSource::add_reading(const sense::PlaneSensorSpec&, const sim::Reading& reading,
                                  SourceFrame& frame, host::FrameBuilder& builder) const {
  const host::PlaneReading planes = host::add_planes(builder, facts_.sensors[reading.sensor].id);
  for (const PlaneObservation& seen : reading.planes) {
    record::add_plane(planes, observation_of(seen, planes.planes.size()));
    frame.identities.push_back(first_true_plane_[reading.sensor].value() + seen.true_plane);
  }
}

void SimulatedSource::fill(std::uint32_t iteration, SourceFrame& frame) {
  const sim::Frame step = simulator_.step(iteration);
  host::FrameBuilder& builder = frame.begin(iteration, step.t_ns);
  frame.T_world_body = step.T_world_body;
  for (const sim::Reading& reading : step.readings) {
    std::visit([&](const auto& spec) { add_reading(spec, reading, frame, builder); },
               simulator_.scenario().sensors[reading.sensor]);
    builder.set_reading(reading.sequence, reading.t_ns, reading.t_ns);
  }
}

}  // namespace hallway::run
