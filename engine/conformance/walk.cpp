// SPDX-License-Identifier: MIT
#include "conformance/walk.hpp"

#include <cmath>
#include <utility>

#include "base/random.hpp"

namespace hallway::conformance {
namespace {

constexpr double kStep_m = 0.05;
constexpr double kTurn_rad = 0.01;
constexpr double kNoise_m = 0.005;
constexpr std::int64_t kStep_ns = 50'000'000;

}  // namespace

std::vector<hw_point3_t> random_points(std::uint64_t seed, std::uint32_t stream, std::size_t count) {
  const Random random(seed, stream);
  std::vector<hw_point3_t> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    points[i] = {random.uniform(0, 3 * i, -10.0, 10.0), random.uniform(0, 3 * i + 1, -10.0, 10.0),
                 random.uniform(0, 3 * i + 2, -1.0, 3.0)};
  }
  return points;
}

std::vector<hw_point3_t> walk_points(std::uint64_t seed, std::uint64_t step) {
  const std::vector<hw_point3_t> world = random_points(seed, stream_id("conformance.world"), kWalkPoints);
  const Random noise(seed, stream_id("conformance.noise"));
  const double yaw = kTurn_rad * static_cast<double>(step);
  const double cosine = std::cos(yaw);
  const double sine = std::sin(yaw);
  std::vector<hw_point3_t> seen;
  for (std::size_t k = 0; k < world.size(); ++k) {
    const std::size_t i = (k + 7 * step) % world.size();
    const double x = world[i].x - kStep_m * static_cast<double>(step);
    const double y = world[i].y;
    const auto wobble = [&](std::size_t axis) {
      return kNoise_m * noise.normal(static_cast<std::uint32_t>(step), 3 * i + axis);
    };
    seen.push_back(
        {cosine * x + sine * y + wobble(0), cosine * y - sine * x + wobble(1), world[i].z + wobble(2)});
  }
  return seen;
}

Frame frame_of(std::uint64_t step, std::vector<hw_point3_t> points) {
  Frame frame{.sequence = step, .t_ns = static_cast<std::int64_t>(step) * kStep_ns};
  frame.readings.push_back({.sequence = step, .points = std::move(points)});
  return frame;
}

Frame walk_frame(std::uint64_t seed, std::uint64_t step) {
  return frame_of(step, walk_points(seed, step));
}

}  // namespace hallway::conformance
