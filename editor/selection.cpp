// SPDX-License-Identifier: MIT
#include "editor/selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "base/refuse.hpp"
#include "base/text.hpp"
#include "editor/command.hpp"
#include "editor/shapes.hpp"

namespace hallway::editor {
namespace {

bool inside(const Box& box, const Box& part) {
  return !part.isEmpty() && box.contains(part);
}

/// Without brushes whose entity is there too.
std::vector<Thing> without_parts(std::set<Thing> things) {
  std::erase_if(things, [&](const Thing& thing) {
    return thing.brush && things.contains(Thing{thing.entity, {}});
  });
  return {things.begin(), things.end()};
}

/// Finds what the terms of a text mean in a state.
class Resolver {
 public:
  explicit Resolver(const State& state) : state_(state) {}

  std::vector<Thing> resolve(std::string_view what) {
    for (const std::string_view term : split(what, '+')) add_term(trim(term));
    if (found_.empty()) refuse("\"{}\" means nothing: the map is empty", printable(what));
    return without_parts(std::move(found_));
  }

 private:
  void add_term(std::string_view term) {
    if (term.empty()) refuse("a name, a number or another word for things is missing");
    if (term == "all") {
      const auto all = all_things(state_);
      found_.insert(all.begin(), all.end());
      return;
    }
    if (term == "selected") return add_selected();
    if (term.starts_with('#')) return add_range(term.substr(1), term);
    if (term[0] >= '0' && term[0] <= '9') return add_range(term, term);
    const std::size_t equals = term.find('=');
    if (equals != std::string_view::npos) return add_filter(term.substr(0, equals), term.substr(equals + 1));
    add_named(term);
  }

  void add_selected() {
    const std::size_t before = found_.size();
    const auto things = things_of(state_, state_.desk.selection);
    found_.insert(things.begin(), things.end());
    if (found_.size() == before) refuse("nothing is selected; `select` chooses");
  }

  void add_range(std::string_view range, std::string_view term) {
    const std::size_t dots = range.find("..");
    const auto first = parse_uint(range.substr(0, dots));
    std::string_view end = dots == std::string_view::npos ? range : range.substr(dots + 2);
    if (end.starts_with('#')) end.remove_prefix(1);
    const auto last = parse_uint(end);
    if (!first || !last) refuse("\"{}\" is no number of a thing, nor two of them as 12..15", printable(term));
    const std::size_t before = found_.size();
    bool any = false;
    for_each_thing(state_, [&](const Thing& thing, Id id) {
      if (id < *first || id > *last) return;
      any = true;
      found_.insert(thing);
    });
    if (!any && found_.size() == before) refuse("there is nothing of the number {}", printable(term));
  }

  void add_filter(std::string_view kind, std::string_view value) {
    const std::size_t before = found_.size();
    if (kind == "class") {
      add_entities([&](const EntityItem& entity) { return fits(entity.classname(), value); });
    } else if (kind == "material") {
      for (std::size_t e = 0; e < state_.entities.size(); ++e) {
        add_brushes(e, [&](const map::Brush& brush) {
          return std::ranges::any_of(brush.faces,
                                     [&](const map::Face& face) { return fits(face.material, value); });
        });
      }
    } else if (kind == "group") {
      add_group(value);
    } else if (kind == "box") {
      add_box(value);
    } else {
      refuse("\"{}=\" chooses nothing{}; there are class=, material=, group= and box=", printable(kind),
             suggestion(kind, {"class", "material", "group", "box"}));
    }
    if (found_.size() == before)
      refuse("there is nothing that \"{}={}\" fits", printable(kind), printable(value));
  }

  void add_group(std::string_view name) {
    for (std::size_t e = 0; e < state_.entities.size(); ++e) {
      const EntityItem& entity = *state_.entities[e];
      if (!group_number(entity) || !fits(name_of(entity), name)) continue;
      for (std::size_t b = 0; b < entity.brushes.size(); ++b) found_.insert({e, b});
      for (const Thing& member : with_members(state_, {Thing{e, {}}})) {
        if (member.entity != e) found_.insert(member);
      }
    }
  }

  void add_box(std::string_view text) {
    const auto numbers = split(text, ',');
    Vec3 corner[2];
    for (std::size_t i = 0; i < 6; ++i) {
      const auto number = numbers.size() == 6 ? parse_double(trim(numbers[i])) : std::nullopt;
      if (!number) refuse("box={} is not six numbers: X,Y,Z of two corners in metres", printable(text));
      corner[i / 3][static_cast<Eigen::Index>(i % 3)] = *number / units_of(state_).metres_per_unit;
    }
    Box box(corner[0].cwiseMin(corner[1]), corner[0].cwiseMax(corner[1]));
    const Vec3 slack = Vec3::Constant(1e-6 * (1.0 + box.sizes().norm()));
    box = Box(box.min() - slack, box.max() + slack);
    for (std::size_t e = 0; e < state_.entities.size(); ++e) {
      const EntityItem& entity = *state_.entities[e];
      if (!entity.is_world() && inside(box, bounds_of(state_, {e, {}}))) found_.insert({e, {}});
      for (std::size_t b = 0; b < entity.brushes.size(); ++b) {
        if (inside(box, bounds_of(*entity.brushes[b].brush))) found_.insert({e, b});
      }
    }
  }

