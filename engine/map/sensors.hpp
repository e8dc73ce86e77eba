// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "map/document.hpp"
#include "map/entity_keys.hpp"
#include "map/entity_schema.hpp"
#include "map/sensor_schema.hpp"

namespace hallway::map {

/// More sensors than this no robot has.
inline constexpr std::size_t kMaxSensors = 64;

/// Whether a sensor may have that name: 1 to 64 of the characters a-z, A-Z, 0-9, _ and -.
bool is_sensor_name(std::string_view name);

/// What a key of an `hw_sensor` of a kind may be, which is also what the key of that name in a scenario's sensor may be. Throws
/// Error{kInternal} if there is no such key.
const KeySpec& sensor_key(std::string_view kind, std::string_view name);

/// The names of the keys that sensors of a kind have, but for the key `name`; in the order of the schema.
std::vector<std::string> sensor_key_names(std::string_view kind);

/// The kinds of sensors, in a fixed order.
std::span<const SensorKind> sensor_kinds();

/// Throws Error{kBadInput} if what the keys of an `hw_sensor` say together, or its name, makes no sensor: for one whose keys fit the
/// schema each for itself.
void check_sensor(const EntityKeys& keys);

/// The entities `hw_sensor` in the order of the file, which live as long as the document. Throws Error{kBadInput} for a bad, missing
/// or unknown key, for two sensors of one name, and for more than kMaxSensors.
std::vector<const Entity*> sensors(const Document& document);

}  // namespace hallway::map
