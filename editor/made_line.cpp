// SPDX-License-Identifier: MIT
#include "editor/made_line.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "base/text.hpp"
#include "editor/commands/making.hpp"
#include "editor/selection.hpp"
#include "editor/shapes.hpp"

namespace hallway::editor {
namespace {

constexpr std::size_t kMostSearched =
    64;  ///< brushes that may stand in another order than the line makes them

std::string number_text(double value) {
  constexpr double kFine = 1e10;
  const double rounded = std::abs(value) < 1e5 ? std::round(value * kFine) / kFine : value;
  return format_double(rounded + 0.0);
}

std::string place_text(const Vec3& place) {
  return number_text(place.x()) + ',' + number_text(place.y()) + ',' + number_text(place.z());
}

std::string value_text(const ArgSpec& spec, const Arguments& arguments) {
  switch (spec.kind) {
    case ArgKind::kNumber:
      return format_double(arguments.number(spec.name));
    case ArgKind::kLength:
      return number_text(arguments.number(spec.name));
    case ArgKind::kAngle:
      return number_text(arguments.number(spec.name) * 180.0 / std::numbers::pi);
    case ArgKind::kWhole:
      return std::to_string(arguments.whole(spec.name));
    case ArgKind::kPlace:
    case ArgKind::kVector:
      return place_text(arguments.place(spec.name));
    case ArgKind::kFactors: {
      std::string text = vector_text(arguments.place(spec.name));
      std::ranges::replace(text, ' ', ',');
      return text;
    }
    case ArgKind::kPlaces: {
      std::string text;
      for (const Vec3& place : arguments.places(spec.name))
        text += (text.empty() ? "" : ";") + place_text(place);
      return text;
    }
    default:
      return arguments.text(spec.name);
  }
}

struct Part {
  bool added = true;
  std::vector<Plane> planes{};
};

void add_parts(const EntityItem& entity, Id first, std::vector<Part>& parts) {
  for (const BrushItem& brush : entity.brushes) {
    if (brush.id < first) continue;
    Part& part = parts.emplace_back();
    part.added = entity.classname() != "hw_subtract";
    for (const map::Face& face : brush.brush->faces) {
      if (const auto plane = plane_of(face)) part.planes.push_back(*plane);
    }
  }
}

bool same(const Part& a, const Part& b) {
  constexpr double kTurned = 1e-6, kMoved = 1e-4;  // map units
  if (a.added != b.added || a.planes.size() != b.planes.size()) return false;
  return std::ranges::all_of(a.planes, [&](const Plane& plane) {
    return std::ranges::any_of(b.planes, [&](const Plane& other) {
      return (plane.normal - other.normal).norm() < kTurned && std::abs(plane.offset - other.offset) < kMoved;
    });
  });
}

bool same(const std::vector<Part>& a, const std::vector<Part>& b) {
  if (a.size() != b.size()) return false;
  std::vector<bool> taken(b.size(), false);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t j = i;
    if (taken[i] || !same(a[i], b[i])) {
      if (a.size() > kMostSearched) return false;
      for (j = 0; j < b.size() && (taken[j] || !same(a[i], b[j]));) ++j;
      if (j == b.size()) return false;
    }
    taken[j] = true;
  }
  return true;
}

/// The argument of a line of an opening that says what it is in.
bool names_host(const Call& call) {
  const ArgSpec* host = call.command != nullptr ? call.command->argument("in") : nullptr;
  return host != nullptr && host->kind == ArgKind::kWhat;
}

/// The call of a line that may be tried out: of a command that changes the map only and reads no file.
std::optional<Call> harmless_call(const std::string& line, const Units& units) {
  Call call = parse_line(line, units);
  if (call.command == nullptr || !std::holds_alternative<EditFunction>(call.command->run))
    return std::nullopt;
  bool placed = false;
  for (const ArgSpec& spec : call.command->arguments) {
    if (spec.kind == ArgKind::kFile && call.arguments.has(spec.name)) return std::nullopt;
    placed = placed || ((spec.kind == ArgKind::kPlace || spec.kind == ArgKind::kPlaces) &&
                        call.arguments.has(spec.name));
  }
  if (!placed && !names_host(call)) return std::nullopt;
  return call;
}

/// The group right around an entity, as WHAT means it. Empty where there is none.
std::string host_of(const State& state, std::size_t entity, bool by_name) {
  for (const std::size_t group : groups_of(state, {entity, {}})) {
    if (group == entity) continue;
    const EntityItem& host = *state.entities[group];
    return by_name && !name_of(host).empty() ? name_of(host) : "#" + std::to_string(host.id);
  }
  return {};
}

}  // namespace

