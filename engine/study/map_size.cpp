// SPDX-License-Identifier: MIT
#include <algorithm>
#include <map>

#include "study/parts.hpp"
#include "study/statistics.hpp"

namespace hallway::study {
namespace {

/// Iterations at the beginning that do not count: there is no map yet (thesis 6.6.2).
constexpr std::size_t kWarmUp = 200;

/// A figure eight of twice the size, driven at the same speed.
std::vector<RunSpec> plan_map_size(const Request& request) {
  std::vector<RunSpec> specs;
  const Drive drive{.scenario = "figure_eight",
                    .edits = {{"hw_path", "length_m", "2290"}, {"hw_path", "rise_m", "24"}},
                    .settings = {{"robot.loop_steps", "7600"}},
                    .steps = steps_of(request, {2 * kLoopSteps, 600})};
  add_drives(request, {{"density", "100"}}, drive, 100.0, std::max(drive.steps / 190, 1u), specs);
  return specs;
}

/// Mean time of the ninth tenth over that of the second tenth, iterations weighted so that both see the same numbers of points. In the last tenth
/// the loop closes, which is work of its own.
std::optional<double> growth_at_equal_counts(const Trace& trace) {
  constexpr std::uint32_t kNear = 5;  // visible points; so near to each other, numbers count as equal
  struct Times {
    std::vector<double> second{}, last{};
  };
  std::map<std::uint32_t, Times> by_count;
  const std::size_t tenth = trace.steps.size() / 10;
  for (std::size_t i = 0; i < tenth; ++i) {
    const TraceStep &early = trace.steps[tenth + i], &late = trace.steps[8 * tenth + i];
    by_count[early.visible / kNear].second.push_back(early.cpu_ms);
    by_count[late.visible / kNear].last.push_back(late.cpu_ms);
  }
  double second = 0.0, last = 0.0;
  for (const auto& [count, times] : by_count) {
    const double weight = static_cast<double>(std::min(times.second.size(), times.last.size()));
    if (weight == 0.0) continue;
    second += weight * *mean(times.second);
    last += weight * *mean(times.last);
  }
  if (!(second > 0.0)) return std::nullopt;
  return last / second;
}

/// What the line through the times before the last tenth says of their end, over what it says of their beginning.
std::optional<double> growth_of_line(const Trace& trace) {
  std::vector<Vec2> points;
  for (std::size_t i = kWarmUp; i < trace.steps.size() * 9 / 10; ++i)
    points.emplace_back(static_cast<double>(i), trace.steps[i].cpu_ms);
  const auto fit = fit_line(points);
  if (!fit) return std::nullopt;
  const double begin = fit->intercept + fit->slope * points.front().x();
  const double end = fit->intercept + fit->slope * points.back().x();
  if (!(begin > 0.0)) return std::nullopt;
  return end / begin;
}

Outcome conclude_map_size(const std::vector<StudyRun>& runs, const Request&) {
  const std::vector<RunGroup> groups = group_runs(runs);
  Findings findings(false), times(true);
  add_accuracy(groups, "136", findings);
  for (const RunGroup& group : groups) {
    times.add("136", group.name, "time of the ninth tenth over the second, at equal visible points",
              group_median(group, growth_at_equal_counts), "1");
    times.add("136", group.name, "line through the times of nine tenths, end over beginning",
              group_median(group, growth_of_line), "1");
  }
  add_times(groups, "136", times);
  constexpr std::size_t kPart = 12;
  Chart time{.file = "time",
             .title = "Size of the map: time of an iteration on a figure eight of 2290 m",
             .figures = "110, 136",
             .x = {"iteration"},
             .y = {"CPU time of the plugin, ms, means of 12 iterations"},
             .series = part_series(groups, kPart, kWarmUp,
                                   [](const PartMeans& means) { return std::optional(means.cpu_ms); }),
             .clock = true};
  for (Series& series : time.series) series.points = thinned(series.points, 700);
  Chart visible{.file = "visible",
                .title = "Size of the map: points in view, and landmarks mapped",
                .figures = "136",
                .x = {"iteration"},
                .y = {"points"},
                .series = sample_series(groups, [](const MapSample& sample) {
                  return std::optional<double>(static_cast<double>(sample.mapped));
                })};
  for (Series& series : visible.series) series.name += ", mapped";
  Series seen = part_series({groups.front()}, kPart, kWarmUp, [](const PartMeans& means) {
                  return std::optional(means.visible);
                }).front();
  seen.name = "in view";
  seen.style = SeriesStyle::kDashed;
  seen.colour = render::palette::kInk;
  visible.series.push_back(std::move(seen));
  return {.tables = {findings.take(), times.take()}, .charts = {time, visible}};
}

}  // namespace

const Study kMapSize{.name = "map-size",
                     .figures = "110, 136",
                     .about =
                         "A figure eight of twice the size: whether an iteration costs more as the map "
                         "grows (6.5.1, 6.6.2)",
                     .size = "7600 iterations",
                     .plan = plan_map_size,
                     .conclude = conclude_map_size};

}  // namespace hallway::study
