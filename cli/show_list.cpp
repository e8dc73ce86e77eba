// SPDX-License-Identifier: MIT
#include "show_list.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>

#include "base/refuse.hpp"
#include "base/text.hpp"
#include "compiled_map.hpp"

namespace hallway::cli {
namespace {

constexpr std::string_view kPvsFrom = "pvs-from";

const std::vector<std::string>& map_layers() {
  static const std::vector<std::string> kNames{"portals", "leak", "bsp-depth", "wireframe",
                                               std::string(kPvsFrom)};
  return kNames;
}

/// Layers that are switched on and off, by name.
template <typename Of>
struct Switch {
  const char* name;
  bool Of::*member;
};

constexpr std::array<Switch<run::MapThings>, 5> kThings{{{"start", &run::MapThings::start},
                                                         {"paths", &run::MapThings::paths},
                                                         {"sensors", &run::MapThings::sensors},
                                                         {"lights", &run::MapThings::lights},
                                                         {"rooms", &run::MapThings::rooms}}};
constexpr std::array<Switch<run::MapView>, 4> kViews{{{"portals", &run::MapView::portals},
                                                      {"leak", &run::MapView::leak},
                                                      {"bsp-depth", &run::MapView::bsp_depth},
                                                      {"wireframe", &run::MapView::wireframe}}};

std::vector<std::string> thing_names() {
  std::vector<std::string> names;
  for (const auto& thing : kThings) names.emplace_back(thing.name);
  return names;
}

[[noreturn]] void refuse_name(const char* option, std::string_view name) {
  std::vector<std::string> names = sim::picture_layer_names();
  for (const auto& more : {thing_names(), map_layers()}) names.insert(names.end(), more.begin(), more.end());
  refuse("{} knows no layer \"{}\"{}; there are: {}", option, printable(name), suggestion(name, names),
         fmt::join(names, ", "));
}

/// The layer of a run of that name.
std::optional<sim::PictureLayer> run_layer(std::string_view name) {
  const std::vector<std::string>& names = sim::picture_layer_names();
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return static_cast<sim::PictureLayer>(found - names.begin());
}

/// Switches a layer that is one of `switches`. @return whether it is
template <typename Of, std::size_t N>
bool set(Of& layers, const std::array<Switch<Of>, N>& switches, std::string_view name, bool on) {
  for (const Switch<Of>& one : switches) {
    if (name != one.name) continue;
    layers.*one.member = on;
    return true;
  }
  return false;
}

void add_layer(ShowList& show, std::string_view name) {
  if (const auto layer = run_layer(name)) {
    if (std::ranges::find(show.run, *layer) == show.run.end()) show.run.push_back(*layer);
  } else if (set(show.things, kThings, name, true)) {
    if (show.thing.empty()) show.thing = name;
  } else if (!set(show.map, kViews, name, true)) {
    refuse_name("--show", name);
  }
}

void hide_layer(ShowList& show, std::string_view name) {
  if (name == "all") {
    show.run.clear();
    show.things = {.start = false, .paths = false, .sensors = false, .lights = false, .rooms = false};
  } else if (const auto layer = run_layer(name)) {
    std::erase(show.run, *layer);
  } else if (!set(show.things, kThings, name, false) && !set(show.map, kViews, name, false)) {
    refuse_name("--hide", name);
  }
}

/// A value's layers; the three numbers of a place are joined again.
void add_value(ShowList& show, const std::string& value) {
  const auto parts = split(value, ',');
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::string_view part = trim(parts[i]);
    const std::size_t equals = part.find('=');
    if (part.substr(0, equals) != kPvsFrom) {
      add_layer(show, part);
      continue;
    }
    std::string place(equals == std::string_view::npos ? std::string_view() : part.substr(equals + 1));
    for (int more = 0; more < 2 && i + 1 < parts.size(); ++more) place += "," + std::string(parts[++i]);
    show.map.pvs_from_m = parse_place("--show pvs-from=", place);
  }
}

}  // namespace

ShowList parse_show(const std::vector<std::string>& show, const std::vector<std::string>& hide) {
  ShowList list;
  list.run = sim::default_picture_layers();
  for (const std::string& value : hide) {
    for (const std::string_view name : split(value, ',')) hide_layer(list, trim(name));
  }
  for (const std::string& value : show) add_value(list, value);
  if (list.map.bsp_depth && list.map.pvs_from_m) {
    refuse("--show colours the faces by bsp-depth or by pvs-from, not by both");
  }
  return list;
}

std::string run_layer_names() {
  return fmt::format("{}", fmt::join(sim::picture_layer_names(), ", "));
}

std::string map_layer_names() {
  return fmt::format("{}=X,Y,Z", fmt::join(map_layers(), ", "));
}

std::string thing_layer_names() {
  return fmt::format("{}", fmt::join(thing_names(), ", "));
}

}  // namespace hallway::cli
