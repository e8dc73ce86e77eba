// SPDX-License-Identifier: MIT
#include "sim/sensor_presets.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <variant>

#include "map/sensors.hpp"
#include "sim/sensor_kinds.hpp"
#include "sim/sensors.hpp"

namespace hallway::sim {
namespace {

// Named for classes of hardware: values as their data sheets have them.
constexpr std::array kLidar16{
    PresetKey{"rate_hz", "10"},      PresetKey{"rings", "16"},          PresetKey{"lowest_deg", "-15"},
    PresetKey{"highest_deg", "15"},  PresetKey{"columns", "1800"},      PresetKey{"step_deg", "0.2"},
    PresetKey{"min_range_m", "0.5"}, PresetKey{"max_range_m", "100"},   PresetKey{"noise_m", "0.02"},
    PresetKey{"beam_deg", "0"},      PresetKey{"dropout_at_max", "0.2"}};
constexpr std::array kLidar64{PresetKey{"rate_hz", "10"},       PresetKey{"rings", "64"},
                              PresetKey{"lowest_deg", "-24.8"}, PresetKey{"highest_deg", "2"},
                              PresetKey{"columns", "2048"},     PresetKey{"step_deg", "0.17578125"},
                              PresetKey{"min_range_m", "0.9"},  PresetKey{"max_range_m", "120"},
                              PresetKey{"noise_m", "0.02"},     PresetKey{"dropout_at_max", "0.3"}};
constexpr std::array kLidar2d{PresetKey{"rate_hz", "40"},     PresetKey{"rings", "1"},
                              PresetKey{"lowest_deg", "0"},   PresetKey{"highest_deg", "0"},
                              PresetKey{"columns", "1081"},   PresetKey{"step_deg", "0.25"},
                              PresetKey{"from_deg", "-135"},  PresetKey{"min_range_m", "0.1"},
                              PresetKey{"max_range_m", "30"}, PresetKey{"noise_m", "0.01"}};

// Densities and walks of a consumer's and of a tactical grade unit.
constexpr std::array kImuMems{PresetKey{"rate_hz", "200"},      PresetKey{"gyro_noise", "1.7e-4"},
                              PresetKey{"gyro_walk", "2e-5"},   PresetKey{"gyro_bias_sigma", "0.01"},
                              PresetKey{"gyro_limit", "34.9"},  PresetKey{"force_noise", "2e-3"},
                              PresetKey{"force_walk", "3e-3"},  PresetKey{"force_bias_sigma", "0.1"},
                              PresetKey{"force_limit", "156.9"}};
constexpr std::array kImuTactical{PresetKey{"rate_hz", "200"},     PresetKey{"gyro_noise", "3.5e-5"},
                                  PresetKey{"gyro_walk", "4e-7"},  PresetKey{"gyro_bias_sigma", "5e-5"},
                                  PresetKey{"gyro_limit", "8.7"},  PresetKey{"force_noise", "3e-4"},
                                  PresetKey{"force_walk", "3e-5"}, PresetKey{"force_bias_sigma", "5e-3"},
                                  PresetKey{"force_limit", "98"}};
// A head of the 6500 series, turned by a stepper motor in 24 steps; a detector of the GP2Y0A21 family.
constexpr std::array kSonarPolaroid{
    PresetKey{"rate_hz", "0.8"},      PresetKey{"cone_deg", "30"},     PresetKey{"min_range_m", "0.27"},
    PresetKey{"max_range_m", "10.7"}, PresetKey{"noise_m", "0.003"},   PresetKey{"noise_per_m", "0.01"},
    PresetKey{"pings", "24"},         PresetKey{"first_deg", "0"},     PresetKey{"ping_step_deg", "15"},
    PresetKey{"sweep_s", "1.2"},      PresetKey{"missed_rate", "0.01"}};
constexpr std::array kIrSharp{PresetKey{"rate_hz", "25"},        PresetKey{"min_range_m", "0.1"},
                              PresetKey{"max_range_m", "0.8"},   PresetKey{"noise_m", "0.002"},
                              PresetKey{"noise_per_m2", "0.03"}, PresetKey{"least_light", "0.08"},
                              PresetKey{"missed_rate", "0.005"}, PresetKey{"false_rate", "0.002"}};
// A receiver without corrections, whose data sheet says 2.5 m of circular error; a compass of a phone's class.
constexpr std::array kGnssMeter{PresetKey{"rate_hz", "5"},           PresetKey{"noise_m", "0.3"},
                                PresetKey{"correlated_m", "1.5"},    PresetKey{"noise_up_m", "0.6"},
                                PresetKey{"correlated_up_m", "2.5"}, PresetKey{"correlation_s", "100"}};
constexpr std::array kCompass{PresetKey{"rate_hz", "10"}, PresetKey{"noise_deg", "1"},
                              PresetKey{"bias_sigma_deg", "2"}};
constexpr std::array kPresets{SensorPreset{"gnss", "gnss_meter", kGnssMeter},
                              SensorPreset{"compass", "compass", kCompass},
                              SensorPreset{"sonar", "sonar_polaroid", kSonarPolaroid},
                              SensorPreset{"infrared", "ir_sharp", kIrSharp},
                              SensorPreset{"lidar", "lidar16", kLidar16},
                              SensorPreset{"lidar", "lidar64", kLidar64},
                              SensorPreset{"lidar", "lidar2d_270", kLidar2d},
                              SensorPreset{"imu", "imu_mems", kImuMems},
                              SensorPreset{"imu", "imu_tactical", kImuTactical}};

}  // namespace

std::span<const SensorPreset> sensor_presets() {
  return kPresets;
}

TomlTable with_preset(const TomlTable& table) {
  const TomlNode* preset = find(table, "preset");
  const auto* name = preset != nullptr ? std::get_if<std::string>(&preset->value) : nullptr;
  TomlTable filled = table;
  if (name == nullptr) return filled;
  const std::string kind = sensor_kind(table);
  const auto found = std::ranges::find_if(
      kPresets, [&](const SensorPreset& known) { return known.kind == kind && known.name == *name; });
  if (found == kPresets.end()) return filled;
  const bool has_pattern = find(filled, "pattern") != nullptr;
  for (const auto& [key, value] : found->values) {
    if (find(filled, key) != nullptr) continue;
    if (has_pattern && std::ranges::find(spin_keys(), key) != spin_keys().end()) continue;
    TomlNode node = scenario_value(map::sensor_key(kind, key), std::string(value));
    node.line = preset->line;
    node.file = preset->file;
    assign(filled, key, std::move(node));
  }
  return filled;
}

}  // namespace hallway::sim