  void add_named(std::string_view pattern) {
    const bool glob = pattern.find_first_of("*?") != std::string_view::npos;
    const std::size_t before = found_.size();
    bool any = false;
    add_entities([&](const EntityItem& entity) {
      const std::string name = name_of(entity);
      const bool fit = !name.empty() && (glob ? fits(name, pattern) : name == pattern);
      any = any || fit;
      return fit;
    });
    if (any || found_.size() != before) return;
    std::vector<std::string> names{"all", "selected"};
    for (const auto& entity : state_.entities) {
      if (std::string name = name_of(*entity); !name.empty()) names.push_back(std::move(name));
    }
    refuse("there is nothing named \"{}\"{}", printable(pattern), suggestion(pattern, names));
  }

  template <typename Test>
  void add_entities(Test&& test) {
    for (std::size_t e = 0; e < state_.entities.size(); ++e) {
      if (test(*state_.entities[e])) found_.insert({e, {}});
    }
  }

  template <typename Test>
  void add_brushes(std::size_t e, Test&& test) {
    const auto& brushes = state_.entities[e]->brushes;
    for (std::size_t b = 0; b < brushes.size(); ++b) {
      if (test(*brushes[b].brush)) found_.insert({e, b});
    }
  }

  const State& state_;
  std::set<Thing> found_;
};

}  // namespace

std::vector<Thing> resolve(const State& state, std::string_view what) {
  return Resolver(state).resolve(what);
}

std::vector<Thing> all_things(const State& state) {
  std::vector<Thing> things;
  for (std::size_t e = 0; e < state.entities.size(); ++e) {
    const EntityItem& entity = *state.entities[e];
    if (!entity.is_world()) things.push_back({e, {}});
    for (std::size_t b = 0; entity.is_world() && b < entity.brushes.size(); ++b) things.push_back({e, b});
  }
  return things;
}

std::vector<Thing> things_of(const State& state, const std::vector<Id>& ids) {
  const std::set<Id> wanted(ids.begin(), ids.end());
  std::vector<Thing> things;
  for_each_thing(state, [&](const Thing& thing, Id id) {
    if (wanted.contains(id)) things.push_back(thing);
  });
  return things;
}

Thing resolve_one(const State& state, std::string_view what) {
  const auto things = resolve(state, what);
  if (things.size() != 1)
    refuse("\"{}\" means {} things, where one is wanted", printable(what), things.size());
  return things.front();
}

std::string name_of(const EntityItem& entity) {
  for (const char* key : kNameKeys) {
    if (const std::string& name = entity.value(key); !name.empty()) return name;
  }
  return {};
}

std::string describe(const State& state, const Thing& thing) {
  const EntityItem& entity = *state.entities[thing.entity];
  if (thing.brush) return fmt::format("#{} brush of #{}", entity.brushes[*thing.brush].id, entity.id);
  const std::string name = name_of(entity);
  // A door is called what it was made as, and not by the class of its cut.
  const std::string* made = entity.classname() == "hw_subtract" ? entity.head->find("_hw_made") : nullptr;
  const std::string kind = group_number(entity) ? "group"
                           : made != nullptr    ? printable(made->substr(0, made->find(' ')))
                                                : printable(entity.classname());
  return name.empty() ? fmt::format("#{} {}", entity.id, kind)
                      : fmt::format("#{} {} {}", entity.id, kind, printable(name));
}

std::optional<std::string> group_number(const EntityItem& entity) {
  const std::string* number = entity.head->find("_tb_id");
  if (!entity.has("_tb_type", "_tb_group") || number == nullptr) return std::nullopt;
  return *number;
}

std::vector<Thing> with_members(const State& state, const std::vector<Thing>& things) {
  std::set<Thing> all(things.begin(), things.end());
  std::set<std::string, std::less<>> groups, paths;
  const auto open = [&](std::size_t e) {
    const EntityItem& entity = *state.entities[e];
    bool news = false;
    if (const auto number = group_number(entity)) news = groups.insert(*number).second;
    const std::string* path = entity.classname() == "hw_path" ? entity.head->find("name") : nullptr;
    if (path != nullptr) news = paths.insert(*path).second || news;
    return news;
  };
  bool again = false;
  for (const Thing& thing : things) {
    if (!thing.brush) again = open(thing.entity) || again;
  }
  while (again) {
    again = false;
    for (std::size_t e = 0; e < state.entities.size(); ++e) {
      const EntityItem& entity = *state.entities[e];
      const std::string* group = entity.head->find("_tb_group");
      const std::string* path = entity.classname() == "hw_waypoint" ? entity.head->find("path") : nullptr;
      const bool belongs =
          (group != nullptr && groups.contains(*group)) || (path != nullptr && paths.contains(*path));
      if (belongs && all.insert({e, {}}).second) again = open(e) || again;
    }
  }
  return without_parts(std::move(all));
}

State without_hidden(const State& state) {
  std::vector<Thing> hidden;
  for (const Id id : state.desk.hidden) {
    if (const auto thing = find(state, id)) hidden.push_back(*thing);
  }
  std::erase_if(hidden,
                [&](const Thing& thing) { return !thing.brush && state.entities[thing.entity]->is_world(); });
  State shown = state;
  remove(shown, with_members(shown, hidden));
  return shown;
}

std::optional<std::size_t> find_group(const State& state, std::string_view number) {
  return find_entity(state, [&](const EntityItem& entity) { return group_number(entity) == number; });
}

std::vector<std::size_t> groups_of(const State& state, const Thing& thing) {
  std::vector<std::size_t> groups;
  std::optional<std::size_t> next = thing.entity;
  while (next) {
    const EntityItem& entity = *state.entities[*next];
    if (group_number(entity)) {
      if (std::ranges::find(groups, *next) != groups.end()) break;  // groups in a circle
      groups.push_back(*next);
    }
    const std::string* above = entity.head->find("_tb_group");
    next = above != nullptr ? find_group(state, *above) : std::nullopt;
  }
  return groups;
}

namespace {

/// The bounds of a brush whose six faces are those of an upright box: what they say, without intersecting planes. Most brushes of most
/// maps are such.
std::optional<Box> bounds_of_upright_box(const map::Brush& brush) {
  if (brush.faces.size() != 6) return std::nullopt;
  Vec3 low = Vec3::Constant(-HUGE_VAL), high = Vec3::Constant(HUGE_VAL);
  for (const map::Face& face : brush.faces) {
    const auto& [a, b, c] = face.points;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      if (a[axis] != b[axis] || a[axis] != c[axis]) continue;
      const Eigen::Index u = (axis + 1) % 3, v = (axis + 2) % 3;
      const double turn = (c[u] - a[u]) * (b[v] - a[v]) - (c[v] - a[v]) * (b[u] - a[u]);
      if (turn > 0.0) high[axis] = std::min(high[axis], a[axis]);
      if (turn < 0.0) low[axis] = std::max(low[axis], a[axis]);
    }
  }
  if (!low.allFinite() || !high.allFinite() || !(low.array() < high.array()).all()) return std::nullopt;
  return Box(low, high);
}

}  // namespace

