// SPDX-License-Identifier: MIT
#include "show_list.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/error.hpp"
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

[[noreturn]] void refuse_name(std::string_view name) {
  std::vector<std::string> names = sim::picture_layer_names();
  names.insert(names.end(), map_layers().begin(), map_layers().end());
  throw Error(ErrorCode::kUsage, fmt::format("--show knows no layer \"{}\"{}; there are: {}", printable(name),
                                             suggestion(name, names), fmt::join(names, ", ")));
}

void add_layer(ShowList& show, std::string_view name) {
  const std::vector<std::string>& runs = sim::picture_layer_names();
  const auto of_run = std::find(runs.begin(), runs.end(), name);
  if (of_run != runs.end()) {
    const auto layer = static_cast<sim::PictureLayer>(of_run - runs.begin());
    if (std::find(show.run.begin(), show.run.end(), layer) == show.run.end()) show.run.push_back(layer);
  } else if (name == "portals") {
    show.map.portals = true;
  } else if (name == "leak") {
    show.map.leak = true;
  } else if (name == "bsp-depth") {
    show.map.bsp_depth = true;
  } else if (name == "wireframe") {
    show.map.wireframe = true;
  } else {
    refuse_name(name);
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

ShowList parse_show(const std::vector<std::string>& values) {
  ShowList show;
  for (const std::string& value : values) add_value(show, value);
  if (show.map.bsp_depth && show.map.pvs_from_m) {
    throw Error(ErrorCode::kUsage, "--show colours the faces by bsp-depth or by pvs-from, not by both");
  }
  if (values.empty()) {
    for (std::size_t i = 0; i < sim::picture_layer_names().size(); ++i) {
      show.run.push_back(static_cast<sim::PictureLayer>(i));
    }
  }
  return show;
}

std::string run_layer_names() {
  return fmt::format("{}", fmt::join(sim::picture_layer_names(), ", "));
}

std::string map_layer_names() {
  return fmt::format("{}=X,Y,Z", fmt::join(map_layers(), ", "));
}

}  // namespace hallway::cli
