// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "batch/plan.hpp"
#include "batch/runner.hpp"
#include "study/study.hpp"

namespace hallway::study {

// `hallway study first-robot`: how often the first robot maps an office and closes the loop rightly, on what way and in what time (thesis 2.2.5). Each run is
// one of `hallway run`, in a process of its own.

/// What is asked for.
struct MappingRequest {
  std::uint32_t seeds = 20;              ///< runs on each named map, with faults and without each
  std::uint32_t offices = 100;           ///< generated offices; one run with faults and one without in each
  std::uint64_t first_seed = 1;          ///< of the runs, and of the offices
  std::filesystem::path maps{};          ///< with the named maps' scenarios and robots/first.map
  std::filesystem::path out{};           ///< generated offices are written into its folder `offices`
  std::vector<std::string> arguments{};  ///< of `hallway run` in every run
  bool by_cost =
      false;  ///< also runs on the named maps in which the plugin wall_follower explores by cost, as maps of their own
};

/// Name, figures and size, for write_outcome(). It has no plan of runs.
Study first_robot_study();

/// The maps of the thesis's experiments: names of scenarios without ending.
std::span<const char* const> named_maps();

/// What generated offices are named as a group.
inline constexpr const char* kGeneratedOffices = "offices";

/// What is behind the name of a map in which the robot explores by cost.
inline constexpr const char* kByCost = "_by_cost";

/// Writes the offices and makes the plan: the named maps first, in each the runs without faults before those with; those by cost last. Throws Error{kIo}.
batch::Plan plan_mapping(const MappingRequest& request);

/// What a run comes to.
struct MappingRun {
  std::string map{};  ///< a named map, with kByCost behind it or not, or kGeneratedOffices
  std::optional<std::uint64_t> office{};  ///< seed of a generated one
  bool faults = false;
  std::uint64_t seed = 0;
  std::string problem{};  ///< of a run that failed
  /// "rightly closed", "wrongly closed", "uncertain", "open", as metrics.json has it; "failed" of a run that failed; empty where nothing was charted or scored.
  std::string loop{};
  std::optional<double> nodes{}, nodes_found{}, nodes_missed{}, nodes_false{}, openings{}, openings_right{},
      edge_rmse_m{};
  std::optional<double> distance_m{};  ///< that it drove
  std::optional<double> time_s{};      ///< until it stayed where it is; empty where it did not

  /// Whether it counts in rates: its topology was scored, or it failed.
  bool is_counted() const { return !loop.empty(); }
  bool is_right() const { return loop == "rightly closed"; }
  bool is_wrong() const { return loop == "wrongly closed"; }
};

/// Reads what a run of plan_mapping() left. @param folder  of the run, with commands.csv and run.json
MappingRun read_mapping_run(const batch::Result& result, const std::filesystem::path& folder);

/// Seconds until the last command that moves the robot; empty where there is none, or where that is less than 10 s before the end: sweeps last less.
/// @param commands  commands.csv of a run  Throws Error{kBadInput, kIo} with file and line.
std::optional<double> time_until_it_stands_s(const std::filesystem::path& commands, double period_s);

/// Tables (`findings`, `rates`, `runs`) and charts.
Outcome conclude_mapping(std::span<const MappingRun> runs);

/// The charts alone: rates by map with their intervals, and how many runs drove how far and how long.
std::vector<Chart> mapping_charts(std::span<const MappingRun> runs);

/// Runs of one map, with faults or without.
struct MappingGroup {
  std::string map{};
  bool faults = false;
  std::vector<const MappingRun*> runs{};

  /// Runs that count in rates.
  std::uint64_t counted() const {
    std::uint64_t count = 0;
    for (const MappingRun* run : runs) count += run->is_counted() ? 1u : 0u;
    return count;
  }
  std::string name() const { return map + (faults ? ", faults" : ", no faults"); }
};
/// In the order of their first appearance.
std::vector<MappingGroup> group_mapping_runs(std::span<const MappingRun> runs);

}  // namespace hallway::study
