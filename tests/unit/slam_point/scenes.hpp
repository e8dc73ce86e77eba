// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "slam_point/core/types.hpp"

/// Made-up worlds of points and what a moving sensor sees of them, with the truth.
namespace hallway::slam_point::scenes {

/// One point as seen, with the true landmark it is.
struct Seen {
  Vec3 point = Vec3::Zero();  ///< sensor frame [m]
  std::int64_t truth = -1;    ///< index of the true landmark, -1 when unknown
};

/// A run of a sensor through a world.
struct Log {
  std::vector<Vec3> landmarks;  ///< world [m]
  std::vector<Pose> poses;      ///< T_world_sensor of each frame
  std::vector<std::vector<Seen>> frames;
};

/// What the sensor sees.
struct Sensor {
  double half_width_rad = std::numbers::pi / 4.0;
  double half_height_rad = std::numbers::pi / 6.0;
  double range_m = 100.0;
  double noise_m = 0.05;
};

/// Random numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(0.0, 1.0)));
    return radius * std::cos(2.0 * std::numbers::pi * uniform(0.0, 1.0));
  }

 private:
  std::mt19937_64 engine_;
};

inline Pose heading(const Vec3& at, double yaw) {
  return {Eigen::Quaterniond(std::cos(0.5 * yaw), 0.0, 0.0, std::sin(0.5 * yaw)), at};
}

/// Poses along x(s), looking where it goes; s = 0, 1, … steps.
template <typename Path>
std::vector<Pose> follow(int steps, Path&& path) {
  std::vector<Pose> poses;
  for (int s = 0; s < steps; ++s) {
    const Vec3 ahead = path(s + 0.5) - path(s - 0.5);
    poses.push_back(heading(path(static_cast<double>(s)), std::atan2(ahead.y(), ahead.x())));
  }
  return poses;
}

/// Lemniscate of Gerono: `size_m` is its half width.
inline Vec3 eight(double phase, double size_m) {
  return {size_m * std::sin(phase), size_m * std::sin(phase) * std::cos(phase), 0.0};
}

/// Adds what the sensor sees from each pose.
inline void observe(Log& log, const Sensor& sensor, Random& random) {
  for (const Pose& pose : log.poses) {
    std::vector<Seen> frame;
    const Pose inverse = pose.inverse();
    for (std::size_t l = 0; l < log.landmarks.size(); ++l) {
      const Vec3 p = inverse * log.landmarks[l];
      if (p.norm() > sensor.range_m || std::abs(std::atan2(p.y(), p.x())) > sensor.half_width_rad ||
          std::abs(std::atan2(p.z(), std::hypot(p.x(), p.y()))) > sensor.half_height_rad) {
        continue;
      }
      const Vec3 noise = sensor.noise_m * Vec3(random.normal(), random.normal(), random.normal());
      frame.push_back({p + noise, static_cast<std::int64_t>(l)});
    }
    log.frames.push_back(std::move(frame));
  }
}

/// `count` landmarks spread along the poses, up to 15 m sideways and 5 m up or down.
inline void scatter(Log& log, int count, Random& random) {
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(log.poses.size())));
    // A little beyond either end, so that the last frame still has something to see.
    log.landmarks.push_back(log.poses[at] * Vec3(random.uniform(-60.0, 60.0), random.uniform(-15.0, 15.0),
                                                 random.uniform(-5.0, 5.0)));
  }
}

/// Figure eight of about 1150 m a lap in 3800 frames; `per_100m` landmarks.
inline Log figure_eight(int steps, double per_100m, std::uint64_t seed, const Sensor& sensor = {}) {
  Random random(seed);
  Log log;
  log.poses = follow(steps, [](double s) { return eight(2.0 * std::numbers::pi * s / 3800.0, 189.0); });
  scatter(log, static_cast<int>(11.5 * per_100m), random);
  observe(log, sensor, random);
  return log;
}

