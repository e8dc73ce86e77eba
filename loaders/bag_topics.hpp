// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "loaders/bag_messages.hpp"

namespace hallway::loaders::bag {

/// Types of messages that are read as points, and as true poses.
bool is_point_type(std::string_view type);
bool is_pose_type(std::string_view type);

/// The topic of points that is meant: `wanted` or, where that is empty, the only one. Throws Error{kUsage} with the bag's topics where there is no such
/// topic, it has no points, or there are several; Error{kBadInput} where there is none.
const Topic& choose_points(const std::vector<Topic>& topics, std::string_view wanted);
/// The topic of poses of this name. Throws as above.
const Topic& choose_poses(const std::vector<Topic>& topics, std::string_view wanted);

}  // namespace hallway::loaders::bag
