// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/setting.hpp"

namespace hallway::study {

/// A plugin with values for its parameters.
struct PluginChoice {
  std::string plugin{};  ///< id or file
  std::vector<std::pair<std::string, std::string>> parameters{};

  /// "slam_point:mode=thesis".
  std::string label() const;
};

/// A change of every entity of a class in a map.
struct MapEdit {
  std::string classname{};
  std::string key{};
  std::string value{};
};

/// A robot that is driven through a map.
struct Drive {
  std::string scenario{};            ///< name of a file in the folder of maps, without ending
  std::vector<MapEdit> edits{};      ///< of its map
  std::vector<Override> settings{};  ///< of the scenario
  std::uint64_t seed = 1;            ///< of the scenario's random numbers
  std::uint32_t steps = 1;
};

/// A part of the Victoria Park data set.
struct ParkInterval {
  std::uint32_t first = 0;  ///< scan
  std::uint32_t last = 0;   ///< scan, inclusive
};

using Input = std::variant<Drive, ParkInterval>;

/// What tells a run from others of its study: "density" = "25".
struct RunLabel {
  std::string name{};
  std::string value{};
};

/// A run of a study.
struct RunSpec {
  std::vector<RunLabel>
      labels{};  ///< without plugin and seed; the same names in the same order in all runs of a study
  Input input{};
  PluginChoice plugin{};
  std::uint64_t seed = 1;
  std::uint32_t sample_every = 100;  ///< iterations between two looks at the map

  /// The value of a label, or the empty text.
  std::string label(const std::string& name) const;
  /// All labels and the plugin, which runs of different seeds have in common.
  std::string group() const;
  std::uint32_t iterations() const;
};

/// What binning some points took.
struct BinCount {
  std::uint64_t comparisons = 0;  ///< pairs that were compared
  std::size_t largest = 0;        ///< points in the largest bin
};

/// Bins so many points by the standard deviations of their distances (thesis 6.5.3), with or without the heuristic that bins which joined
/// are compared first.
using BinPoints = std::function<BinCount(
    std::size_t points, bool priority, const std::function<double(std::uint32_t, std::uint32_t)>& deviation)>;

/// What a study is asked for.
struct Request {
  std::vector<PluginChoice> plugins{};
  std::uint32_t seeds = 5;
  bool quick = false;       ///< a size for trying out: seconds
  std::uint32_t steps = 0;  ///< of each run; 0: the study's own
  BinPoints bin_points{};   ///< what `binning` counts the comparisons of; unset: none
};

}  // namespace hallway::study