std::string line_of(const CommandSpec& command, const Arguments& arguments) {
  std::string line(command.name);
  for (const ArgSpec& spec : command.arguments) {
    if (!arguments.has(spec.name)) continue;
    if (spec.kind == ArgKind::kKeys) {
      for (const auto& [key, value] : arguments.keys(spec.name)) line += ' ' + quoted(key + '=' + value);
    } else {
      line += ' ' + quoted(std::string(spec.name) + '=' + value_text(spec, arguments));
    }
  }
  return line;
}

void map_places(const CommandSpec& command, Arguments& arguments,
                const std::function<Vec3(const Vec3& place)>& change) {
  for (const ArgSpec& spec : command.arguments) {
    if (!arguments.has(spec.name)) continue;
    if (spec.kind == ArgKind::kPlace) {
      arguments.set(spec.name, change(arguments.place(spec.name)));
    } else if (spec.kind == ArgKind::kPlaces) {
      std::vector<Vec3> places = arguments.places(spec.name);
      std::ranges::transform(places, places.begin(), change);
      arguments.set(spec.name, std::move(places));
    }
  }
}

std::string made_line(const Edit& edit, std::string_view command, const Arguments& arguments) {
  const CommandSpec& spec = *find_command(command);
  const double scale = edit.metres_per_unit();
  Arguments rounded = arguments;
  map_places(spec, rounded, [&](const Vec3& place) -> Vec3 { return scale * edit.units(place); });
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

std::optional<std::size_t> maker_of(const State& state, const Thing& thing) {
  if (is_fill(*state.entities[thing.entity])) return opening_of(state, thing.entity);
  if (state.entities[thing.entity]->head->find(kMadeKey) != nullptr) return thing.entity;
  for (const std::size_t group : groups_of(state, thing)) {
    if (state.entities[group]->head->find(kMadeKey) != nullptr) return group;
  }
  return std::nullopt;
}

void forget_made(State& state, const std::vector<Thing>& things) {
  std::set<std::size_t> entities, makers;
  for (const Thing& thing : things) {
    if (!entities.insert(thing.entity).second) continue;
    if (const auto maker = maker_of(state, thing)) makers.insert(*maker);
  }
  for (const std::size_t maker : makers) set_key(state, maker, kMadeKey, {});
}

std::optional<std::string> changed_line(const std::string& line, const Units& units,
                                        const std::function<bool(Call& call)>& change) {
  try {
    Call call = parse_line(line, units);
    if (call.command != nullptr && change(call)) return line_of(*call.command, call.arguments);
  } catch (const Error&) {
    // The line is of another version, or of somebody else.
  }
  return std::nullopt;
}

std::string renamed_line(const std::string& line, const std::string& name, const Units& units) {
  return changed_line(line, units,
                      [&](Call& call) {
                        if (!call.arguments.has("name")) return false;
                        call.arguments.set("name", name);
                        return true;
                      })
      .value_or(line);
}

void name_host(State& state, std::size_t entity) {
  const std::string* line = state.entities[entity]->head->find(kMadeKey);
  const std::string host = line != nullptr ? host_of(state, entity, true) : std::string();
  if (host.empty()) return;
  const auto next = changed_line(*line, units_of(state), [&](Call& call) {
    if (!names_host(call)) return false;
    call.arguments.set("in", host);
    return true;
  });
  if (next) set_key(state, entity, kMadeKey, *next);
}

bool makes(const Edit& edit, const std::string& line, std::size_t entity) {
  const State& state = edit.state;
  std::vector<Part> wanted, made;
  auto members = with_members(state, {Thing{entity, {}}});
  if (is_opening(*state.entities[entity])) {
    std::ranges::copy(fills_of(state, entity), std::back_inserter(members));
  }
  for (const Thing& thing : members) {
    if (thing.entity == entity || maker_of(state, thing) == entity)
      add_parts(*state.entities[thing.entity], 0, wanted);
  }
  try {
    auto call = harmless_call(line, units_of(state));
    if (!call) return false;
    if (const std::string host = host_of(state, entity, false); names_host(*call) && !host.empty())
      call->arguments.set("in", host);
    Edit trial = without_grid(state, edit.file);
    remove(trial.state, members);
    const Id first = trial.state.next_id;
    std::get<EditFunction>(call->command->run)(trial, call->arguments);
    for (const auto& each : trial.state.entities) add_parts(*each, first, made);
  } catch (const Error&) {
    return false;
  }
  return same(wanted, made);
}

}  // namespace hallway::editor
