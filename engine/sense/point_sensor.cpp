// SPDX-License-Identifier: MIT
#include "sense/point_sensor.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/parallel.hpp"
#include "sense/spec_check.hpp"

namespace hallway::sense {
namespace {

const PointSensorSpec& checked(const PointSensorSpec& spec) {
  const SpecCheck check(spec.name);
  check.angle("horizontal_fov", spec.horizontal_fov);
  check.angle("vertical_fov", spec.vertical_fov);
  check.ranges(spec.min_range_m, spec.max_range_m);
  for (const double sigma : spec.noise_m) check.not_negative("noise_m", sigma);
  for (const double slope : spec.noise_per_m) check.not_negative("noise_per_m", slope);
  check.mount(spec.T_body_sensor);
  check_detection(check, spec.detection);
  return spec;
}

}  // namespace

PointSensor::PointSensor(PointSensorSpec spec, const LandmarkIndex& landmarks, const trace::Scene& scene,
                         std::uint64_t seed)
    : spec_(std::move(spec)),
      field_of_view_(checked(spec_).horizontal_fov, spec_.vertical_fov, spec_.min_range_m, spec_.max_range_m),
      visibility_(field_of_view_, landmarks, scene),
      detection_(spec_.detection, spec_.name, seed),
      noise_(seed, stream_id("sensor.noise." + spec_.name)),
      order_(seed, stream_id("sensor.order." + spec_.name)) {}

void PointSensor::observe(const Pose& T_world_body, std::uint32_t step, std::span<const LandmarkPlace> moved,
                          unsigned threads, std::vector<PointObservation>& out) const {
  constexpr std::size_t kGrain = 256;
  const Pose T_world_sensor = T_world_body * spec_.T_body_sensor;
  check_pose(spec_.name, step, T_world_sensor);
  std::vector<VisiblePoint> visible;
  visibility_.find(T_world_sensor, moved, threads, visible);
  std::erase_if(visible, [&](const VisiblePoint& point) { return detection_.misses(step, point.landmark); });
  std::vector<Seen> all(visible.size());
  parallel_for(visible.size(), kGrain, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) all[i] = make_seen(visible[i], step);
  });
  add_clutter(step, all);
  std::sort(all.begin(), all.end(), [](const Seen& a, const Seen& b) {
    return std::tie(a.place, a.observation.landmark) < std::tie(b.place, b.observation.landmark);
  });
  out.clear();
  out.reserve(all.size());
  for (const Seen& seen : all) out.push_back(seen.observation);
}

void PointSensor::add_clutter(std::uint32_t step, std::vector<Seen>& all) const {
  const std::uint32_t n = detection_.false_count(step);
  for (std::uint32_t i = 0; i < n; ++i) {
    const Vec3 direction = direction_in(field_of_view_, detection_.uniform(step, i, 0, 0.0, 1.0),
                                        detection_.uniform(step, i, 1, 0.0, 1.0));
    const double range_m = detection_.uniform(step, i, 2, spec_.min_range_m, spec_.max_range_m);
    all.push_back({detection_.place(step, i), {PointObservation::kFalse, range_m * direction}});
  }
}

PointSensor::Seen PointSensor::make_seen(const VisiblePoint& visible, std::uint32_t step) const {
  const std::uint64_t first = 3 * std::uint64_t{visible.landmark};
  const Vec3 deviates(noise_.normal(step, first), noise_.normal(step, first + 1),
                      noise_.normal(step, first + 2));
  const auto bits = order_.bits(step, visible.landmark);
  const Vec3 growing = visible.point.norm() * spec_.noise_per_m;
  const Vec3 sigma = (spec_.noise_m.array().square() + growing.array().square()).sqrt();
  return {std::uint64_t{bits[0]} << 32 | bits[1],
          {visible.landmark, visible.point + sigma.cwiseProduct(deviates)}};
}

}  // namespace hallway::sense
