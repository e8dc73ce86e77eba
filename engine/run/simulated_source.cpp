// SPDX-License-Identifier: MIT
#include "run/simulated_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <variant>

#include "base/error.hpp"
#include "base/text.hpp"
#include "geom/arrays.hpp"
#include "run/abi_pose.hpp"

namespace hallway::run {

SimulatedSource::SimulatedSource(const sim::Simulator& simulator) : simulator_(simulator) {
  facts_.has_identities = true;
  const sim::Scenario& scenario = simulator.scenario();
  if (scenario.sensors.size() != 1) {
    throw Error(
        ErrorCode::kBadInput,
        fmt::format(
            "a run takes exactly one sensor, a [sensor.NAME] of the scenario or, where it has none, an "
            "hw_sensor of its map; there are {}",
            scenario.sensors.size()),
        {.file = printable(scenario.file)});
  }
  std::visit([this](const auto& spec) { take(spec); }, scenario.sensors.front());
}

void SimulatedSource::take(const sense::PointSensorSpec& spec) {
  facts_.sensor = {.name = spec.name,
                   .T_body_sensor = abi_pose(spec.T_body_sensor),
                   .horizontal_fov = spec.horizontal_fov,
                   .vertical_fov = spec.vertical_fov,
                   .min_range_m = spec.min_range_m,
                   .max_range_m = spec.max_range_m,
                   .noise_m = {spec.noise_m[0], spec.noise_m[1], spec.noise_m[2]}};
  facts_.true_landmarks.emplace();
  for (const Vec3& place : simulator_.landmarks()) {
    const auto id = static_cast<std::uint32_t>(facts_.true_landmarks->size());
    facts_.true_landmarks->push_back(
        {.id = id, .position_m = to_array(place), .moving = simulator_.moving_landmarks().moves(id)});
  }
}

void SimulatedSource::take(const sense::PlaneSensorSpec& spec) {
  const bool walls = spec.shape == sense::PlaneShape::walls;  // their normals are level
  facts_.sensor = {.kind = HW_SAMPLE_PLANES,
                   .name = spec.name,
                   .T_body_sensor = abi_pose(spec.T_body_sensor),
                   .horizontal_fov = spec.view.horizontal_fov,
                   .vertical_fov = spec.vertical_fov,
                   .min_range_m = spec.view.min_range_m,
                   .max_range_m = spec.view.max_range_m,
                   .noise_m = {spec.noise_m, spec.noise_m, walls ? 0.0 : spec.noise_m}};
  if (walls) {
    set_walls(*simulator_.walls(0));
  } else {
    set_faces(*simulator_.faces(0));
  }
}

void SimulatedSource::add_walls() {
  if (facts_.true_planes) return;
  const double height_m = (simulator_.pose_at(0) * pose_of(facts_.sensor.T_body_sensor)).t.z();
  set_walls(simulator_.walls_at(height_m));
}

void SimulatedSource::set_walls(const sense::WallPlan& plan) {
  facts_.true_planes.emplace();
  for (const sense::Wall& wall : plan.walls) {
    const Vec2 &l = wall.left, &r = wall.right;
    facts_.true_planes->push_back({.id = facts_.true_planes->size(),
                                   .corners_m = {{{l.x(), l.y(), wall.low_m},
                                                  {r.x(), r.y(), wall.low_m},
                                                  {r.x(), r.y(), wall.high_m},
                                                  {l.x(), l.y(), wall.high_m}}}});
  }
}

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
                                    .true_plane = seen.true_plane,
                                    .normal = to_array(seen.plane.normal),
                                    .offset_m = seen.plane.offset,
                                    .centroid_m = to_array(seen.centroid),
                                    .exclusive_share = 1.0};
  for (std::size_t i = 0; i < seen.corners.size(); ++i) observation.corners_m[i] = to_array(seen.corners[i]);
  for (const Vec3& p : seen.hull) observation.hull_m.push_back(to_array(p));
  return observation;
}

}  // namespace

void SimulatedSource::set_faces(const sense::FacePlan& plan) {
  facts_.true_planes.emplace();
  for (const Polygon& face : plan.faces) {
    log::TruePlane& plane = facts_.true_planes->emplace_back();
    plane.id = facts_.true_planes->size() - 1;
    plane.corners_m = corners_of(face);
    if (face.vertices.size() <= plane.corners_m.size()) continue;
    for (const Vec3& corner : face.vertices) plane.hull_m.push_back(to_array(corner));
  }
}

void SimulatedSource::read(std::uint32_t iteration, SourceFrame& frame) {
  const sim::Frame step = simulator_.step(iteration);
  frame.t_ns = step.t_ns;
  frame.T_world_body = step.T_world_body;
  frame.orientation_known = true;
  frame.is_of_planes = facts_.sensor.kind == HW_SAMPLE_PLANES;
  frame.observations.clear();
  frame.planes.clear();
  const sim::Reading& reading = step.readings.front();
  for (const sense::PointObservation& seen : reading.observations) {
    frame.observations.push_back({.landmark = seen.landmark, .point = to_array(seen.point)});
  }
  for (const PlaneObservation& seen : reading.planes)
    frame.planes.push_back(observation_of(seen, frame.planes.size()));
}

}  // namespace hallway::run
