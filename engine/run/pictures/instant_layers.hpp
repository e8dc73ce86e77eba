// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "render/picture.hpp"
#include "run/pictures/history.hpp"
#include "run/pictures/record.hpp"

namespace hallway::run {

/// The robot with its body, as run.json has it, where it truly is; a mark where the body is not known. Throws Error{kBadInput} for a body that is none.
void add_body(render::Picture& picture, const Record& record, const Instant& now);

/// What the sensors see, as points and outlines with faint rays.
void add_seen(render::Picture& picture, const Record& record, const Instant& now);

/// The obeyed command: an arrow as long as the way of some seconds, and an arc of the turn in the same time. The legend says how many: the same
/// number in all pictures of a run.
void add_command(render::Picture& picture, const Record& record, const Instant& now);

/// Contacts until now, those of the last second larger and with their normals; without an instant all, and all alike.
void add_contacts(render::Picture& picture, const Record& record, const std::optional<Instant>& now);

/// Events until now, or all, with their kinds, where the robot was; of a kidnapping both places.
void add_events(render::Picture& picture, const Record& record, const std::optional<Instant>& now);

/// "iteration 120, 12.0 s, command 0.30 m/s ahead, 0.10 rad/s left (held)".
std::string instant_text(const Record& record, const Instant& now);

}  // namespace hallway::run
