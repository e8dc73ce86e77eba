// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bsp/compile.hpp"
#include "map/document.hpp"
#include "map/occupants.hpp"
#include "map/world.hpp"
#include "pvs/compute.hpp"
#include "pvs/visible_sets.hpp"

namespace hallway::world {

/// What a stage of a compilation took.
struct Stage {
  std::string name;  ///< "brushes", "partition", "visibility", "cache"
  double seconds = 0.0;
};

/// A map made ready for simulation and questions.
struct CompiledWorld {
  map::World brushes;
  std::vector<map::Occupant> occupants;
  bsp::Compiled partition;
  std::optional<pvs::VisibleSets> visible;  ///< of a sealed world, where it was asked for
  pvs::Level level =
      pvs::Level::kFull;      ///< of `visible`; kFast as well where there are too many portals for kFull
  std::vector<Stage> stages;  ///< in their order
  bool from_cache = false;    ///< partition and visible were read, not computed
  std::string cache_note;  ///< why the cache could not be written; empty where it was, or was not asked for

  bool sealed() const { return partition.enclosure.sealed; }
};

/// Settings of compile().
struct Settings {
  bsp::CompileOptions partition{};
  std::optional<pvs::Level> level = pvs::Level::kFull;  ///< empty: no visibility
  unsigned threads = 1;                                 ///< at least 1; no matter to the result
  /// Folder of the cache, empty for none. A kFull result in it also serves who asks for kFast.
  std::filesystem::path cache{};
  bool write_cache = true;  ///< false: what is in the folder is used, nothing is added
  /// Of the visibility stage; see pvs::Options::progress.
  std::function<void(std::size_t done, std::size_t total)> progress{};
};

/// The folder in which what is derived from a map is cached: `.hallway` beside it.
std::filesystem::path cache_folder(const std::filesystem::path& map_file);

/// Runs the stages: brushes, partition (boundary, tree, leaks, portals), visibility. A leak is no error: sealed() says so, and there is no visibility
/// then. Throws Error{kBadInput} for a bad `_scale` or a bad entity; a brush that is no body is in `brushes.problems`.
///
/// What is cached is found by the content of the map and the settings, and is checked when it is read: a damaged file is computed anew.
CompiledWorld compile(const map::Document& document, const Settings& settings);

}  // namespace hallway::world
