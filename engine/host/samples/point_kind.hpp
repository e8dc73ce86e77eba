// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/sample.h>

#include <cstdint>
#include <string>
#include <vector>

#include "host/samples/frame_builder.hpp"
#include "host/sensor_info.hpp"

namespace hallway::host {

/// A sensor of points of which nothing else is known, mounted at the body's origin.
SensorInfo point_sensor(std::string name = {}, std::uint32_t id = 0);

/// Adds a reading of points, as FrameBuilder::add() says.
/// @return the empty list to be filled with points in the sensor's frame, metres; valid until the next begin()
std::vector<hw_point3_t>& add_points(FrameBuilder& builder, std::uint32_t sensor_id);

/// The points added last are pixels of an image of `width` > 0 columns and `height` > 0 rows.
/// @return the empty list to be filled with the pixel (row * width + column) of each of them; valid until the next begin()
std::vector<std::uint32_t>& add_pixels(FrameBuilder& builder, std::uint32_t width, std::uint32_t height);

/// What the points added last have beside their places, as FrameBuilder::set_reading() has told their sample's times.
/// @return empty lists; each stays empty or is filled with an entry for each point; valid until the next begin()
RayLists add_point_data(FrameBuilder& builder);

}  // namespace hallway::host
