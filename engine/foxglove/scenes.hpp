// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "foxglove/messages.hpp"
#include "log/drive_tables.hpp"
#include "log/landmarks.hpp"
#include "log/map_answer.hpp"

namespace hallway::foxglove {

// What is drawn of a run, in the colours of its pictures.

inline constexpr Colour kTruthColour{0.0, 0.408, 0.659};
inline constexpr Colour kEstimateColour{0.835, 0.369, 0.0};

/// True landmarks as balls, in the frame "world".
Entity true_landmark_balls(std::span<const log::Landmark> landmarks);

/// A plugin's landmarks as balls, coloured by status, in the frame "map": mapped ones orange, temporary ones grey, dynamic
/// ones purple.
Entity landmark_balls(std::span<const log::MapLandmark> landmarks);

/// The outlines of a plugin's planes, coloured as landmarks are, in the frame "map"; edges that are certain are wider.
Entity mapped_plane_outlines(std::span<const log::PlaneLandmark> planes);

/// The mapped landmarks of each submap, joined to its middle by lines of one colour, and the middles of its mapped planes, joined to its origin;
/// in the frame "map".
Entity submap_stars(const log::MapAnswer& map);

/// The outline of an upright body, below and above with lines between, in the frame of the true body.
/// @param corners  body, metres
Entity robot_body(std::span<const Vec2> corners, double bottom_m, double top_m);

/// A command as an arrow as long as the way of one second and an arc of the turn in it, in the frame of the true body.
Entity command_arrow(const log::ObeyedCommand& command);

/// A contact as a ball, in the frame "world".
/// @param number  tells it from the run's other contacts
Entity contact_ball(const log::ContactRow& contact, std::uint32_t number);

}  // namespace hallway::foxglove