std::vector<const map::Brush*> brushes_of(const State& state, const Thing& thing) {
  const EntityItem& entity = *state.entities[thing.entity];
  if (thing.brush) return {&brush_at(state, thing)};
  std::vector<const map::Brush*> brushes;
  for (const BrushItem& item : entity.brushes) brushes.push_back(item.brush.get());
  return brushes;
}

double volume_of(const map::Brush& brush) {
  if (const auto box = bounds_of_upright_box(brush)) return box->volume();
  const auto body = body_of(brush);
  return body ? volume_of(*body) : 0.0;
}

Box bounds_of(const map::Brush& brush) {
  if (const auto box = bounds_of_upright_box(brush)) return *box;
  const auto body = body_of(brush);
  return body ? bounds_of(*body) : Box();
}

Box bounds_of(const State& state, const Thing& thing) {
  const EntityItem& entity = *state.entities[thing.entity];
  Box box;
  for (const map::Brush* brush : brushes_of(state, thing)) box.extend(bounds_of(*brush));
  const auto origin = entity.brushes.empty() ? origin_of(entity) : std::nullopt;
  if (origin) box.extend(*origin);
  return box;
}

Box bounds_together(const State& state, const std::vector<Thing>& things) {
  Box box;
  for (const Thing& thing : with_members(state, things)) box.extend(bounds_of(state, thing));
  return box;
}

std::vector<std::pair<std::optional<std::int64_t>, std::size_t>> waypoints_of(const State& state,
                                                                              std::string_view path) {
  std::vector<std::pair<std::optional<std::int64_t>, std::size_t>> waypoints;
  for (std::size_t e = 0; e < state.entities.size(); ++e) {
    const EntityItem& entity = *state.entities[e];
    if (entity.classname() == "hw_waypoint" && entity.has("path", path))
      waypoints.emplace_back(parse_int(entity.value("index")), e);
  }
  std::ranges::sort(waypoints);
  return waypoints;
}

std::optional<Vec3> three_numbers(std::string_view text) {
  Vec3 numbers;
  Eigen::Index count = 0;
  for (const std::string_view part : split(text, ' ')) {
    if (part.empty()) continue;
    const auto number = parse_double(part);
    if (!number || count == 3) return std::nullopt;
    numbers[count++] = *number;
  }
  if (count != 3) return std::nullopt;
  return numbers;
}

std::optional<Vec3> origin_of(const EntityItem& entity) {
  return three_numbers(entity.value("origin"));
}

bool fits(std::string_view text, std::string_view pattern) {
  std::size_t t = 0, p = 0;
  std::size_t star = std::string_view::npos, behind = 0;  // the last star, and the text that it has to leave
  while (t < text.size()) {
    if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t]) && pattern[p] != '*') {
      ++t;
      ++p;
    } else if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      behind = t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++behind;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

}  // namespace hallway::editor
