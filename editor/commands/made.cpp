// SPDX-License-Identifier: MIT
#include "editor/commands/made.hpp"

#include <utility>
#include <vector>

#include "base/error.hpp"
#include "editor/made_line.hpp"

namespace hallway::editor {

std::string made_line(const Edit& edit, std::string_view command, const Arguments& arguments) {
  const CommandSpec& spec = *find_command(command);
  const double scale = edit.metres_per_unit();
  Arguments rounded = arguments;
  for (const ArgSpec& argument : spec.arguments) {
    const std::string name(argument.name);
    if (!arguments.has(name)) continue;
    if (argument.kind == ArgKind::kPlace) {
      rounded.set(name, Vec3(scale * edit.units(arguments.place(name))));
    } else if (argument.kind == ArgKind::kPlaces) {
      std::vector<Vec3> places = arguments.places(name);
      for (Vec3& place : places) place = scale * edit.units(place);
      rounded.set(name, std::move(places));
    }
  }
  return line_of(spec, rounded);
}

std::optional<Call> made_call(const State& state, const EntityItem& entity) {
  const std::string* line = entity.head->find(kMadeKey);
  if (line == nullptr) return std::nullopt;
  try {
    Call call = parse_line(*line, units_of(state));
    if (call.command == nullptr) return std::nullopt;
    return call;
  } catch (const Error&) {
    return std::nullopt;  // a map is read whatever stands in it
  }
}

}  // namespace hallway::editor
