// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>
#include <utility>

#include "base/toml_node.hpp"

namespace hallway::sim {

/// Key and value as a map has them.
using PresetKey = std::pair<std::string_view, std::string_view>;

/// Values of keys for a class of hardware.
struct SensorPreset {
  std::string_view kind;  ///< of the sensor
  std::string_view name;
  std::span<const PresetKey> values;
};

/// In a fixed order.
std::span<const SensorPreset> sensor_presets();

/// A sensor's table with what its preset says where it says nothing itself.
TomlTable with_preset(const TomlTable& table);

}  // namespace hallway::sim
