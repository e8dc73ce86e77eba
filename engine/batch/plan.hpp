// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hallway::batch {

/// What tells a run from the others of its batch: "seed" = "2", "slam_point.noise_m" = "0.02".
struct Label {
  std::string name{};
  std::string value{};
  friend bool operator==(const Label&, const Label&) = default;
};

/// One run of a batch.
struct Cell {
  std::string name{};                    ///< of its folder; letters, digits and . _ = + - only; distinct
  std::vector<Label> labels{};           ///< in the order of the plan's dimensions
  std::vector<std::string> arguments{};  ///< of `hallway`, without those that say where to write
  std::vector<std::filesystem::path> inputs{};  ///< files whose content decides what comes out
};

/// A picture of every run.
struct PictureRequest {
  std::string name{};                    ///< stands behind the cell's in the file's name
  std::vector<std::string> arguments{};  ///< of `hallway render`
};

/// What a number of metrics.json has to be.
struct Threshold {
  std::string metric{};  ///< with points between the levels: "landmark_rmse_m.aligned"
  std::optional<double> least{};
  std::optional<double> most{};
};

/// What a batch runs: every combination of its scenarios and logs, seeds, settings, plugins and their parameters.
struct Plan {
  std::vector<Cell> cells{};
  std::vector<PictureRequest> pictures{};
  std::vector<Threshold> thresholds{};
  std::string verdict{};  ///< that the path of every run has to have; empty for any
};

/// A plugin of a plan and the values of its parameters that are tried, each with each.
struct PluginSweep {
  std::string plugin{};  ///< id or file
  struct Values {
    std::string name{};
    std::vector<std::string> values{};
  };
  std::vector<Values> parameters{};
};

/// The dimensions of a plan. Empty ones have one value: what the scenario says.
struct Dimensions {
  std::vector<std::filesystem::path> inputs{};  ///< scenarios, logs and folders of runs
  std::vector<std::string> seeds{};
  std::vector<PluginSweep::Values> settings{};  ///< of scenarios, by key
  std::vector<PluginSweep> plugins{};
  std::vector<std::string> more{};  ///< arguments of every run, such as "--steps", "100"
};

/// All combinations, the first dimension outermost. Throws Error{kBadInput} for more than kMostCells.
std::vector<Cell> combine(const Dimensions& dimensions);
inline constexpr std::size_t kMostCells = 100'000;

/// Reads a plan (docs/formats.md, "Batches"). Files in it are seen from its folder. Throws Error{kBadInput, kIo} with file, line and cause.
Plan read_plan(const std::filesystem::path& file);

}  // namespace hallway::batch
