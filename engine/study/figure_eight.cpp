// SPDX-License-Identifier: MIT
#include <cmath>

#include "study/parts.hpp"

namespace hallway::study {
namespace {

std::vector<RunSpec> plan_figure_eight(const Request& request) {
  std::vector<RunSpec> specs;
  const Drive drive{.scenario = "figure_eight", .steps = steps_of(request, {kLoopSteps, 300})};
  add_drives(request, {{"density", "25"}}, drive, 25.0, std::max(drive.steps / 190, 1u), specs);
  return specs;
}

/// x, y and z of something, each a line.
std::vector<Series> axes_series(const RunGroup& group, std::size_t part,
                                const std::function<std::optional<Vec3>(const PartMeans&)>& vector) {
  std::vector<Series> all;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<Series> one =
        part_series({group}, part, 0, [&](const PartMeans& means) -> std::optional<double> {
          const auto value = vector(means);
          return value ? std::optional<double>((*value)[axis]) : std::nullopt;
        });
    one.front().name = std::string(1, "xyz"[axis]);
    one.front().colour = series_colour(static_cast<std::size_t>(axis));
    all.push_back(std::move(one.front()));
  }
  return all;
}

/// Axes are ours: x and y level, z up. The thesis has y up.
void add_axis_charts(const RunGroup& group, std::size_t part, std::vector<Chart>& charts) {
  charts.push_back({.file = "axis_error",
                    .title = "Figure eight: position error by axis, " + group.name,
                    .figures = "130, 132, 134",
                    .x = {"iteration"},
                    .y = {"position error, m, from the first pose"},
                    .series = axes_series(group, part, [](const PartMeans& means) -> std::optional<Vec3> {
                      if (!means.error) return std::nullopt;
                      return means.error->signed_mean;
                    })});
  charts.push_back({.file = "location",
                    .title = "Figure eight: where the robot is",
                    .figures = "131, 133, 135",
                    .x = {"iteration"},
                    .y = {"true position, m"},
                    .series = axes_series(group, part, [](const PartMeans& means) { return means.truth; })});
}

Outcome conclude_figure_eight(const std::vector<StudyRun>& runs, const Request&) {
  const std::vector<RunGroup> groups = group_runs(runs);
  const std::size_t part = std::max<std::size_t>(runs.front().spec.iterations() / 190, 1);
  Findings findings(false), times(true);
  add_accuracy(groups, "146, 147", findings);
  add_times(groups, "148", times);
  Outcome outcome{.tables = {findings.take(), times.take()}};
  outcome.charts.push_back(landmark_error_chart(groups, "Figure eight: landmark error", "146"));
  outcome.charts.push_back(landmark_rmse_chart(groups, "Figure eight: landmark RMSE, aligned", "146"));
  outcome.charts.push_back(position_error_chart(groups, "Figure eight: position error", "147", part));
  outcome.charts.push_back(
      {.file = "run_time",
       .title = "Figure eight: time of an iteration",
       .figures = "148",
       .x = {"iteration"},
       .y = {"CPU time of the plugin, ms", true},
       .series = part_series(groups, part, 0,
                             [](const PartMeans& means) { return std::optional<double>(means.cpu_ms); }),
       .clock = true});
  outcome.charts.push_back({.file = "point_count",
                            .title = "Figure eight: landmarks in the map",
                            .figures = "149",
                            .x = {"iteration"},
                            .y = {"landmarks mapped"},
                            .series = sample_series(groups, [](const MapSample& sample) {
                              return std::optional<double>(static_cast<double>(sample.mapped));
                            })});
  add_axis_charts(groups.front(), part, outcome.charts);
  return outcome;
}

}  // namespace

const Study kFigureEight{.name = "figure-eight",
                         .figures = "130-135, 146-149",
                         .about =
                             "Once round the figure eight among 25 landmarks per 100 m: errors, time and "
                             "size of the map as it goes on (6.6.1, 6.7.1)",
                         .size = "3800 iterations",
                         .plan = plan_figure_eight,
                         .conclude = conclude_figure_eight};

}  // namespace hallway::study
