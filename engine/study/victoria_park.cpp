// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/rigid_fit.hpp"
#include "study/parts.hpp"

namespace hallway::study {
namespace {

/// The scans in which the thesis sees four trees or more (6.8), and what figures it shows of them.
struct ThesisInterval {
  ParkInterval scans{};
  const char* figures;
};
constexpr ThesisInterval kIntervals[] = {{{1181, 1641}, "163, 164"}, {{4220, 4633}, "165, 166"}};

std::string name_of(const ParkInterval& scans) {
  return fmt::format("{}-{}", scans.first, scans.last);
}

/// A recording is what it is: one seed.
std::vector<RunSpec> plan_victoria_park(const Request& request) {
  std::vector<RunSpec> specs;
  for (const ThesisInterval& interval : kIntervals) {
    ParkInterval scans = interval.scans;
    if (request.quick) scans.last = scans.first + 99;
    if (request.steps > 0) scans.last = std::min(scans.last, scans.first + request.steps - 1);
    for (const PluginChoice& plugin : request.plugins)
      specs.push_back({{{"scans", name_of(scans)}}, scans, plugin, 1, 50});
    if (request.quick) break;
  }
  return specs;
}

/// The map put over the satellite fixes: T_world_map by the best fit of the path.
Pose fit_to_fixes(const Trace& trace) {
  std::vector<Vec3> path, fixes;
  for (const TraceStep& step : trace.steps) {
    if (!step.truth || !step.estimate) continue;
    path.push_back(*step.estimate);
    fixes.emplace_back(step.truth->x(), step.truth->y(), 0.0);
  }
  return path.size() < 3 ? Pose() : rigid_fit(path, fixes).value_or(Pose());
}

Chart map_chart(const StudyRun& run, const std::string& figures, std::size_t number) {
  const Pose T_world_map = fit_to_fixes(run.trace);
  Series fixes{.name = "satellite fixes", .style = SeriesStyle::kMarks, .colour = {190, 186, 174}};
  Series path{.name = "path", .colour = series_colour(1)};
  Series trees{.name = "trees", .style = SeriesStyle::kMarks, .colour = series_colour(0)};
  for (const TraceStep& step : run.trace.steps) {
    if (step.truth) fixes.points.emplace_back(step.truth->head<2>());
    path.points.emplace_back(step.estimate ? Vec2((T_world_map * *step.estimate).head<2>())
                                           : Vec2::Constant(std::nan("")));
  }
  for (const log::MapLandmark& landmark : run.trace.map) {
    if (landmark.status == log::LandmarkStatus::kMapped)
      trees.points.emplace_back((T_world_map * Vec3(landmark.position_m.data())).head<2>());
  }
  return {
      .file = fmt::format("map_{}", number),
      .title = fmt::format("Victoria Park, scans {}: {}", run.spec.label("scans"), run.spec.plugin.label()),
      .figures = figures,
      .x = {"east, m"},
      .y = {"north, m"},
      .series = {fixes, path, trees},
      .equal_scales = true};
}

Outcome conclude_victoria_park(const std::vector<StudyRun>& runs, const Request&) {
  const std::vector<RunGroup> groups = group_runs(runs);
  Findings findings(false), times(true);
  Outcome outcome;
  for (const RunGroup& group : groups) {
    const StudyRun& run = *group.runs.front();
    const eval::Metrics& metrics = run.trace.metrics;
    const ThesisInterval& interval =
        run.spec.label("scans").starts_with("1181") ? kIntervals[0] : kIntervals[1];
    const auto count = [](std::uint64_t n) { return static_cast<double>(n); };
    const auto add = [&](const char* what, const std::optional<double>& value, const char* unit = "1") {
      findings.add(interval.figures, group.name, what, value, unit);
    };
    add("scans", count(metrics.iterations));
    if (metrics.lost_iterations) add("scans without a pose", count(*metrics.lost_iterations));
    add("scans with a pose, share", metrics.pose_coverage());
    add("diverged", count(metrics.verdict == eval::PathVerdict::kDiverged ? 1 : 0));
    add("lost", count(metrics.verdict == eval::PathVerdict::kLost ? 1 : 0));
    add("trees mapped", count(metrics.landmarks_mapped));
    add("path against satellite fixes, RMSE aligned", metrics.position_rmse_m.aligned, "m");
    outcome.charts.push_back(map_chart(run, interval.figures, outcome.charts.size() + 1));
  }
  add_times(groups, "6.8", times);
  outcome.tables = {findings.take(), times.take()};
  return outcome;
}

}  // namespace

const Study kVictoriaPark{.name = "victoria-park",
                          .figures = "163-166",
                          .about =
                              "Trees seen by a laser from a car: the two intervals of scans that the "
                              "thesis evaluates (6.8)",
                          .size = "461 and 414 scans",
                          .plan = plan_victoria_park,
                          .conclude = conclude_victoria_park};

}  // namespace hallway::study
