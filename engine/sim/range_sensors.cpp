// SPDX-License-Identifier: MIT
// Keys of sensors that send beams of light or sound.
#include <array>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "sim/pattern_file.hpp"
#include "sim/sensor_kinds.hpp"

namespace hallway::sim {
namespace {

constexpr std::array kSpinKeys{"rings",    "lowest_deg", "highest_deg", "columns",
                               "from_deg", "step_deg",   "clockwise"};

/// That of a file beside the one that names it.
sense::RayPattern read_named_pattern(SensorReader& sensor) {
  for (const char* key : kSpinKeys) {
    if (sensor.has(key)) throw sensor.error(key, "is given together with `pattern`, which has all beams");
  }
  const double rate_hz = sensor.number_if_told("rate_hz");
  if (rate_hz == 0.0) throw sensor.error("pattern", "needs `rate_hz`: a scan takes the time to the next one");
  return read_pattern_file(sensor.file("pattern"), 1.0 / rate_hz);
}

sense::RayPattern read_pattern(SensorReader& sensor) {
  if (sensor.has("pattern")) return read_named_pattern(sensor);
  sense::SpinSpec spin;
  spin.from_rad = sensor.angle("from_deg");
  spin.step_rad = sensor.angle("step_deg") * (sensor.flag("clockwise") ? -1.0 : 1.0);
  spin.columns = sensor.whole("columns");
  const double lowest = sensor.angle("lowest_deg"), highest = sensor.angle("highest_deg");
  spin.elevations_rad = sense::equal_elevations(lowest, highest, sensor.whole("rings"));
  try {
    return sense::spinning_pattern(spin);
  } catch (const Error& error) {
    throw sensor.error("columns", error.message());
  }
}

std::vector<Vec2> read_corners(SensorReader& sensor) {
  if (!sensor.has("beam_m")) return {};
  const std::vector<double> numbers = sensor.list("beam_m", 2 * sense::kMostBeamCorners);
  if (numbers.size() % 2 != 0) throw sensor.error("beam_m", "has an odd number of coordinates");
  std::vector<Vec2> corners;
  for (std::size_t i = 0; i < numbers.size(); i += 2) corners.emplace_back(numbers[i], numbers[i + 1]);
  return corners;
}

/// Pings at equal steps, evenly over the sweep.
sense::RayPattern read_pings(SensorReader& sensor) {
  const std::uint32_t n = sensor.whole("pings");
  const double from = sensor.angle("first_deg"), step = sensor.angle("ping_step_deg");
  const bool at_once = sensor.number("sweep_s") == 0.0;
  sense::RayPattern pattern{.width = n, .height = 1};
  for (std::uint32_t i = 0; i < n; ++i)
    pattern.rays.push_back(
        {.azimuth_rad = from + step * i, .share = at_once ? 0.0 : static_cast<double>(i) / n});
  return pattern;
}

template <typename Spec>
void read_reach(SensorReader& sensor, Spec& spec) {
  spec.min_range_m = sensor.number("min_range_m");
  spec.max_range_m = sensor.number("max_range_m");
  sensor.check_ranges(spec.min_range_m, spec.max_range_m);
  if (spec.max_range_m == 0.0) throw sensor.error("max_range_m", "must be above 0");
}

}  // namespace

std::span<const char* const> spin_keys() {
  return kSpinKeys;
}

sense::LidarSpec read_lidar(const std::string& name, SensorReader& sensor) {
  sense::LidarSpec spec;
  spec.name = name;
  spec.pattern = read_pattern(sensor);
  read_reach(sensor, spec);
  spec.response = {.noise_m = sensor.number("noise_m"),
                   .noise_per_m = sensor.number("noise_per_m"),
                   .noise_incidence = sensor.angle("noise_incidence_deg"),
                   .dropout = sensor.number("dropout"),
                   .dropout_at_max = sensor.number("dropout_at_max"),
                   .dropout_incidence = sensor.number("dropout_incidence"),
                   .intensity_noise = sensor.number("intensity_noise")};
  spec.beam = {.divergence_rad = sensor.angle("beam_deg"), .pulse_m = sensor.number("pulse_m")};
  spec.returns = sensor.whole("returns");
  spec.skew = sensor.flag("skew");
  spec.own_body = sensor.flag("own_body");
  spec.true_ranges = sensor.flag("true_ranges");
  if (sensor.has("labels")) spec.labels = sensor.flag("labels");
  sensor.place(spec);
  return spec;
}

sense::SonarSpec read_sonar(const std::string& name, SensorReader& sensor) {
  sense::SonarSpec spec;
  spec.name = name;
  spec.pings = read_pings(sensor);
  spec.sweep_ns = std::llround(sensor.number("sweep_s") * 1e9);
  spec.head_radius_m = sensor.number("head_radius_m");
  spec.beam = {.cone_rad = sensor.angle("cone_deg"),
               .polygon = read_corners(sensor),
               .height_rad = sensor.angle("height_deg"),
               .resolution_rad = sensor.angle("resolution_deg")};
  read_reach(sensor, spec);
  spec.response = {.noise_m = sensor.number("noise_m"),
                   .noise_per_m = sensor.number("noise_per_m"),
                   .missed = sensor.number("missed_rate"),
                   .false_echo = sensor.number("false_rate")};
  spec.echoes = sensor.whole("echoes");
  spec.apart_m = sensor.number("echo_apart_m");
  spec.crosstalk = sensor.flag("crosstalk");
  spec.own_body = sensor.flag("own_body");
  sensor.place(spec);
  try {
    sense::echo_rays(spec.beam, spec.max_range_m);
  } catch (const Error& error) {
    throw sensor.error(spec.beam.polygon.empty() ? "resolution_deg" : "beam_m", error.message());
  }
  return spec;
}

sense::InfraredSpec read_infrared(const std::string& name, SensorReader& sensor) {
  sense::InfraredSpec spec;
  spec.name = name;
  read_reach(sensor, spec);
  spec.noise_m = sensor.number("noise_m");
  spec.noise_per_m = sensor.number("noise_per_m");
  spec.noise_per_m2 = sensor.number("noise_per_m2");
  spec.least_light = sensor.number("least_light");
  spec.missed = sensor.number("missed_rate");
  spec.false_reading = sensor.number("false_rate");
  spec.near_m = sensor.number("near_m");
  if (spec.near_m > spec.max_range_m)
    throw sensor.error("near_m", "near_m = " + format_double(spec.near_m) +
                                     " is above max_range_m = " + format_double(spec.max_range_m));
  sensor.place(spec);
  return spec;
}

}  // namespace hallway::sim
