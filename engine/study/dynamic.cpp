// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

#include "batch/table.hpp"
#include "eval/metrics_json.hpp"
#include "study/parts.hpp"

namespace hallway::study {
namespace {

/// How landmarks move in a run.
struct Motion {
  const char* name;
  int percent;
  const char* motion;
};

constexpr Motion kMotions[] = {{"0 %", 0, "independent"},   {"10 %", 10, "independent"},
                               {"20 %", 20, "independent"}, {"30 %", 30, "independent"},
                               {"40 %", 40, "independent"}, {"40 % in 4 groups", 40, "group"}};

std::vector<RunSpec> plan_dynamic(const Request& request) {
  std::vector<RunSpec> specs;
  for (const Motion& motion : kMotions) {
    if (request.quick && motion.percent != 0 && motion.percent != 20) continue;
    Drive drive{.scenario = "figure_eight", .steps = steps_of(request, {kLoopSteps, 200})};
    drive.edits = {{"hw_landmark_cloud", "moving_share", fmt::format("{}", motion.percent / 100.0)},
                   {"hw_landmark_cloud", "motion", motion.motion},
                   {"hw_landmark_cloud", "groups", "4"}};
    add_drives(request, {{"moving", motion.name}}, drive, 100.0, std::max(drive.steps / 190, 1u), specs);
  }
  return specs;
}

/// A number of metrics.json.
std::optional<double> metric(const Trace& trace, const std::string& name) {
  return batch::number_of(eval::to_json(trace.metrics), name);
}

std::optional<double> final_rmse(const Trace& trace) {
  return trace.metrics.landmark_rmse_final_aligned_m;
}

/// The group of the same plugin in which nothing moves.
const RunGroup* standing_group(const std::vector<RunGroup>& groups, const RunGroup& like) {
  for (const RunGroup& group : groups) {
    const RunSpec& spec = group.runs.front()->spec;
    if (spec.label("moving") == kMotions[0].name &&
        spec.plugin.label() == like.runs.front()->spec.plugin.label())
      return &group;
  }
  return nullptr;
}

Outcome conclude_dynamic(const std::vector<StudyRun>& runs, const Request&) {
  const std::vector<RunGroup> groups = group_runs(runs);
  Findings findings(false), times(true);
  for (const RunGroup& group : groups) {
    const auto named = [&](const char* name) {
      return group_median(group, [name](const Trace& trace) { return metric(trace, name); });
    };
    findings.add("157-162", group.name, "moving landmarks that are marked", named("moving.recall"), "1");
    findings.add("157-162", group.name, "marked landmarks that move", named("moving.precision"), "1");
    const RunGroup* standing = standing_group(groups, group);
    if (standing == nullptr || standing == &group) continue;
    const auto with = group_median(group, final_rmse), without = group_median(*standing, final_rmse);
    if (with && without && *without > 0.0)
      findings.add("159, 161", group.name, "landmark RMSE over that where nothing moves", *with / *without,
                   "1");
  }
  add_accuracy(groups, "157-162", findings);
  add_times(groups, "117", times);
  Chart error = landmark_rmse_chart(groups, "Moving landmarks: RMSE of those that stand, aligned", "157-162");
  error.y.log = true;
  return {.tables = {findings.take(), times.take()},
          .charts = {error,
                     landmark_error_chart(groups, "Moving landmarks: error of those that stand", "157-162")}};
}

}  // namespace

const Study kDynamic{.name = "dynamic",
                     .figures = "117, 157-162",
                     .about =
                         "The figure eight where 10 to 40 % of the landmarks move, each for itself or in "
                         "groups: whether they are told from those that stand (6.5.3, 6.7.3)",
                     .size = "6 kinds of motion, 3800 iterations each",
                     .plan = plan_dynamic,
                     .conclude = conclude_dynamic};

}  // namespace hallway::study
