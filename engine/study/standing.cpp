// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "study/parts.hpp"

namespace hallway::study {
namespace {

std::vector<RunSpec> plan_straight(const Request& request) {
  std::vector<RunSpec> specs;
  const Drive drive{.scenario = "straight_line", .steps = steps_of(request, {1000, 200})};
  add_drives(request, {}, drive, 25.0, std::max(drive.steps / 100, 1u), specs);
  return specs;
}

Outcome conclude_straight(const std::vector<StudyRun>& runs, const Request&) {
  const std::vector<RunGroup> groups = group_runs(runs);
  const std::size_t part = std::max<std::size_t>(runs.front().spec.iterations() / 100, 1);
  Findings findings(false), times(true);
  add_accuracy(groups, "150, 151", findings);
  add_times(groups, "150", times);
  return {.tables = {findings.take(), times.take()},
          .charts = {landmark_error_chart(groups, "Straight line: landmark error", "150"),
                     landmark_rmse_chart(groups, "Straight line: landmark RMSE, aligned", "150"),
                     position_error_chart(groups, "Straight line: position error", "151", part)}};
}

std::vector<RunSpec> plan_stationary(const Request& request) {
  std::vector<RunSpec> specs;
  const Drive drive{.scenario = "stationary", .steps = steps_of(request, {4000, 400})};
  add_drives(request, {}, drive, 25.0, std::max(drive.steps / 200, 1u), specs);
  return specs;
}

std::vector<Vec2> rmse_over_iterations(const Trace& trace) {
  std::vector<Vec2> points;
  for (const MapSample& sample : trace.samples) {
    if (sample.rmse_aligned_m) points.emplace_back(sample.iterations, *sample.rmse_aligned_m);
  }
  return points;
}

Outcome conclude_stationary(const std::vector<StudyRun>& runs, const Request&) {
  const std::vector<RunGroup> groups = group_runs(runs);
  Findings findings(false);
  add_accuracy(groups, "152", findings);
  Chart chart = landmark_rmse_chart(groups, "Standing still: landmark error", "152");
  chart.x.log = chart.y.log = true;
  for (const RunGroup& group : groups)
    add_exponent(group, "152", "exponent of landmark RMSE over iterations", rmse_over_iterations, findings);
  if (!chart.series.empty() && !chart.series.front().points.empty()) {
    Series ideal{
        .name = "1 / sqrt(iterations)", .style = SeriesStyle::kDashed, .colour = render::palette::kInk};
    const Vec2 first = chart.series.front().points.front();
    for (const Vec2& point : chart.series.front().points)
      ideal.points.emplace_back(point.x(), first.y() * std::sqrt(first.x() / point.x()));
    chart.series.push_back(std::move(ideal));
  }
  return {.tables = {findings.take()},
          .charts = {chart, landmark_error_chart(groups, "Standing still: landmark error", "152")}};
}

}  // namespace

const Study kStraight{.name = "straight",
                      .figures = "150, 151",
                      .about = "Along a straight line, where no turn favours one side of the view (6.7.2)",
                      .size = "1000 iterations",
                      .plan = plan_straight,
                      .conclude = conclude_straight};

const Study kStationary{.name = "stationary",
                        .figures = "152",
                        .about = "Standing still: how fast the noise averages out (6.7.2)",
                        .size = "4000 iterations",
                        .plan = plan_stationary,
                        .conclude = conclude_stationary};

}  // namespace hallway::study
