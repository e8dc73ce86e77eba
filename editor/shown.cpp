// SPDX-License-Identifier: MIT
#include "editor/shown.hpp"

#include <vector>

#include "editor/selection.hpp"

namespace hallway::editor {

State without_hidden(const State& state) {
  std::vector<Thing> hidden;
  for (const Id id : state.desk.hidden) {
    if (const auto thing = find(state, id)) hidden.push_back(*thing);
  }
  std::erase_if(hidden, [&](const Thing& thing) {
    return !thing.brush && state.entities[thing.entity]->classname() == "worldspawn";
  });
  State shown = state;
  remove(shown, with_members(shown, hidden));
  return shown;
}

}  // namespace hallway::editor
