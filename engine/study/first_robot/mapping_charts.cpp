// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "study/first_robot/mapping.hpp"
#include "study/statistics.hpp"

namespace hallway::study {
namespace {

using RunNumber = std::optional<double> MappingRun::*;

std::vector<std::string> maps_of(const std::vector<MappingGroup>& groups) {
  std::vector<std::string> maps;
  for (const MappingGroup& group : groups) {
    if (std::find(maps.begin(), maps.end(), group.map) == maps.end()) maps.push_back(group.map);
  }
  return maps;
}

/// Adds a mark and its interval for each map.
void add_rates(const std::vector<MappingGroup>& groups, bool faults, bool (MappingRun::*is_so)() const,
               const std::string& name, Chart& chart) {
  const render::Rgb colour = series_colour(chart.series.size() / 2);
  const double aside = 0.08 * (static_cast<double>(chart.series.size()) / 2.0 - 1.5);
  Series marks{.name = name, .style = SeriesStyle::kMarks, .colour = colour};
  Series intervals{.colour = colour};
  for (const MappingGroup& group : groups) {
    if (group.faults != faults) continue;
    const auto at = std::find(chart.x.names.begin(), chart.x.names.end(), group.map);
    const double x = static_cast<double>(at - chart.x.names.begin()) + aside;
    std::uint64_t count = 0;
    for (const MappingRun* run : group.runs) count += (run->*is_so)() ? 1u : 0u;
    const auto share = share_interval(count, group.counted());
    if (!share) continue;
    marks.points.emplace_back(x, share->value);
    for (const Vec2& point : {Vec2(x, share->low), Vec2(x, share->high), Vec2(std::nan(""), std::nan(""))})
      intervals.points.push_back(point);
  }
  chart.series.push_back(std::move(marks));
  chart.series.push_back(std::move(intervals));
}

Chart rates_chart(const std::vector<MappingGroup>& groups) {
  Chart chart{.file = "rates",
              .title = "First robot: how often a loop is closed, with intervals of 95 %",
              .figures = "26-28",
              .x = {.names = maps_of(groups)},
              .y = {.label = "share of runs"}};
  add_rates(groups, false, &MappingRun::is_right, "rightly, no faults", chart);
  add_rates(groups, true, &MappingRun::is_right, "rightly, faults", chart);
  add_rates(groups, false, &MappingRun::is_wrong, "wrongly, no faults", chart);
  add_rates(groups, true, &MappingRun::is_wrong, "wrongly, faults", chart);
  return chart;
}

/// How many runs are in each part, as the outline of bars; one line without faults and one with.
Chart histogram(std::span<const MappingRun> runs, RunNumber number, double part, Chart chart) {
  double most = 0.0;
  for (const MappingRun& run : runs) most = std::max(most, (run.*number).value_or(0.0));
  for (const bool faults : {false, true}) {
    std::vector<double> counts(static_cast<std::size_t>(most / part) + 1);
    for (const MappingRun& run : runs) {
      if (run.faults == faults && run.*number) counts[static_cast<std::size_t>(*(run.*number) / part)] += 1.0;
    }
    // Dashed over whole lines: both are seen where they are the same.
    Series series{.name = faults ? "faults" : "no faults",
                  .style = faults ? SeriesStyle::kDashed : SeriesStyle::kLine,
                  .colour = series_colour(faults ? 1 : 0)};
    series.points.emplace_back(0.0, 0.0);
    for (std::size_t i = 0; i < counts.size(); ++i) {
      series.points.emplace_back(part * static_cast<double>(i), counts[i]);
      series.points.emplace_back(part * static_cast<double>(i + 1), counts[i]);
    }
    series.points.emplace_back(part * static_cast<double>(counts.size()), 0.0);
    chart.series.push_back(std::move(series));
  }
  return chart;
}

}  // namespace

std::vector<Chart> mapping_charts(std::span<const MappingRun> runs) {
  return {rates_chart(group_mapping_runs(runs)),
          histogram(runs, &MappingRun::distance_m, 10.0,
                    {.file = "distances",
                     .title = "First robot: distance driven in a run",
                     .x = {.label = "distance, m"},
                     .y = {.label = "number of runs, for each 10 m", .counts = true}}),
          histogram(runs, &MappingRun::time_s, 30.0,
                    {.file = "times_to_stand",
                     .title = "First robot: time until it stays where it is",
                     .x = {.label = "time in the simulation, s"},
                     .y = {.label = "number of runs, for each 30 s", .counts = true}})};
}

}  // namespace hallway::study
