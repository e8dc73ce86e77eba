// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/status.h>

#include <string>

namespace hallway::host {

/// An hw_error_t to be filled by a plugin.
hw_error_t empty_error();

/// The reason of a call that failed with `status`, safe to print: the plugin's own words, else the status's
/// name.
std::string error_text(const hw_error_t& error, hw_status_t status);

}  // namespace hallway::host
