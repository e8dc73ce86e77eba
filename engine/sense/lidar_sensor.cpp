// SPDX-License-Identifier: MIT
#include "sense/lidar_sensor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/text.hpp"
#include "sense/light_path.hpp"
#include "sense/spec_check.hpp"

namespace hallway::sense {
namespace {

constexpr std::size_t kMostProbes = 5;

/// A ray beside a beam's middle: turned by an angle to the left and upwards, across the beam.
Vec3 beside(const PatternRay& ray, double left_rad, double up_rad) {
  const Vec3 middle = direction_of(ray);
  const Vec3 left(-std::sin(ray.azimuth_rad), std::cos(ray.azimuth_rad), 0.0);
  const Vec3 up = middle.cross(left);
  return (middle + std::tan(left_rad) * left + std::tan(up_rad) * up).normalized();
}

}  // namespace

LidarSensor::LidarSensor(LidarSpec spec, const trace::Scene& scene, const Surfaces& surfaces,
                         std::int64_t scan_ns, std::uint64_t seed, const std::optional<OwnBody>& body)
    : spec_(std::move(spec)),
      scene_(scene),
      surfaces_(surfaces),
      random_(seed, stream_id("sensor.lidar." + spec_.name)),
      panes_(seed, stream_id("sensor.lidar.panes." + spec_.name)),
      n_probes_(spec_.beam.divergence_rad > 0.0 ? kMostProbes : 1) {
  check();
  if (scan_ns < 0) throw Error(ErrorCode::kInternal, "a scan that takes less than no time");
  const double half = 0.5 * spec_.beam.divergence_rad;
  constexpr std::array<std::array<double, 2>, kMostProbes> kAside{{{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  directions_.resize(n_probes_);
  for (std::size_t probe = 0; probe < n_probes_; ++probe) {
    for (const PatternRay& ray : spec_.pattern.rays)
      directions_[probe].push_back(probe == 0
                                       ? direction_of(ray)
                                       : beside(ray, half * kAside.at(probe)[0], half * kAside.at(probe)[1]));
  }
  find_moments(scan_ns);
  if (body && spec_.own_body) find_own_body(*body);
}

void LidarSensor::check() const {
  const SpecCheck check(spec_.name);
  const auto refuse = [&](const std::string& problem) {
    throw Error(ErrorCode::kBadInput, problem, {.element = "sensor `" + printable(spec_.name) + "`"});
  };
  const auto share = [&](const char* member, double value) {
    if (!(value >= 0.0 && value <= 1.0))
      refuse(std::string(member) + " is " + format_double(value) + "; it must be in [0, 1]");
  };
  try {
    check_pattern(spec_.pattern);
  } catch (const Error& error) {
    refuse(error.message());
  }
  check.mount(spec_.T_body_sensor);
  check.ranges(spec_.min_range_m, spec_.max_range_m);
  if (spec_.max_range_m == 0.0) refuse("max_range_m is 0");
  const BeamResponse& response = spec_.response;
  check.not_negative("noise_m", response.noise_m);
  check.not_negative("noise_per_m", response.noise_per_m);
  check.not_negative("noise_incidence", response.noise_incidence);
  check.not_negative("intensity_noise", response.intensity_noise);
  share("dropout", response.dropout);
  share("dropout_at_max", response.dropout_at_max);
  share("dropout_incidence", response.dropout_incidence);
  check.not_negative("divergence_rad", spec_.beam.divergence_rad);
  if (spec_.beam.divergence_rad > 0.1) refuse("divergence_rad is above 0.1");
  check.not_negative("pulse_m", spec_.beam.pulse_m);
  if (spec_.returns < 1 || spec_.returns > 2) refuse("returns must be 1 or 2");
}

void LidarSensor::find_moments(std::int64_t scan_ns) {
  for (const PatternRay& ray : spec_.pattern.rays)
    offsets_ns_.push_back(spec_.skew ? std::llround(ray.share * static_cast<double>(scan_ns)) : 0);
  begins_after_ns_ = spec_.skew ? 0 : scan_ns;
  moments_ns_ = offsets_ns_;
  std::sort(moments_ns_.begin(), moments_ns_.end());
  moments_ns_.erase(std::unique(moments_ns_.begin(), moments_ns_.end()), moments_ns_.end());
  duration_ns_ = begins_after_ns_ + moments_ns_.back();
  for (const std::int64_t offset : offsets_ns_)
    moment_of_.push_back(
        static_cast<std::uint32_t>(std::ranges::lower_bound(moments_ns_, offset) - moments_ns_.begin()));
}

void LidarSensor::find_own_body(const OwnBody& body) {
  bool is_seen = false;
  own_body_m_.resize(n_probes_);
  for (std::size_t probe = 0; probe < n_probes_; ++probe) {
    for (const Vec3& direction : directions_[probe]) {
      const double entry = body.entry_m(spec_.T_body_sensor.t, spec_.T_body_sensor.q * direction);
      own_body_m_[probe].push_back(entry <= spec_.max_range_m ? entry : kNothing_m);
      is_seen = is_seen || entry <= spec_.max_range_m;
    }
  }
  if (!is_seen) own_body_m_.clear();
}

std::vector<LidarSensor::View> LidarSensor::views(std::uint32_t scan, std::int64_t t_begin_ns,
                                                  const Trajectory& trajectory) const {
  std::vector<View> views;
  views.reserve(moments_ns_.size());
  for (const std::int64_t moment : moments_ns_) {
    const Pose T_world_sensor =
        trajectory.pose_at(t_begin_ns + begins_after_ns_ + moment) * spec_.T_body_sensor;
    check_pose(spec_.name, scan, T_world_sensor);
    views.push_back({T_world_sensor.q.toRotationMatrix(), T_world_sensor.t});
  }
  return views;
}

/// What the rays of one probe of the beams [begin, end) meet.
void LidarSensor::meet(std::uint32_t scan, std::span<const View> views, std::size_t begin, std::size_t end,
                       std::size_t probe, std::span<Met> met) const {
  constexpr std::size_t kAtOnce = 256;
  std::array<trace::Ray, kAtOnce> rays;
  std::array<std::optional<trace::Hit>, kAtOnce> hits;
  for (std::size_t first = begin; first < end; first += kAtOnce) {
    const std::size_t n = std::min(kAtOnce, end - first);
    for (std::size_t i = 0; i < n; ++i) {
      const View& view = views[moment_of_[first + i]];
      rays[i] = {view.origin, view.R_world_sensor * directions_[probe][first + i], spec_.max_range_m};
    }
    scene_.first_hits({rays.data(), n}, {hits.data(), n});
    for (std::size_t i = 0; surfaces_.is_transparent() && i < n; ++i) {
      if (!hits[i] || surfaces_.material(hits[i]->triangle).transparency == 0.0) continue;
      const std::uint64_t beam = probe * directions_[0].size() + first + i;
      hits[i] = light_end(scene_, surfaces_, rays[i], panes_, scan, beam * kMostPanes);
    }
    for (std::size_t i = 0; i < n; ++i) {
      Met& one = met[first + i - begin];
      one = hits[i] ? Met{hits[i]->distance, hits[i]->triangle} : Met{kNothing_m, LidarTruth::kNothing};
      if (own_body_m_.empty()) continue;
      const double own_m = own_body_m_[probe][first + i];
      if (own_m < one.range_m) one = {own_m, LidarTruth::kOwnBody};
    }
  }
}

/// One return of a beam: noise, drop-outs, what is out of range.
/// @param without  the range where there is no such return
void LidarSensor::put(std::uint32_t scan, std::size_t ray, std::uint32_t layer, const Return& met,
                      double without, const Vec3& direction, LidarReading& reading) const {
  const std::size_t n = spec_.pattern.rays.size();
  double& range_m = reading.range_m[layer * n + ray];
  float& intensity = reading.intensity[layer * n + ray];
  intensity = std::numeric_limits<float>::quiet_NaN();
  range_m = without;
  if (met.hits == 0.0) return;
  const double true_m = met.hits == 1.0 ? met.what.range_m : met.sum_m / met.hits;
  if (true_m < spec_.min_range_m) {
    range_m = kUnanswered_m;
    return;
  }
  static const SurfaceMaterial kBody{};
  const bool is_surface = met.what.what < LidarTruth::kOwnBody;
  const double cosine = is_surface ? surfaces_.cosine(met.what.what, direction) : 1.0;
  const SurfaceMaterial& material = is_surface ? surfaces_.material(met.what.what) : kBody;
  const BeamResponse& response = spec_.response;
  if (response.is_ideal() && material.dropout == 0.0) {
    range_m = true_m;
    intensity = static_cast<float>(material.reflectivity * cosine);
    return;
  }
  const BeamDraws draws(random_.bits(scan, layer * n + ray));
  if (draws.uniform < response.dropout_share(true_m, spec_.max_range_m, cosine, material.dropout)) {
    range_m = kUnanswered_m;
    return;
  }
  range_m = true_m + response.sigma_m(true_m, cosine) * draws.range;
  if (range_m > spec_.max_range_m) {
    range_m = kNothing_m;
    return;
  }
  if (range_m < spec_.min_range_m || range_m < 0.0) {
    range_m = kUnanswered_m;
    return;
  }
  const double share = material.reflectivity * cosine * (1.0 + response.intensity_noise * draws.intensity);
  intensity = static_cast<float>(std::max(0.0, share));
}

/// Says what a return is of, where there is one.
void LidarSensor::label(std::size_t element, const Return& met, const LidarReading& reading,
                        LidarTruth& truth) const {
  if (!spec_.labels) return;
  truth.returned[element] = std::isfinite(reading.range_m[element]) ? met.what.what : LidarTruth::kNothing;
}

LidarSensor::Returns LidarSensor::group(std::span<const std::vector<Met>> met, std::size_t beam) const {
  Returns returns;
  for (const std::vector<Met>& probe : met) {
    if (probe[beam].range_m < returns.near.what.range_m) returns.near.what = probe[beam];
  }
  for (const std::vector<Met>& probe : met) {
    const Met& one = probe[beam];
    if (one.range_m == kNothing_m) continue;
    Return& into = one.range_m <= returns.near.what.range_m + spec_.beam.pulse_m ? returns.near : returns.far;
    if (one.range_m < into.what.range_m) into.what = one;
    into.sum_m += one.range_m;
    into.hits += 1.0;
  }
  return returns;
}

void LidarSensor::measure(std::uint32_t scan, std::span<const View> views, std::size_t begin, std::size_t end,
                          LidarReading& reading, LidarTruth& truth) const {
  std::vector<std::vector<Met>> met(n_probes_, std::vector<Met>(end - begin));
  for (std::size_t probe = 0; probe < n_probes_; ++probe) meet(scan, views, begin, end, probe, met[probe]);
  for (std::size_t ray = begin; ray < end; ++ray) {
    const Vec3 direction = views[moment_of_[ray]].R_world_sensor * directions_[0][ray];
    truth.range_m[ray] = met[0][ray - begin].range_m;
    truth.what[ray] = met[0][ray - begin].what;
    const Returns returns = group(met, ray - begin);
    const bool takes_far = spec_.returns == 1 && returns.far.hits > returns.near.hits;
    const Return& first = takes_far ? returns.far : returns.near;
    put(scan, ray, 0, first, kNothing_m, direction, reading);
    label(ray, first, reading, truth);
    if (spec_.returns == 1) continue;
    put(scan, ray, 1, returns.far, kUnanswered_m, direction, reading);
    label(spec_.pattern.rays.size() + ray, returns.far, reading, truth);
  }
}

void LidarSensor::read(std::uint32_t scan, std::int64_t t_begin_ns, const Trajectory& trajectory,
                       unsigned threads, LidarReading& reading, LidarTruth& truth) const {
  const std::size_t rays = spec_.pattern.rays.size();
  reading.t_begin_ns = t_begin_ns + begins_after_ns_;
  reading.t_end_ns = t_begin_ns + duration_ns_;
  reading.range_m.resize(rays * spec_.returns);
  reading.intensity.resize(rays * spec_.returns);
  truth.range_m.resize(rays);
  truth.what.resize(rays);
  truth.returned.resize(spec_.labels ? rays * spec_.returns : 0);
  const std::vector<View> seen_from = views(scan, t_begin_ns, trajectory);
  constexpr std::size_t kGrain = 1024;
  parallel_for(rays, kGrain, threads, [&](std::size_t begin, std::size_t end) {
    measure(scan, seen_from, begin, end, reading, truth);
  });
}

}  // namespace hallway::sense
