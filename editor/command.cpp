// SPDX-License-Identifier: MIT
#include "editor/command.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "editor/commands/topics.hpp"

namespace hallway::editor {
namespace {

std::vector<CommandSpec> join() {
  std::vector<CommandSpec> all;
  for (const auto& topic :
       {world_commands(), shape_commands(), cut_commands(), things_commands(), group_commands(),
        moves_commands(), places_commands(), check_commands(), output_commands(), history_commands()}) {
    all.insert(all.end(), topic.begin(), topic.end());
  }
  return all;
}

}  // namespace

std::span<const CommandSpec> commands() {
  static const std::vector<CommandSpec> all = join();
  return all;
}

const CommandSpec* find_command(std::string_view name) {
  const auto all = commands();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const CommandSpec& spec) { return spec.name == name; });
  return found == all.end() ? nullptr : &*found;
}

Units units_of(const State& state) {
  for (const auto& entity : state.entities) {
    if (entity->classname() != "worldspawn") continue;
    const std::string* scale = entity->head->find("_scale");
    const auto value = scale != nullptr ? parse_double(*scale) : std::nullopt;
    if (value && *value >= 1e-6 && *value <= 1e3) return {*value, &state};
    break;
  }
  return {map::kQuakeMetresPerUnit, &state};
}

double Edit::metres_per_unit() const {
  return units_of(state).metres_per_unit;
}

Vec3 Edit::units(const Vec3& place_m) const {
  Vec3 place = place_m;
  if (const double grid = state.desk.grid_m; grid > 0.0) {
    for (double& x : place) x = std::round(x / grid) * grid;
  }
  // A place typed in metres is meant to the tenth of a micrometre; what lies below is rounding.
  constexpr double kFine = 1e7;
  const double scale = metres_per_unit();
  for (double& x : place) x = std::round(x / scale * (scale * kFine)) / (scale * kFine);
  return place;
}

}  // namespace hallway::editor
