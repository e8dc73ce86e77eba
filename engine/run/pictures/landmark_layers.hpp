// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <unordered_map>

#include "geometry/se3.hpp"
#include "log/landmarks.hpp"
#include "render/picture.hpp"
#include "run/pictures/record.hpp"
#include "sim/scenario.hpp"

namespace hallway::run {

/// Places of landmarks by their ids [m].
using LandmarkPlaces = std::unordered_map<log::LandmarkId, Vec3>;

/// The mapped landmarks where a fit puts them.
LandmarkPlaces mapped_places(const Record& record, const Pose& T_world_map);

/// Adds what a run's record says of landmarks, as far as the picture shows it: submaps, true and mapped landmarks, and lines from the ones to the
/// others, drawn longer by a power of ten, which their label states, where they are too short to be seen. Nothing where what was mapped are walls.
/// @param error_scale  by how much the lines are drawn longer; empty: as error_scale_of() says
void add_landmarks(render::Picture& picture, const Record& record, const sim::PictureSpec& spec,
                   const Pose& T_world_map, std::optional<double> error_scale = std::nullopt);

/// The power of ten by which lines from true to mapped landmarks have to be longer to be seen in a picture of them all; empty without lines.
std::optional<double> error_scale_of(const Record& record, const Pose& T_world_map);

/// Adds the true landmarks as rings.
void add_true_landmarks(render::Picture& picture, const Record& record);

}  // namespace hallway::run
