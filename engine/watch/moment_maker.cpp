// SPDX-License-Identifier: MIT
#include "watch/moment_maker.hpp"

#include <fmt/format.h>
#include <hallway/bump.h>
#include <hallway/planes.h>
#include <hallway/range_scan.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/text.hpp"
#include "geom/arrays.hpp"
#include "host/samples/sample_kind.hpp"
#include "record/answer_recorder.hpp"
#include "record/plugin_topology.hpp"
#include "run/feed/observation_tables.hpp"
#include "run/sources/abi_pose.hpp"

namespace hallway::watch {
namespace {

Vec3 place_of(const hw_point3_t& point) {
  return {point.x, point.y, point.z};
}

/// @return how many rays met something, and the least range of them
std::pair<std::size_t, double> add_rays(const hw_range_scan_t& scan, const Pose& T_body_sensor,
                                        double max_range_m, std::vector<Ray>& rays) {
  std::size_t returns = 0;
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::uint64_t i = 0; i < scan.count; ++i) {
    const hw_ray_t& ray = *hw_ray_at(&scan, i);
    if (std::isnan(ray.range_m)) continue;
    const bool has_return = hw_ray_has_return(&ray) != 0;
    const double length_m = has_return ? ray.range_m : max_range_m;
    if (has_return) {
      ++returns;
      nearest_m = std::min(nearest_m, ray.range_m);
    }
    if (!std::isfinite(length_m)) continue;
    const Vec3 direction = place_of(hw_ray_direction(&ray));
    rays.push_back({T_body_sensor.t, T_body_sensor * Vec3(length_m * direction), has_return});
  }
  return {returns, nearest_m};
}

void add_outlines(const hw_planes_t& planes, const Pose& T_body_sensor,
                  std::vector<std::vector<Vec3>>& outlines) {
  for (const log::PlaneObservation& plane : run::observations_of(planes, {})) {
    std::vector<Vec3>& outline = outlines.emplace_back();
    for (const std::array<double, 3>& corner : plane.outline())
      outline.push_back(T_body_sensor * to_vec3(corner));
  }
}

std::string counted(std::uint64_t count, const char* thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

/// "0.82 m" of a single ray; "12 of 16 rays, 0.82 m" of several, the nearest.
std::string rays_text(std::uint64_t count, std::size_t returns, double nearest_m) {
  if (count == 1) return returns > 0 ? fmt::format("{:.2f} m", nearest_m) : "nothing";
  std::string text = fmt::format("{} of {}", returns, counted(count, "ray"));
  if (returns > 0) text += fmt::format(", {:.2f} m", nearest_m);
  return text;
}

}  // namespace

void MomentMaker::set_sensors(std::span<const host::SensorInfo> sensors) {
  sensors_.assign(sensors.begin(), sensors.end());
}

void MomentMaker::begin(const hw_frame_t& frame) {
  moment_ = {};
  moment_.iteration = static_cast<std::uint32_t>(frame.sequence);
  moment_.t_ns = frame.t_ns;
  moment_.topology = topology_;
  for (std::uint32_t k = 0; k < frame.n_samples; ++k) add_sample(*frame.samples[k]);
}

void MomentMaker::add_sample(const hw_sample_t& sample) {
  const auto sensor = std::ranges::find(sensors_, sample.sensor_id, &host::SensorInfo::id);
  const bool known = sensor != sensors_.end();
  const Pose T_body_sensor = known ? run::pose_of(sensor->T_body_sensor) : Pose();
  const std::string name = known ? printable(sensor->name, 24) : fmt::format("sensor {}", sample.sensor_id);
  std::string text;
  if (sample.kind == HW_SAMPLE_RANGE_SCAN) {
    const auto& scan = *static_cast<const hw_range_scan_t*>(sample.payload);
    const auto [returns, nearest_m] =
        add_rays(scan, T_body_sensor, known ? sensor->max_range_m : std::nan(""), moment_.rays);
    text = rays_text(scan.count, returns, nearest_m);
  } else if (sample.kind == HW_SAMPLE_POINTS) {
    const auto& points = *static_cast<const hw_points_t*>(sample.payload);
    for (std::uint64_t i = 0; i < points.count; ++i)
      moment_.points.push_back(T_body_sensor * place_of(*hw_point_at(&points, i)));
    text = counted(points.count, "point");
  } else if (sample.kind == HW_SAMPLE_PLANES) {
    const auto& planes = *static_cast<const hw_planes_t*>(sample.payload);
    add_outlines(planes, T_body_sensor, moment_.outlines);
    text = counted(planes.count, "plane");
  } else if (sample.kind == HW_SAMPLE_BUMP) {
    const auto& bump = *static_cast<const hw_bump_t*>(sample.payload);
    std::uint64_t pressed = 0;
    for (std::uint64_t i = 0; i < bump.count; ++i) {
      const hw_bump_zone_t& zone = *hw_bump_zone_at(&bump, i);
      if (zone.pressed == 0) continue;
      ++pressed;
      const Vec3 direction(zone.direction[0], zone.direction[1], zone.direction[2]);
      if (!direction.isZero()) moment_.pressed.push_back(T_body_sensor.q * direction);
    }
    text = fmt::format("{} of {} pressed", pressed, counted(bump.count, "zone"));
  } else {
    text = host::sample_kind_name(sample.kind);
  }
  const std::string begin = name + ": ";
  const auto earlier = std::ranges::find_if(
      moment_.readings, [&](const std::string& reading) { return reading.starts_with(begin); });
  if (earlier != moment_.readings.end()) {
    *earlier = begin + text;
  } else {
    moment_.readings.push_back(begin + text);
  }
}

void MomentMaker::add_true_pose(const Pose& T_world_body, bool orientation_known) {
  moment_.T_world_body = T_world_body;
  moment_.orientation_known = orientation_known;
}

void MomentMaker::add_topology(log::Topology topology) {
  topology_ = std::make_shared<const log::Topology>(std::move(topology));
  moment_.topology = topology_;
}

void MomentMaker::add_answer(const host::Outputs& outputs) {
  if (outputs.pose()) add_pose(record::pose_answer(outputs));
  if (const auto& command = outputs.drive_command())
    add_command({command->linear_m_s, command->angular_rad_s, command->lateral_m_s});
  if (outputs.topology() != nullptr) add_topology(record::copy_topology(*outputs.topology()));
  if (outputs.drawing() != nullptr) add_drawing(record::copy_drawing(*outputs.drawing()));
  for (const host::Counter& counter : outputs.counters())
    moment_.counters.emplace_back(printable(counter.name, 24), counter.value);
}

}  // namespace hallway::watch
