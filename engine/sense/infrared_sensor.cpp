// SPDX-License-Identifier: MIT
#include "sense/infrared_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
#include "sense/light_path.hpp"
#include "sense/spec_check.hpp"

namespace hallway::sense {
namespace {

// Random numbers of one ray of a reading.
namespace infrared_draw {
enum Draw : std::uint64_t { kMissed, kFalse, kFalseAt, kNoise, kPanes, kDraws = kPanes + kMostPanes };
}

}  // namespace

InfraredSensor::InfraredSensor(InfraredSpec spec, const trace::Scene& scene, const Surfaces& surfaces,
                               std::uint64_t seed)
    : spec_(std::move(spec)),
      scene_(scene),
      surfaces_(surfaces),
      random_(seed, stream_id("sensor.infrared." + spec_.name)) {
  check();
  for (const PatternRay& ray : spec_.rays.rays) {
    directions_.push_back(direction_of(ray));
    offsets_ns_.push_back(std::llround(ray.share * static_cast<double>(spec_.duration_ns)));
  }
}

void InfraredSensor::check() const {
  const SpecCheck check(spec_.name);
  try {
    check_pattern(spec_.rays);
  } catch (const Error& error) {
    throw Error(ErrorCode::kBadInput, error.message(), {.element = "sensor `" + printable(spec_.name) + "`"});
  }
  if (spec_.duration_ns < 0) check.fail("duration_ns", "is below 0");
  check.mount(spec_.T_body_sensor);
  check.ranges(spec_.min_range_m, spec_.max_range_m);
  check.positive("max_range_m", spec_.max_range_m);
  check.not_negative("noise_m", spec_.noise_m);
  check.not_negative("noise_per_m", spec_.noise_per_m);
  check.not_negative("noise_per_m2", spec_.noise_per_m2);
  check.within("least_light", spec_.least_light, 0.0, 1.0);
  check.within("missed", spec_.missed, 0.0, 1.0);
  check.within("false_reading", spec_.false_reading, 0.0, 1.0);
  check.within("near_m", spec_.near_m, 0.0, spec_.max_range_m);
}

/// What throws back enough light along a ray.
double InfraredSensor::seen(std::uint32_t number, std::size_t ray, const trace::Ray& line) const {
  const std::optional<trace::Hit> hit = light_end(scene_, surfaces_, line, random_, number,
                                                  ray * infrared_draw::kDraws + infrared_draw::kPanes);
  if (!hit) return kNothing_m;
  const double light =
      surfaces_.material(hit->triangle).infrared * surfaces_.cosine(hit->triangle, line.direction);
  return light >= spec_.least_light ? hit->distance : kNothing_m;
}

double InfraredSensor::measured(std::uint32_t number, std::size_t ray, double true_m) const {
  const std::uint64_t index = ray * infrared_draw::kDraws;
  const bool only_near = spec_.near_m > 0.0;
  double range = true_m;
  if (range != kNothing_m && random_.uniform(number, index + infrared_draw::kMissed) < spec_.missed)
    range = kNothing_m;
  if (range == kNothing_m) {
    if (!(random_.uniform(number, index + infrared_draw::kFalse) < spec_.false_reading)) return kNothing_m;
    range = random_.uniform(number, index + infrared_draw::kFalseAt, spec_.min_range_m, spec_.max_range_m);
  } else if (range >= spec_.min_range_m) {
    const double sigma =
        std::hypot(std::hypot(spec_.noise_m, spec_.noise_per_m2 * range * range), spec_.noise_per_m * range);
    if (sigma > 0.0) range += sigma * random_.normal(number, index + infrared_draw::kNoise);
  }
  if (only_near) return range <= spec_.near_m ? spec_.near_m : kNothing_m;
  if (range > spec_.max_range_m) return kNothing_m;
  return range < spec_.min_range_m ? kUnanswered_m : range;
}

void InfraredSensor::read(std::uint32_t number, std::int64_t t_begin_ns, const Trajectory& trajectory,
                          InfraredReading& reading, InfraredTruth& truth) const {
  const std::size_t n = directions_.size();
  reading.t_begin_ns = t_begin_ns;
  reading.t_end_ns = t_begin_ns + *std::ranges::max_element(offsets_ns_);
  reading.range_m.resize(n);
  truth.range_m.resize(n);
  truth.what.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Pose T_world_sensor = trajectory.pose_at(t_begin_ns + offsets_ns_[i]) * spec_.T_body_sensor;
    check_pose(spec_.name, number, T_world_sensor);
    const trace::Ray line{T_world_sensor.t, T_world_sensor.q * directions_[i], spec_.max_range_m};
    const std::optional<trace::Hit> hit = scene_.first_hit(line);
    truth.range_m[i] = hit ? hit->distance : kNothing_m;
    truth.what[i] = hit ? hit->triangle : InfraredTruth::kNothing;
    reading.range_m[i] = measured(number, i, seen(number, i, line));
  }
}

}  // namespace hallway::sense
