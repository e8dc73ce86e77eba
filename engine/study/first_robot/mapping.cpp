// SPDX-License-Identifier: MIT
#include "study/first_robot/mapping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "batch/content.hpp"
#include "batch/table.hpp"
#include "study/first_robot/office_files.hpp"

namespace hallway::study {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 3> kNamedMaps{"cubicles", "cubicles_changed", "two_loops"};
constexpr double kStandsAfter_s = 10.0;

struct MappingCell {
  std::string map{};
  std::string office{};  ///< seed, or empty
  bool faults = false;
  std::uint64_t seed = 0;
  fs::path scenario{};
};

batch::Cell cell_of(const MappingCell& from, const std::vector<std::string>& arguments) {
  const char* faults = from.faults ? "yes" : "no";
  batch::Cell cell{
      .name = fmt::format("{}{}{}-seed_{}", from.map, from.office.empty() ? "" : "_" + from.office,
                          from.faults ? "-faults" : "", from.seed),
      .labels = {{"map", from.map},
                 {"office", from.office},
                 {"faults", faults},
                 {"seed", fmt::to_string(from.seed)}},
      .arguments = {"run", from.scenario.string(), "--seed", fmt::to_string(from.seed)},
      .inputs = {from.scenario}};
  cell.arguments.insert(cell.arguments.end(), arguments.begin(), arguments.end());
  return cell;
}

const std::string& label_of(const batch::Result& result, const std::string& name) {
  for (const batch::Label& label : result.labels) {
    if (label.name == name) return label.value;
  }
  throw Error(ErrorCode::kInternal, "a run has no label " + name);
}

std::uint64_t number_in(const std::string& text) {
  std::uint64_t number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

void read_topology(const Json& metrics, MappingRun& run) {
  if (!metrics.contains("topology") || !metrics["topology"].is_object()) return;
  const Json& topology = metrics["topology"];
  if (topology.contains("loop") && topology["loop"].is_string())
    run.loop = topology["loop"].get<std::string>();
  run.nodes = batch::number_of(topology, "nodes.demanded");
  run.nodes_found = batch::number_of(topology, "nodes.found");
  run.nodes_missed = batch::number_of(topology, "nodes.missed");
  run.nodes_false = batch::number_of(topology, "nodes.false");
  run.openings = batch::number_of(topology, "openings.demanded");
  run.openings_right = batch::number_of(topology, "openings.right_kind");
  run.edge_rmse_m = batch::number_of(topology, "edges.length_m.rmse");
}

}  // namespace

Study first_robot_study() {
  return {
      .name = "first-robot",
      .figures = "26-28",
      .about =
          "The first robot maps offices: how often it closes the loop rightly, and make such offices (2.2.5)",
      .size = "20 seeds on three maps and 100 generated offices, with faults and without"};
}

std::span<const char* const> named_maps() {
  return kNamedMaps;
}

batch::Plan plan_mapping(const MappingRequest& request) {
  batch::Plan plan;
  for (const char* map : kNamedMaps) {
    for (const bool faults : {false, true}) {
      const fs::path scenario = request.maps / (std::string(map) + (faults ? "_faults.toml" : ".toml"));
      if (request.seeds > 0) read_file(scenario);  // else every run of it would fail
      for (std::uint64_t i = 0; i < request.seeds; ++i)
        plan.cells.push_back(cell_of({map, "", faults, request.first_seed + i, scenario}, request.arguments));
    }
  }
  const fs::path robot = request.maps / "robots/first.map";
  if (request.offices > 0) {
    read_file(robot);
    make_folder(request.out / "offices");
  }
  std::vector<batch::Cell> with_faults;
  for (std::uint64_t i = 0; i < request.offices; ++i) {
    const std::uint64_t seed = request.first_seed + i;
    const auto files =
        write_office(seed, request.out / "offices" / fmt::format("office_{}.map", seed), robot);
    const MappingCell cell{kGeneratedOffices, fmt::to_string(seed), false, seed, files[1]};
    plan.cells.push_back(cell_of(cell, request.arguments));
    with_faults.push_back(cell_of({cell.map, cell.office, true, seed, files[2]}, request.arguments));
  }
  plan.cells.insert(plan.cells.end(), with_faults.begin(), with_faults.end());
  if (!request.by_cost) return plan;
  std::vector<std::string> arguments = request.arguments;
  arguments.insert(arguments.end(), {"--set", "wall_follower.exploration=2"});
  for (const char* map : kNamedMaps) {
    for (const bool faults : {false, true}) {
      const fs::path scenario = request.maps / (std::string(map) + (faults ? "_faults.toml" : ".toml"));
      for (std::uint64_t i = 0; i < request.seeds; ++i)
        plan.cells.push_back(
            cell_of({std::string(map) + kByCost, "", faults, request.first_seed + i, scenario}, arguments));
    }
  }
  return plan;
}

std::optional<double> time_until_it_stands_s(const fs::path& commands, double period_s) {
  const std::string text = read_file(commands);
  int line_number = 0;
  std::uint64_t last = 0, moved = 0;
  bool ever = false;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = std::string_view(text).substr(begin, end - begin);
    begin = end + 1;
    if (++line_number == 1 || line.empty()) continue;  // the head
    const std::size_t comma = line.find(',');
    std::uint64_t iteration = 0;
    const auto [at, error] =
        std::from_chars(line.data(), line.data() + std::min(comma, line.size()), iteration);
    if (comma == std::string_view::npos || error != std::errc() || at != line.data() + comma)
      throw Error(ErrorCode::kBadInput, "no iteration and command", {commands.string(), line_number, {}});
    last = iteration;
    if (line.substr(comma).find_first_of("123456789") == std::string_view::npos) continue;  // all zero
    moved = iteration;
    ever = true;
  }
  if (!ever || static_cast<double>(last - moved) * period_s < kStandsAfter_s) return std::nullopt;
  return static_cast<double>(moved + 1) * period_s;
}

MappingRun read_mapping_run(const batch::Result& result, const fs::path& folder) {
  MappingRun run{.map = label_of(result, "map"),
                 .faults = label_of(result, "faults") == "yes",
                 .seed = number_in(label_of(result, "seed")),
                 .problem = result.problem};
  if (const std::string& office = label_of(result, "office"); !office.empty()) run.office = number_in(office);
  if (!result.good()) {
    run.loop = "failed";
    if (run.problem.empty()) run.problem = fmt::format("status {}", result.status);
    return run;
  }
  read_topology(result.metrics, run);
  run.distance_m = batch::number_of(result.metrics, "drive.distance_m");
  const Json manifest = batch::json_file(folder / "run.json");
  if (const auto period_ns = batch::number_of(manifest, "period_ns"))
    run.time_s = time_until_it_stands_s(folder / "commands.csv", *period_ns * 1e-9);
  return run;
}

std::vector<MappingGroup> group_mapping_runs(std::span<const MappingRun> runs) {
  std::vector<MappingGroup> groups;
  for (const MappingRun& run : runs) {
    const auto same = [&](const MappingGroup& group) {
      return group.map == run.map && group.faults == run.faults;
    };
    auto group = std::find_if(groups.begin(), groups.end(), same);
    if (group == groups.end()) group = groups.insert(group, {.map = run.map, .faults = run.faults});
    group->runs.push_back(&run);
  }
  return groups;
}

}  // namespace hallway::study
