// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "host/load/plugin_info.hpp"
#include "host/stage.hpp"

namespace hallway::host {

/// Checks that each kind of sample that a plugin needs is given by a sensor or by a plugin before it, as they declare it. Throws Error{kBadInput}
/// that names plugins and kinds: nobody gives it; only one behind gives it, with an order that would do; they need each other in a circle.
void check_kinds(std::span<const PluginInfo> plugins, std::span<const SensorInfo> sensors);

}  // namespace hallway::host
