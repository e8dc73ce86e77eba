// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "base/toml_node.hpp"
#include "sim/setting.hpp"

namespace hallway::sim {

/// Puts the settings of the command line into a scenario, in their order. `plugin=NAME` comes first wherever it stands: it
/// leaves that plugin alone in the pipeline, with the parameters that the scenario has for it, if any. The robot's
/// `speed_m_s` and `loop_steps` displace each other. Whether the values fit is not looked at.
/// Throws Error{kUsage} for a key that the scenario has no place for, with a suggestion.
/// @param sensors  that the scenario has besides its own: those of its robot file
void apply_overrides(TomlTable& scenario, std::span<const Override> overrides,
                     std::span<const std::string> sensors = {});

}  // namespace hallway::sim
