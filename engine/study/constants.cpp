// SPDX-License-Identifier: MIT
#include <algorithm>

#include "study/parts.hpp"

namespace hallway::study {
namespace {

/// A setting of the constants of group creation that the thesis tries (6.5.4, 6.5.5), by the names of slam_point's parameters.
struct ConstantSetting {
  const char* name;
  std::vector<std::pair<std::string, std::string>> parameters;
};

/// Each differs from the first in what its name says. The thesis's fewest previous points, 20, need a density of 100.
const std::vector<ConstantSetting>& constant_settings() {
  static const std::vector<ConstantSetting> kSettings{
      {"baseline", {}},
      {"all-point basis", {{"thesis_basis", "all"}}},
      {"accuracy reduction 1", {{"thesis_accuracy_reduction", "1"}}},
      {"look back 90", {{"thesis_look_back", "90"}}},
      {"look back 90, accuracy reduction 20",
       {{"thesis_look_back", "90"}, {"thesis_accuracy_reduction", "20"}}},
      {"next group minimum 5", {{"thesis_next_min", "5"}}},
      {"previous group maximum 50", {{"thesis_previous_max", "50"}}},
      {"without constants", {{"thesis_levels", "3"}}},
  };
  return kSettings;
}

/// `base` with `mode=thesis` and these parameters; what `base` says itself stands.
PluginChoice with(PluginChoice base, const ConstantSetting& setting) {
  const auto add = [&](const std::string& name, const std::string& value) {
    const bool said = std::any_of(base.parameters.begin(), base.parameters.end(),
                                  [&](const auto& one) { return one.first == name; });
    if (!said) base.parameters.emplace_back(name, value);
  };
  add("mode", "thesis");
  for (const auto& [name, value] : setting.parameters) add(name, value);
  return base;
}

/// Of each seed all settings, so that they share the ground.
std::vector<RunSpec> plan_constants(const Request& request) {
  std::vector<RunSpec> specs;
  const std::uint32_t steps = steps_of(request, {2 * kLoopSteps, 300});
  const Drive drive{.scenario = "figure_eight", .steps = steps};
  for (std::uint64_t seed = 1; seed <= request.seeds; ++seed) {
    Drive seeded = drive;
    seeded.seed = seed;
    seeded.edits = cloud_of(100.0, seed);
    for (const PluginChoice& plugin : request.plugins) {
      for (const ConstantSetting& setting : constant_settings())
        specs.push_back(
            {{{"setting", setting.name}}, seeded, with(plugin, setting), seed, std::max(steps / 100, 1u)});
    }
  }
  return specs;
}

Outcome conclude_constants(const std::vector<StudyRun>& runs, const Request&) {
  std::vector<RunGroup> groups = group_runs(runs);
  for (RunGroup& group : groups) group.name = group.runs.front()->spec.label("setting");
  Findings findings(false), times(true);
  add_accuracy(groups, "119-126", findings);
  for (const RunGroup& group : groups) {
    findings.add("121, 123", group.name, "groups at the end",
                 group_median(group,
                              [](const Trace& trace) -> std::optional<double> {
                                for (const CounterMean& counter : trace.counters) {
                                  if (counter.name == "submaps") return counter.last;
                                }
                                return std::nullopt;
                              }),
                 "1");
  }
  add_times(groups, "119-126", times);
  return {.tables = {findings.take(), times.take()},
          .charts = {landmark_error_chart(groups, "Constants of group creation: landmark error",
                                          "119, 120, 122, 124-126"),
                     landmark_rmse_chart(groups, "Constants of group creation: landmark RMSE, aligned",
                                         "119, 120, 122, 124-126")}};
}

}  // namespace

const Study kConstants{.name = "constants",
                       .figures = "119-126",
                       .about =
                           "The figure eight with other constants of group creation, for slam_point "
                           "with mode=thesis (6.5.4, 6.5.5)",
                       .size = "8 settings of 7600 iterations",
                       .plan = plan_constants,
                       .conclude = conclude_constants};

}  // namespace hallway::study
