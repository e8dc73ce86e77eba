// SPDX-License-Identifier: MIT
#include "conformance/walk.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "base/random.hpp"
#include "conformance/loaded_library.hpp"
#include "conformance/ordinary_robot.hpp"
#include "conformance/test.hpp"
#include "host/samples/example.hpp"

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

std::vector<hw_point3_t> walk_points(std::uint64_t seed, std::uint64_t step, std::size_t count) {
  const std::vector<hw_point3_t> world = random_points(seed, stream_id("conformance.world"), count);
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

Walk::Walk(const hw_plugin_info_t& info, std::uint64_t seed) : seed_(seed) {
  const std::vector<std::uint32_t> inputs = inputs_of(info);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const host::SampleKind* kind = host::find_sample_kind(inputs[i]);
    if (kind == nullptr) {
      if (i < info.n_inputs && !unknown_need_) unknown_need_ = inputs[i];
    } else if (std::ranges::find(kinds_, kind) == kinds_.end()) {
      kinds_.push_back(kind);
    }
  }
  if (kinds_.empty()) kinds_.push_back(host::sample_kinds().front());
}

std::vector<hw_sensor_info_t> Walk::sensors(std::uint32_t first_id) const {
  if (unknown_need_)
    throw Skipped("the plugin needs samples of " + host::sample_kind_name(*unknown_need_) +
                  ", which this suite does not make");
  std::vector<hw_sensor_info_t> sensors;
  for (const host::SampleKind* kind : kinds_) {
    hw_sensor_info_t sensor{};
    sensor.id = first_id++;
    sensor.kind = kind->kind;
    sensor.name = "sensor";
    sensor.T_body_sensor.orientation[0] = 1.0;
    sensor.horizontal_fov = 6.283185307179586;
    sensor.vertical_fov = 3.0;
    sensor.min_range_m = 0.1;
    sensor.max_range_m = 30.0;
    for (double& noise : sensor.noise_m) noise = 0.01;
    sensor.size = sizeof sensor;
    sensor.intrinsics = ordinary_intrinsics(kind->kind);
    sensor.rate_hz = 20.0;
    sensor.latency_s = 0.0;
    for (double& noise : sensor.noise_per_m) noise = 0.001;
    sensors.push_back(sensor);
  }
  return sensors;
}

Reading Walk::reading(const host::SampleKind& kind, std::uint64_t step, std::size_t elements) const {
  Reading reading{.kind = kind.kind, .sequence = step, .duration_ns = kind.example_ns};
  if (&kind == &host::kPointSamples) {
    reading.points = walk_points(seed_, step, elements);
    return reading;
  }
  const auto payload = std::make_shared<host::Payload>();
  host::make_example(*payload, kind, {.elements = elements, .seed = seed_, .step = step});
  reading.payload = payload;
  return reading;
}

Frame Walk::frame(std::uint64_t step, std::optional<std::size_t> elements) const {
  Frame frame{.sequence = step, .t_ns = static_cast<std::int64_t>(step) * kStep_ns};
  for (const host::SampleKind* kind : kinds_) {
    const std::size_t ordinary = kind == &host::kPointSamples ? kWalkPoints : kWalkElements;
    frame.readings.push_back(reading(*kind, step, elements.value_or(ordinary)));
    frame.readings.back().sensor = static_cast<std::uint32_t>(frame.readings.size() - 1);
  }
  return frame;
}

std::string Walk::kinds() const {
  std::string text;
  for (const host::SampleKind* kind : kinds_) text += (text.empty() ? "" : ", ") + std::string(kind->name);
  return text;
}

Reading& reading_of(Frame& frame, const host::SampleKind& kind) {
  const auto found = std::ranges::find(frame.readings, kind.kind, &Reading::kind);
  if (found == frame.readings.end()) throw Skipped("the plugin takes no " + std::string(kind.name));
  return *found;
}

Reading& points_in(Frame& frame) {
  return reading_of(frame, host::kPointSamples);
}

}  // namespace hallway::conformance