/// A ring road of 300 m radius, wobbling; two laps of 6000 frames.
inline Log ring(int steps, double per_100m, std::uint64_t seed, const Sensor& sensor = {}) {
  Random random(seed);
  Log log;
  log.poses = follow(steps, [](double s) {
    const double a = 2.0 * std::numbers::pi * s / 6000.0;
    const double r = 300.0 + 12.0 * std::sin(9.0 * a);
    return Vec3(r * std::cos(a), r * std::sin(a), 4.0 * std::sin(3.0 * a));
  });
  scatter(log, static_cast<int>(19.0 * per_100m), random);
  observe(log, sensor, random);
  return log;
}

/// A wavy road that never returns, `steps` of 0.3 m, about as many landmarks in view everywhere.
inline Log new_ground(int steps, double per_100m, std::uint64_t seed, const Sensor& sensor = {}) {
  Random random(seed);
  Log log;
  log.poses = follow(steps, [](double s) {
    const double x = 0.3 * s;
    return Vec3(x, 30.0 * std::sin(x / 120.0), 0.0);
  });
  scatter(log, static_cast<int>(0.003 * per_100m * steps), random);
  observe(log, sensor, random);
  return log;
}

/// Points 0.3–0.6 m apart on the walls (2.5 m high) of an office of four rooms off a corridor, walked through twice at
/// 0.1 m a frame, turning on the spot at 9 degrees a frame; 110 by 60 degrees of view, range 8 m. Walls hide nothing.
inline Log office(std::uint64_t seed, double noise_m = 0.02) {
  Random random(seed);
  Log log;
  const auto wall = [&](double x0, double y0, double x1, double y1) {
    const double length = std::hypot(x1 - x0, y1 - y0);
    const int wanted = static_cast<int>(2.5 * length / 0.8);
    const std::size_t first = log.landmarks.size();
    for (int tries = 0;
         tries < 20 * wanted && log.landmarks.size() < first + static_cast<std::size_t>(wanted); ++tries) {
      const double f = random.uniform(0.0, 1.0);
      const Vec3 p(x0 + f * (x1 - x0), y0 + f * (y1 - y0), random.uniform(-1.0, 1.5));
      bool free = true;
      for (const Vec3& other : log.landmarks) free = free && (other - p).norm() >= 0.3;
      if (free) log.landmarks.push_back(p);
    }
  };
  wall(0, 0, 20, 0);
  wall(20, 0, 20, 12);
  wall(20, 12, 0, 12);
  wall(0, 12, 0, 0);
  wall(0, 5, 9, 5);
  wall(11, 5, 20, 5);
  wall(0, 7, 9, 7);
  wall(11, 7, 20, 7);
  wall(10, 0, 10, 4);
  wall(10, 8, 10, 12);
  const std::vector<Vec3> stops{{1, 6, 0},    {10, 6, 0}, {10, 4.5, 0}, {5, 2.5, 0},  {10, 4.5, 0},
                                {10, 6, 0},   {19, 6, 0}, {10, 6, 0},   {10, 7.5, 0}, {15, 9.5, 0},
                                {10, 7.5, 0}, {10, 6, 0}, {1, 6, 0}};
  double yaw = 0.0;
  for (int lap = 0; lap < 2; ++lap) {
    for (std::size_t s = 0; s + 1 < stops.size(); ++s) {
      const Vec3 way = stops[s + 1] - stops[s];
      const double target = std::atan2(way.y(), way.x());
      const double turn_step = 9.0 * std::numbers::pi / 180.0;
      double left = std::remainder(target - yaw, 2.0 * std::numbers::pi);
      while (std::abs(left) > 1e-9) {
        const double turn = std::clamp(left, -turn_step, turn_step);
        yaw += turn;
        left -= turn;
        log.poses.push_back(heading(stops[s], yaw));
      }
      const int frames = static_cast<int>(way.norm() / 0.1);
      for (int f = 1; f <= frames; ++f) log.poses.push_back(heading(stops[s] + way * f / frames, yaw));
    }
  }
  Sensor sensor;
  sensor.half_width_rad = 55.0 * std::numbers::pi / 180.0;
  sensor.range_m = 8.0;
  sensor.noise_m = noise_m;
  observe(log, sensor, random);
  return log;
}

}  // namespace hallway::slam_point::scenes
