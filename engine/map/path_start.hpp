// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "map/document.hpp"

namespace hallway::map {

/// The names of the map's paths, in the order of the file. Throws Error{kBadInput} for a path without a name.
std::vector<std::string> path_names(const Document& document);

/// What is to be said where the map has a robot start and the path does not begin there (0.05 m apart, 1 m in height): both places, and that the
/// path's counts. Empty where it begins there or the map has no start. Throws what find_path() and find_robot_start() throw.
std::optional<Error> start_off_path(const Document& document, std::string_view path);

}  // namespace hallway::map
