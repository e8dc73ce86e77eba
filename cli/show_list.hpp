// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "run/pictures/map_things.hpp"
#include "run/pictures/map_view.hpp"
#include "sim/scenario.hpp"

namespace hallway::cli {

/// What `--show` and `--hide` ask for.
struct ShowList {
  std::vector<sim::PictureLayer> run{};  ///< layers of a run
  run::MapView map{};
  run::MapThings things{};
  std::string thing{};  ///< the first layer of a map alone that `--show` names; empty where it names none
};

/// Reads the values of `--hide` and then of `--show`: layers between commas, `pvs-from=X,Y,Z` among those to show, `all` among those to hide. What
/// neither names is as it is by default: everything that a person can read. Throws Error{kUsage} for a name that there is not, with the
/// nearest one, and for two ways to colour the faces.
ShowList parse_show(const std::vector<std::string>& show, const std::vector<std::string>& hide);

/// The names for help texts, between commas.
std::string run_layer_names();
std::string map_layer_names();
std::string thing_layer_names();

}  // namespace hallway::cli
