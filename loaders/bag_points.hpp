// SPDX-License-Identifier: MIT
#pragma once

#include "import/recording.hpp"
#include "loaders/bag_messages.hpp"

namespace hallway::loaders::bag {

/// Replaces the points and the time of `frame` by those of a cloud: x, y and z are 32- or 64-bit floats anywhere in a point, of either byte order.
/// Each `stride`-th point is taken. Throws Error{kBadInput} for a cloud whose numbers contradict each other.
void take_cloud(const Cloud& cloud, std::uint32_t stride, import::Frame& frame);

/// The same for a scan, whose points lie in its plane, z = 0. Each `stride`-th beam is taken; those without a range from range_min to range_max have
/// hit nothing and give no point.
void take_scan(const Scan& scan, std::uint32_t stride, import::Frame& frame);

}  // namespace hallway::loaders::bag
