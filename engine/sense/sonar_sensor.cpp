// SPDX-License-Identifier: MIT
#include "sense/sonar_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/text.hpp"
#include "sense/spec_check.hpp"

namespace hallway::sense {
namespace {

constexpr double kInSight = 1.0 - 1e-9;  ///< of a way that must be free to a point on a surface
constexpr double kUpright = 0.75;  ///< of the resolution; rays are at most sqrt(1/2) of it from any direction

// Random numbers of one ping.
namespace sonar_draw {
enum Draw : std::uint64_t { kMissed, kFalse, kFalseAt, kNoise, kDraws = kNoise + 8 };
}

Mat3 turned_to(double azimuth_rad, double elevation_rad) {
  return (Eigen::AngleAxisd(azimuth_rad, Vec3::UnitZ()) * Eigen::AngleAxisd(-elevation_rad, Vec3::UnitY()))
      .toRotationMatrix();
}

}  // namespace

SonarSensor::SonarSensor(SonarSpec spec, const trace::Scene& scene, const Surfaces& surfaces,
                         std::uint64_t seed, const std::optional<OwnBody>& body)
    : spec_(std::move(spec)),
      scene_(scene),
      surfaces_(surfaces),
      random_(seed, stream_id("sensor.sonar." + spec_.name)) {
  check();
  try {
    beam_ = echo_rays(spec_.beam, spec_.max_range_m);
  } catch (const Error& error) {
    throw Error(ErrorCode::kBadInput, error.message(), {.element = "sensor `" + printable(spec_.name) + "`"});
  }
  bool meets_body = false;
  for (const PatternRay& ping : spec_.pings.rays) {
    R_sensor_head_.push_back(turned_to(ping.azimuth_rad, ping.elevation_rad));
    offsets_ns_.push_back(std::llround(ping.share * static_cast<double>(spec_.sweep_ns)));
    if (!body || !spec_.own_body) continue;
    const Mat3 R_body_head = spec_.T_body_sensor.q.toRotationMatrix() * R_sensor_head_.back();
    const Vec3 origin = spec_.T_body_sensor.t + R_body_head.col(0) * spec_.head_radius_m;
    std::vector<double>& own = own_body_m_.emplace_back();
    for (const EchoRay& ray : beam_) {
      own.push_back(body->entry_m(origin, R_body_head * ray.direction));
      meets_body = meets_body || own.back() <= spec_.max_range_m;
    }
  }
  if (!meets_body) own_body_m_.clear();
}

void SonarSensor::check() const {
  const SpecCheck check(spec_.name);
  const auto refuse = [&](const std::string& problem) {
    throw Error(ErrorCode::kBadInput, problem, {.element = "sensor `" + printable(spec_.name) + "`"});
  };
  try {
    check_pattern(spec_.pings);
  } catch (const Error& error) {
    refuse(error.message());
  }
  check.mount(spec_.T_body_sensor);
  check.ranges(spec_.min_range_m, spec_.max_range_m);
  check.positive("max_range_m", spec_.max_range_m);
  check.not_negative("head_radius_m", spec_.head_radius_m);
  check.not_negative("noise_m", spec_.response.noise_m);
  check.not_negative("noise_per_m", spec_.response.noise_per_m);
  check.within("missed", spec_.response.missed, 0.0, 1.0);
  check.within("false_echo", spec_.response.false_echo, 0.0, 1.0);
  check.not_negative("apart_m", spec_.apart_m);
  if (spec_.sweep_ns < 0) refuse("sweep_ns is below 0");
  if (spec_.echoes < 1 || spec_.echoes > 8) refuse("echoes must be from 1 to 8");
}

std::vector<SonarSensor::Head> SonarSensor::heads(std::uint32_t sweep, std::int64_t t_begin_ns,
                                                  const Trajectory& trajectory) const {
  std::vector<Head> heads;
  heads.reserve(offsets_ns_.size());
  for (std::size_t ping = 0; ping < offsets_ns_.size(); ++ping) {
    const Pose T_world_sensor = trajectory.pose_at(t_begin_ns + offsets_ns_[ping]) * spec_.T_body_sensor;
    check_pose(spec_.name, sweep, T_world_sensor);
    const Mat3 R_world_head = T_world_sensor.q.toRotationMatrix() * R_sensor_head_[ping];
    heads.push_back({R_world_head, T_world_sensor.t + R_world_head.col(0) * spec_.head_radius_m});
  }
  return heads;
}

/// Whether sound that meets a triangle comes back.
bool SonarSensor::throws_back(std::uint32_t triangle, const Vec3& direction) const {
  const double up_to_rad =
      std::max(surfaces_.material(triangle).echo_angle_rad, kUpright * spec_.beam.resolution_rad);
  return surfaces_.cosine(triangle, direction) >= std::cos(up_to_rad);
}

/// What comes back of a ping: nearest first, those that are too near each other once.
std::vector<SonarSensor::Echo> SonarSensor::echoes_of(const Head& head, std::size_t ping) const {
  std::vector<trace::Ray> rays;
  rays.reserve(beam_.size());
  for (const EchoRay& ray : beam_)
    rays.push_back({head.origin, head.R_world * ray.direction, ray.heard.back().to_m});
  std::vector<std::optional<trace::Hit>> hits(rays.size());
  scene_.first_hits(rays, hits);

  std::vector<Echo> echoes;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    Echo echo;
    if (hits[i]) echo = {hits[i]->distance, hits[i]->triangle, beam_[i].direction};
    const bool is_body = !own_body_m_.empty() && own_body_m_[ping][i] < echo.range_m;
    if (is_body) echo = {own_body_m_[ping][i], SonarTruth::kOwnBody, beam_[i].direction};
    if (echo.range_m > spec_.max_range_m || !beam_[i].hears(echo.range_m)) continue;
    if (!is_body && !throws_back(echo.what, rays[i].direction)) continue;
    echoes.push_back(echo);
  }
  return echoes;
}

