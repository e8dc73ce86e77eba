// SPDX-License-Identifier: MIT
//
// Choosing things and looking at them.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <set>

#include "base/refuse.hpp"
#include "base/text.hpp"
#include "editor/commands/common_arguments.hpp"
#include "editor/commands/topics.hpp"
#include "editor/made_line.hpp"
#include "editor/selection.hpp"
#include "editor/shapes.hpp"
#include "editor/transform.hpp"

namespace hallway::editor {
namespace {

using Json = nlohmann::ordered_json;

constexpr ArgSpec kLimit =
    ArgSpec{"limit", ArgKind::kWhole, "how many are shown at most", "100"}.within(1, 1e6);

constexpr std::array kSelect{
    ArgSpec{"what", ArgKind::kWhat, "things, or `none`"}.needed(),
    ArgSpec{"how", ArgKind::kChoice, "these alone, these too, or all but these", "only", "only add remove"}};
constexpr std::array kList{ArgSpec{"what", ArgKind::kWhat, "things", "all"}, kLimit};
constexpr std::array kInfo{kThings};
constexpr std::array kMeasure{ArgSpec{"from", ArgKind::kPlace, "one place"},
                              ArgSpec{"to", ArgKind::kPlace, "another"},
                              ArgSpec{"what", ArgKind::kWhat, "things, instead of two places"}};
constexpr std::array kFind{
    ArgSpec{"text", ArgKind::kText, "part of a key, a value or a material; capitals do not matter"}.needed(),
    kLimit};

// ---- Texts ------------------------------------------------------------------------------------------------------

Vec3 metres(const Edit& edit, const Vec3& place) {
  constexpr double kFine = 1e4;  // a tenth of a millimetre
  Vec3 result = place * edit.metres_per_unit();
  for (double& x : result) x = std::round(x * kFine) / kFine + 0.0;
  return result;
}

std::string place_text(const Vec3& place) {
  return format_double(place.x()) + ',' + format_double(place.y()) + ',' + format_double(place.z());
}

Json json_of(const Vec3& place) {
  return Json::array({place.x(), place.y(), place.z()});
}

/// "0,0,0 to 6,4,2.7" or one place, metres; empty for what has no place.
std::string where_text(const Edit& edit, const Box& box) {
  if (box.isEmpty()) return {};
  const std::string low = place_text(metres(edit, box.min()));
  return box.min() == box.max() ? low : low + " to " + place_text(metres(edit, box.max()));
}

Json where_json(const Edit& edit, const Box& box) {
  if (box.isEmpty()) return nullptr;
  return {{"min_m", json_of(metres(edit, box.min()))}, {"max_m", json_of(metres(edit, box.max()))}};
}

double cubic_metres(const Edit& edit, double volume) {
  constexpr double kFine = 1e9;
  return std::round(volume * std::pow(edit.metres_per_unit(), 3) * kFine) / kFine;
}

void say_rest(Edit& edit, std::size_t count, std::size_t limit) {
  edit.report.data["count"] = count;
  if (count > limit) edit.report.say("… and {} more of {}; `limit` shows more", count - limit, count);
}

// ---- Choosing and looking -----------------------------------------------------------------------------------------

void select(Edit& edit, const Arguments& arguments) {
  const std::string& what = arguments.text("what");
  const std::string& how = arguments.text("how");
  std::set<Id> chosen;
  if (how != "only") {
    for (const Thing& thing : things_of(edit.state, edit.state.desk.selection))
      chosen.insert(id_of(edit.state, thing));
  }
  if (what != "none") {
    for (const Thing& thing : resolve(edit.state, what)) {
      if (how == "remove") {
        chosen.erase(id_of(edit.state, thing));
      } else {
        chosen.insert(id_of(edit.state, thing));
      }
    }
  }
  edit.state.desk.selection.assign(chosen.begin(), chosen.end());
  edit.report.data["selected"] = chosen;
  edit.report.say("{} selected", chosen.size());
}

void list_one(Edit& edit, const Thing& thing) {
  const EntityItem& entity = *edit.state.entities[thing.entity];
  const Box box = bounds_together(edit.state, {thing});
  const std::string where = where_text(edit, box);
  edit.report.say(describe(edit.state, thing) + (where.empty() ? "" : "  " + where));
  Json one = {{"id", id_of(edit.state, thing)}, {"kind", thing.brush ? "brush" : "entity"}};
  if (thing.brush) {
    one["entity"] = entity.id;
  } else {
    one["class"] = entity.classname();
    one["name"] = name_of(entity);
  }
  one["bounds"] = where_json(edit, box);
  edit.report.data["things"].push_back(std::move(one));
}

void list(Edit& edit, const Arguments& arguments) {
  edit.report.data["things"] = Json::array();
  const auto& entities = edit.state.entities;
  const bool nothing = std::ranges::all_of(entities, [](const auto& entity) {
    return entity->classname() == "worldspawn" && entity->brushes.empty();
  });
  if (nothing && arguments.text("what") == "all") {
    edit.report.say("the map is empty");
    edit.report.data["count"] = 0;
    return;
  }
  const auto things = resolve(edit.state, arguments.text("what"));
  const auto limit = static_cast<std::size_t>(arguments.whole("limit"));
  for (std::size_t i = 0; i < std::min(limit, things.size()); ++i) list_one(edit, things[i]);
  say_rest(edit, things.size(), limit);
}

void info_one(Edit& edit, const Thing& thing) {
  const EntityItem& entity = *edit.state.entities[thing.entity];
  auto& lines = edit.report.lines;
  const Box box = bounds_together(edit.state, {thing});
  double volume = 0.0;
  std::set<std::string> materials;
  const auto brushes = brushes_of(edit.state, thing);
  for (const map::Brush* brush : brushes) {
    volume += volume_of(*brush);
    for (const map::Face& face : brush->faces) materials.insert(face.material);
  }
  Json one = {{"id", id_of(edit.state, thing)}, {"is", describe(edit.state, thing)}};
  lines.push_back(describe(edit.state, thing));
  if (!thing.brush) {
    one["keys"] = Json::object();
    for (const map::KeyValue& pair : entity.head->keys) {
      one["keys"][pair.key] = pair.value;
      lines.push_back(fmt::format("  {} = {}", printable(pair.key), printable(pair.value)));
    }
  }
  one["bounds"] = where_json(edit, box);
  if (!box.isEmpty()) lines.push_back("  at " + where_text(edit, box) + " m");
  if (!brushes.empty()) {
    one["brushes"] = brushes.size();
    one["volume_m3"] = cubic_metres(edit, volume);
    one["materials"] = materials;
    lines.push_back(fmt::format("  {} brush{}, {} m3", brushes.size(), brushes.size() == 1 ? "" : "es",
                                format_double(cubic_metres(edit, volume))));
    lines.push_back(fmt::format("  materials: {}", printable(fmt::format("{}", fmt::join(materials, ", ")))));
  }
  const auto members = with_members(edit.state, {thing});
  one["members"] = Json::array();
  for (const Thing& member : members) {
    if (member == thing) continue;
    one["members"].push_back(id_of(edit.state, member));
    lines.push_back("  with " + describe(edit.state, member));
  }
  if (const std::string* made = thing.brush ? nullptr : entity.head->find(kMadeKey)) one["made_by"] = *made;
  edit.report.data["things"].push_back(std::move(one));
}

void info(Edit& edit, const Arguments& arguments) {
  edit.report.data["things"] = Json::array();
  for (const Thing& thing : resolve(edit.state, arguments.text("what"))) info_one(edit, thing);
}

void measure_places(Edit& edit, const Arguments& arguments) {
  const Vec3 way = arguments.place("to") - arguments.place("from");
  const double scale = edit.metres_per_unit();
  const auto rounded = [](double x) { return std::round(x * 1e4) / 1e4 + 0.0; };  // a tenth of a millimetre
  const Vec3 along(rounded(way.x()), rounded(way.y()), rounded(way.z()));
  const double distance = rounded(way.norm()), level = rounded(way.head<2>().norm());
  edit.report.data = {{"distance_m", distance},
                      {"horizontal_m", level},
                      {"way_m", json_of(along)},
                      {"distance_units", rounded(way.norm() / scale)}};
  edit.report.say("{} m, horizontally {} m, along the axes {}", format_double(distance), format_double(level),
                  place_text(along));
}

void measure(Edit& edit, const Arguments& arguments) {
  const bool places = arguments.has("from") && arguments.has("to");
  const bool one_place = arguments.has("from") != arguments.has("to");
  if (one_place || places == arguments.has("what"))
    refuse("measure: either two places, `from` and `to`, or things, `what`");
  if (places) return measure_places(edit, arguments);
  const auto things = with_members(edit.state, resolve(edit.state, arguments.text("what")));
  const Box box = bounds_together(edit.state, things);
  double volume = 0.0;
  for (const Thing& thing : things) {
    const bool solid = edit.state.entities[thing.entity]->classname() != "hw_subtract";
    for (const map::Brush* brush : brushes_of(edit.state, thing)) volume += solid ? volume_of(*brush) : 0.0;
  }
  if (box.isEmpty()) refuse("measure: that has neither brushes nor an origin");
  const Vec3 size = metres(edit, box.sizes());
  edit.report.data = {{"bounds", where_json(edit, box)},
                      {"size_m", json_of(size)},
                      {"volume_m3", cubic_metres(edit, volume)}};
  edit.report.say("{} m: {} m, {} m3 solid", where_text(edit, box), place_text(size),
                  format_double(cubic_metres(edit, volume)));
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

void find_text(Edit& edit, const Arguments& arguments) {
  const std::string wanted = lower(arguments.text("text"));
  if (wanted.empty()) refuse("find: the text is empty");
  const auto has = [&](const std::string& text) { return lower(text).find(wanted) != std::string::npos; };
  std::vector<std::pair<Thing, std::string>> found;
  for (std::size_t e = 0; e < edit.state.entities.size(); ++e) {
    const EntityItem& entity = *edit.state.entities[e];
    for (const map::KeyValue& pair : entity.head->keys) {
      if (has(pair.key) || has(pair.value)) found.push_back({{e, {}}, pair.key + " = " + pair.value});
    }
    for (std::size_t b = 0; b < entity.brushes.size(); ++b) {
      std::set<std::string> materials;
      for (const map::Face& face : entity.brushes[b].brush->faces) {
        if (has(face.material)) materials.insert(face.material);
      }
      for (const std::string& material : materials) found.push_back({{e, b}, "material " + material});
    }
  }
  const auto limit = static_cast<std::size_t>(arguments.whole("limit"));
  edit.report.data["found"] = Json::array();
  for (std::size_t i = 0; i < std::min(limit, found.size()); ++i) {
    const auto& [thing, text] = found[i];
    edit.report.data["found"].push_back({{"id", id_of(edit.state, thing)}, {"text", text}});
    edit.report.say(describe(edit.state, thing) + "  " + printable(text));
  }
  say_rest(edit, found.size(), limit);
  if (!found.empty()) return;
  edit.report.say("\"{}\" is nowhere in the map", printable(arguments.text("text")));
  edit.report.status = 1;
}

constexpr std::string_view kLamp = "entity light at 2,3,2.5 light=300 targetname=lamp";

constexpr std::array kThingsCommands{
    CommandSpec{.name = "select",
                .summary = "choose things, which `selected` then means",
                .arguments = kSelect,
                .example = "select lamp",
                .before = kLamp,
                .run = &select},
    CommandSpec{.name = "list",
                .summary = "number, class, name and place of things",
                .details = "Places are in metres: the lowest and the highest corner of what a thing occupies "
                           "with all that is in it.",
                .arguments = kList,
                .example = "list class=light",
                .before = kLamp,
                .run = &list},
    CommandSpec{.name = "info",
                .summary = "all there is to know of things",
                .details = "Keys, bounds, volume, materials, members, and for shapes the line that made them "
                           "(`_hw_made`). The volume is the sum "
                           "of the thing's own brushes; where they overlap it counts twice.",
                .arguments = kInfo,
                .example = "info lamp",
                .before = kLamp,
                .run = &info},
    CommandSpec{.name = "measure",
                .summary = "the distance of two places, or the size of things",
                .details = "Of things with what is in them; brushes that take away count for the size and "
                           "not for the volume.",
                .arguments = kMeasure,
                .example = "measure from 0,0 to 3,4",
                .run = &measure},
    CommandSpec{.name = "find",
                .summary = "look for a text in keys, values and materials",
                .details = "Ends with status 1 where there is none.",
                .arguments = kFind,
                .example = "find lamp",
                .before = kLamp,
                .run = &find_text},
};

}  // namespace

std::span<const CommandSpec> things_commands() {
  return kThingsCommands;
}

}  // namespace hallway::editor
