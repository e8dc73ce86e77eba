// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "map/document.hpp"
#include "map/entity_schema.hpp"
#include "sim/scenario.hpp"
#include "sim/table_reader.hpp"

namespace hallway::sim {

/// Where a sensor's table stands, and where its settings are noted.
struct SensorTable {
  const std::string& file;
  const TomlTable& table;
  int line = 0;
  std::vector<Setting>& settings;
  std::span<const sense::BumpZone> zones{};  ///< of a bumper that says no number of zones; none: its default
};

/// A sensor, and where it is in truth.
struct MountedSpec {
  SensorSpec spec{};
  std::optional<Pose> mount_error{};  ///< none: where it is told to be
};

/// The kind that a sensor's table names; "points" where it names none.
std::string sensor_kind(const TomlTable& table);

/// The value of a map's key as a scenario would have it, with line 0.
TomlNode scenario_value(const map::KeySpec& key, const std::string& value);

/// False for a sensor whose table has `mounted = false`.
bool is_mounted(const std::string& name, const SensorTable& where);

/// What a sensor's table says. Ranges and defaults are those of a map's sensors (map::sensor_key()).
/// @param kind  counts where the table has no `kind`; none: it must have one
/// Throws Error for a value that is wrong, and for a key that sensors of its kind do not have, as TableReader does.
MountedSpec read_sensor(const std::string& name, const SensorTable& where,
                        const std::optional<std::size_t>& kind = std::nullopt);

/// Appends it to a scenario's sensors.
void add_sensor(Scenario& scenario, const std::string& name, MountedSpec sensor);

/// Gives a scenario that has no sensors those of its map (entities `hw_sensor`, in the order of the file), and notes their settings.
/// Throws Error{kBadInput} with the map's file and line for one that is wrong.
void take_map_sensors(Scenario& scenario, const map::Document& document);

}  // namespace hallway::sim