/// The echo of another head's ping, as this head hears it.
SonarSensor::Echo SonarSensor::heard_from(const Head& head, const Head& other, const Echo& echo) const {
  if (echo.what == SonarTruth::kNothing) return {};
  const Vec3 point = other.origin + other.R_world * echo.direction * echo.range_m;
  const Vec3 way = head.R_world.transpose() * (point - head.origin);
  const double distance = way.norm();
  if (distance == 0.0) return {};
  const Vec3 direction = way / distance;
  const auto nearest =
      std::ranges::max_element(beam_, {}, [&](const EchoRay& ray) { return ray.direction.dot(direction); });
  const double beside = std::acos(std::clamp(nearest->direction.dot(direction), -1.0, 1.0));
  if (beside > spec_.beam.resolution_rad || !nearest->hears(distance)) return {};
  if (scene_.occluded(head.origin, head.origin + kInSight * (point - head.origin))) return {};
  return {0.5 * (distance + echo.range_m), echo.what, direction};
}

/// Makes a reading of what a head hears.
void SonarSensor::put(std::uint32_t sweep, std::size_t ping, std::vector<Echo>& echoes, SonarReading& reading,
                      SonarTruth& truth) const {
  std::ranges::stable_sort(echoes, {}, &Echo::range_m);
  const Echo nearest = echoes.empty() ? Echo() : echoes.front();
  truth.range_m[ping] = nearest.range_m;
  truth.what[ping] = nearest.what;
  truth.direction[ping] = R_sensor_head_[ping] * nearest.direction;

  const auto draw = [&](sonar_draw::Draw what, std::uint64_t more = 0) {
    return random_.uniform(sweep, ping * sonar_draw::kDraws + what + more);
  };
  std::vector<double> ranges;
  if (!(draw(sonar_draw::kMissed) < spec_.response.missed)) {
    for (const Echo& echo : echoes) {
      if (echo.range_m < spec_.min_range_m) continue;
      if (ranges.size() == spec_.echoes) break;
      if (ranges.empty() || echo.range_m - ranges.back() >= spec_.apart_m) ranges.push_back(echo.range_m);
    }
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      const double sigma = std::hypot(spec_.response.noise_m, spec_.response.noise_per_m * ranges[i]);
      if (sigma > 0.0)
        ranges[i] += sigma * random_.normal(sweep, ping * sonar_draw::kDraws + sonar_draw::kNoise + i);
    }
  }
  if (draw(sonar_draw::kFalse) < spec_.response.false_echo)
    ranges.push_back(spec_.min_range_m +
                     (spec_.max_range_m - spec_.min_range_m) * draw(sonar_draw::kFalseAt));
  std::erase_if(ranges,
                [this](double range) { return !(range <= spec_.max_range_m && range >= spec_.min_range_m); });
  std::ranges::sort(ranges);
  const std::size_t n = offsets_ns_.size();
  for (std::size_t echo = 0; echo < spec_.echoes; ++echo)
    reading.range_m[echo * n + ping] =
        echo < ranges.size() ? ranges[echo] : (echo == 0 ? kNothing_m : kUnanswered_m);
}

void SonarSensor::read(std::uint32_t sweep, std::int64_t t_begin_ns, const Trajectory& trajectory,
                       unsigned threads, SonarReading& reading, SonarTruth& truth) const {
  const std::size_t n = offsets_ns_.size();
  reading.t_begin_ns = t_begin_ns;
  reading.t_end_ns = t_begin_ns + *std::ranges::max_element(offsets_ns_);
  reading.range_m.resize(n * spec_.echoes);
  truth.range_m.resize(n);
  truth.what.resize(n);
  truth.direction.resize(n);
  const std::vector<Head> from = heads(sweep, t_begin_ns, trajectory);
  std::vector<std::vector<Echo>> echoes(n);
  parallel_for(n, 1, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t ping = begin; ping < end; ++ping) echoes[ping] = echoes_of(from[ping], ping);
  });
  std::vector<std::vector<Echo>> heard = echoes;
  if (spec_.crosstalk) {
    for (std::size_t ping = 0; ping < n; ++ping) {
      for (std::size_t other = 0; other < n; ++other) {
        if (other == ping || offsets_ns_[other] != offsets_ns_[ping] || echoes[other].empty()) continue;
        const Echo& nearest = *std::ranges::min_element(echoes[other], {}, &Echo::range_m);
        const Echo echo = heard_from(from[ping], from[other], nearest);
        if (echo.what != SonarTruth::kNothing) heard[ping].push_back(echo);
      }
    }
  }
  for (std::size_t ping = 0; ping < n; ++ping) put(sweep, ping, heard[ping], reading, truth);
}

}  // namespace hallway::sense
