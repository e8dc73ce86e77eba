// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "run/map_view.hpp"
#include "sim/scenario.hpp"

namespace hallway::cli {

/// What `--show` asks for.
struct ShowList {
  std::vector<sim::PictureLayer> run{};  ///< layers of a run; all of them where nothing is asked for
  run::MapView map{};
};

/// Reads the values of `--show`: layers between commas, `pvs-from=X,Y,Z` among them. Throws Error{kUsage} for a name that there is not, with
/// the nearest one, and for two ways to colour the faces.
ShowList parse_show(const std::vector<std::string>& values);

/// The names for help texts, between commas.
std::string run_layer_names();
std::string map_layer_names();

}  // namespace hallway::cli
