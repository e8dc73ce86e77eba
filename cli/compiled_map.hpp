// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "map/document.hpp"
#include "pvs/compute.hpp"
#include "render/picture.hpp"
#include "world/compiled_world.hpp"

namespace hallway::cli {

/// How a command wants its map.
struct MapRequest {
  std::string file{};
  std::optional<pvs::Level> level{};  ///< empty: no visible sets
  unsigned threads = 1;
  bool use_cache = true;  ///< `.hallway` beside the map; only where there are visible sets to keep
  bool strict = false;    ///< the first warning is an error
};

/// A map that is ready for questions.
struct CompiledMap {
  map::Document document;
  world::CompiledWorld world;
  std::vector<std::string> warnings;  ///< shown on standard error already
};

/// Reads a map. Throws Error{kBadInput} for a file that holds none.
map::Document load_map(const std::string& file);

/// Reads and compiles a map, with a progress bar while the visible sets are made, and prints what the user should know: brushes that are
/// no solids, occupants in solid, a cache that cannot be written. Ctrl-C is Error{kInterrupted}.
CompiledMap compile_map(const MapRequest& request);

/// The models that stand in a map, as faces of a picture. One that cannot be read is left out with a warning, shown on standard error and
/// added to the map's, or with `strict` thrown.
std::vector<render::Surface> model_faces(CompiledMap& compiled, bool strict);
/// The folder that the names of a map's models count from.
std::filesystem::path models_folder(const CompiledMap& compiled);
/// Warns of models that were left out, as model_faces() does.
void warn_of_models(CompiledMap& compiled, const std::vector<Error>& faults, bool strict);

/// What --level names.
pvs::Level level_named(const std::string& name);

/// A place or direction in a document.
nlohmann::ordered_json place_json(const Vec3& place);

/// `X,Y,Z` in metres. Throws Error{kUsage} naming `what` for anything else.
Vec3 parse_place(const std::string& what, const std::string& text);

}  // namespace hallway::cli
