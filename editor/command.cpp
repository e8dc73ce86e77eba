// SPDX-License-Identifier: MIT
#include "editor/command.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "editor/commands/topics.hpp"

namespace hallway::editor {
namespace {

std::vector<CommandSpec> join() {
  const std::pair<std::string_view, std::span<const CommandSpec>> topics[]{
      {"the map", world_commands()},
      {"shapes", shape_commands()},
      {"cuts", cut_commands()},
      {"things", things_commands()},
      {"things", group_commands()},
      {"moving and copying", moves_commands()},
      {"robot, paths and lights", places_commands()},
      {"checks and pictures", check_commands()},
      {"output", output_commands()},
      {"history", history_commands()}};
  std::vector<CommandSpec> all;
  for (const auto& [topic, commands] : topics) {
    for (const CommandSpec& command : commands) all.emplace_back(command).topic = topic;
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
  const auto found = std::ranges::find(all, name, &CommandSpec::name);
  return found == all.end() ? nullptr : &*found;
}

const ArgSpec* CommandSpec::argument(std::string_view argument_name) const {
  const auto found = std::ranges::find(arguments, argument_name, &ArgSpec::name);
  return found == arguments.end() ? nullptr : &*found;
}

Units units_of(const State& state) {
  const auto world = find_entity(state, [](const EntityItem& entity) { return entity.is_world(); });
  const auto scale = world ? parse_double(state.entities[*world]->value("_scale")) : std::nullopt;
  if (scale && *scale >= 1e-6 && *scale <= 1e3) return {*scale, &state};
  return {map::kQuakeMetresPerUnit, &state};
}

void Report::note(const std::string& text) {
  say("note: " + text);
  data["notes"].push_back(text);
}

Edit without_grid(const State& state, const std::string& file) {
  Edit plain{.state = state, .file = file};
  plain.state.desk.grid_m = 0.0;
  return plain;
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
