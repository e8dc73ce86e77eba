// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/parts.hpp"
#include "study/statistics.hpp"

namespace hallway::study {
namespace {

std::vector<RunSpec> plan_density(const Request& request) {
  std::vector<RunSpec> specs;
  const std::vector<int> densities =
      request.quick ? std::vector<int>{50, 100, 200}
                    : std::vector<int>{25, 50, 100, 150, 200, 250, 300, 350, 400, 450, 500, 550};
  const Drive drive{.scenario = "figure_eight", .steps = steps_of(request, {kLoopSteps, 200})};
  for (const int density : densities)
    add_drives(request, {{"density", fmt::to_string(density)}}, drive, density, drive.steps, specs);
  return specs;
}

/// What the runs of one plugin at one density have in common.
struct DensityPoint {
  std::string plugin{};
  Vec2 time{};  ///< mean visible points, mean ms; medians over the seeds
  std::vector<std::pair<std::string, double>> stages{};  ///< counters in us, in ms
};

std::optional<double> mean_visible(const Trace& trace) {
  return part_means(trace, 0, trace.steps.size()).visible;
}

std::optional<double> mean_time(const Trace& trace) {
  return part_means(trace, 0, trace.steps.size()).cpu_ms;
}

/// Counters that end in `_us` are taken for the time of a stage.
std::vector<std::pair<std::string, double>> stages_of(const RunGroup& group) {
  std::vector<std::pair<std::string, double>> stages;
  for (const CounterMean& counter : group.runs.front()->trace.counters) {
    if (!counter.name.ends_with("_us")) continue;
    const auto value = group_median(group, [&](const Trace& trace) -> std::optional<double> {
      for (const CounterMean& one : trace.counters) {
        if (one.name == counter.name) return one.mean / 1000.0;
      }
      return std::nullopt;
    });
    stages.emplace_back(counter.name.substr(0, counter.name.size() - 3), value.value_or(0.0));
  }
  return stages;
}

std::vector<DensityPoint> density_points(const std::vector<RunGroup>& groups) {
  std::vector<DensityPoint> points;
  for (const RunGroup& group : groups) {
    points.push_back({.plugin = group.runs.front()->spec.plugin.label(),
                      .time = {group_median(group, mean_visible).value_or(0.0),
                               group_median(group, mean_time).value_or(0.0)},
                      .stages = stages_of(group)});
  }
  return points;
}

/// n and n log n through the first point of a line.
void add_references(const std::vector<Vec2>& line, std::vector<Series>& series) {
  if (line.size() < 2 || !(line.front().x() > 1.0)) return;
  const Vec2 first = line.front();
  Series linear{.name = "n", .style = SeriesStyle::kDashed, .colour = render::palette::kMutedInk};
  Series log_linear{.name = "n log n", .style = SeriesStyle::kDashed, .colour = render::palette::kInk};
  for (const Vec2& point : line) {
    const double share = point.x() / first.x();
    linear.points.emplace_back(point.x(), first.y() * share);
    log_linear.points.emplace_back(point.x(), first.y() * share * std::log(point.x()) / std::log(first.x()));
  }
  series.push_back(std::move(linear));
  series.push_back(std::move(log_linear));
}

Chart stages_chart(const std::vector<DensityPoint>& points, const std::string& plugin) {
  Chart chart{.file = "stages",
              .title = "Density: time by stage, " + plugin,
              .figures = "138-143",
              .x = {"visible points, mean"},
              .y = {"CPU time of a stage, ms, mean"},
              .clock = true};
  for (const DensityPoint& point : points) {
    if (point.plugin != plugin) continue;
    for (std::size_t i = 0; i < point.stages.size(); ++i) {
      if (i == chart.series.size())
        chart.series.push_back({.name = point.stages[i].first, .colour = series_colour(i)});
      chart.series[i].points.emplace_back(point.time.x(), point.stages[i].second);
    }
  }
  return chart;
}

Outcome conclude_density(const std::vector<StudyRun>& runs, const Request& request) {
  const std::vector<RunGroup> groups = group_runs(runs);
  const std::vector<DensityPoint> points = density_points(groups);
  Findings findings(false), times(true);
  add_accuracy(groups, "137", findings);
  Chart time{.file = "density",
             .title = "Density: time of an iteration over visible points",
             .figures = "137, 144, 145",
             .x = {"visible points, mean"},
             .y = {"CPU time of the plugin, ms, mean"},
             .clock = true};
  Chart log_time = time;
  log_time.file = "density_log";
  log_time.x.log = log_time.y.log = true;
  for (std::size_t i = 0; i < request.plugins.size(); ++i) {
    const std::string plugin = request.plugins[i].label();
    Series line{.name = plugin, .colour = series_colour(i)};
    for (const DensityPoint& point : points) {
      if (point.plugin == plugin) line.points.push_back(point.time);
    }
    if (const auto fit = fit_power(line.points)) {
      times.add("137, 145", plugin, "exponent of time over visible points", fit->slope,
                fit->slope - fit->slope_half_width, fit->slope + fit->slope_half_width, "1");
    }
    if (i == 0) add_references(line.points, time.series);
    time.series.push_back(line);
    log_time.series.push_back(std::move(line));
  }
  if (!log_time.series.empty()) add_references(log_time.series.front().points, log_time.series);
  add_times(groups, "137", times);
  Outcome outcome{.tables = {findings.take(), times.take()}, .charts = {time, log_time}};
  for (const PluginChoice& plugin : request.plugins) {
    Chart stages = stages_chart(points, plugin.label());
    if (stages.series.empty()) continue;
    if (outcome.charts.size() > 2) stages.file += fmt::format("_{}", outcome.charts.size() - 1);
    outcome.charts.push_back(std::move(stages));
  }
  return outcome;
}

}  // namespace

const Study kDensity{.name = "density",
                     .figures = "137-145",
                     .about =
                         "The figure eight among 25 to 550 landmarks per 100 m: how the time of an "
                         "iteration grows with the points in view (6.6.2)",
                     .size = "12 densities of 3800 iterations",
                     .plan = plan_density,
                     .conclude = conclude_density};

}  // namespace hallway::study
