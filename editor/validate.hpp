// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "editor/state.hpp"
#include "map/check.hpp"

namespace hallway::editor {

/// Something that is wrong with a map, or likely to be, and the command that mends it.
struct Fault {
  std::string id{};  ///< short stable name (docs/formats.md, docs/edit.md)
  map::Severity severity = map::Severity::kError;
  Id thing = 0;  ///< 0: the map as a whole
  int line = 0;  ///< in the map's file, as it was read; 0 for what is new
  std::string message{};
  std::string fix{};  ///< a command as it would be typed; empty where only the author can know
};

/// Names of all faults that validate() can find.
std::vector<std::string> fault_ids();

/// Everything that is wrong: what `hallway map check` finds, and what an editor can see besides. Ordered by thing, id and message. A fix
/// is made for the state as it is: apply one, and ask again. Throws nothing for what a map holds.
std::vector<Fault> validate(const State& state, const std::string& file);

}  // namespace hallway::editor
