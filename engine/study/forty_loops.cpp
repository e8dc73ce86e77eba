// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/parts.hpp"
#include "study/statistics.hpp"

namespace hallway::study {
namespace {

/// Rounds, and iterations of one: of the full size and of the quick one.
struct Rounds {
  std::uint32_t count = 40;
  std::uint32_t steps = kLoopSteps;
};

/// At the quick size the robot is five times as fast, so that the rounds take seconds. Asked for other steps, it drives as many rounds as fit.
Rounds rounds_of(const Request& request) {
  Rounds rounds;
  if (request.quick) rounds = {.count = 4, .steps = 760};
  if (request.steps > 0) rounds.count = std::max(request.steps / rounds.steps, 1u);
  return rounds;
}

std::vector<RunSpec> plan_forty_loops(const Request& request) {
  std::vector<RunSpec> specs;
  const Rounds rounds = rounds_of(request);
  const Drive drive{.scenario = "figure_eight",
                    .settings = {{"robot.loop_steps", fmt::to_string(rounds.steps)}},
                    .steps = rounds.count * rounds.steps};
  add_drives(request, {{"density", "100"}}, drive, 100.0, std::max(rounds.steps / 10, 1u), specs);
  return specs;
}

/// Mean signed error of each round, world axes.
std::vector<Vec3> round_errors(const Trace& trace, const Rounds& rounds) {
  std::vector<Vec3> errors;
  for (std::size_t k = 0; (k + 1) * rounds.steps <= trace.steps.size(); ++k) {
    const PartMeans part = part_means(trace, k * rounds.steps, (k + 1) * rounds.steps);
    if (part.error) errors.push_back(part.error->signed_mean);
  }
  return errors;
}

/// How far a mean error moves over the last half of the rounds, by a line through them.
std::optional<double> late_change(const Trace& trace, const Rounds& rounds, Eigen::Index axis) {
  const std::vector<Vec3> errors = round_errors(trace, rounds);
  std::vector<Vec2> late;
  for (std::size_t k = errors.size() / 2; k < errors.size(); ++k)
    late.emplace_back(static_cast<double>(k), errors[k][axis]);
  const auto fit = fit_line(late);
  if (!fit) return std::nullopt;
  return fit->slope * static_cast<double>(late.size());
}

Table rounds_table(const std::vector<StudyRun>& runs, const Rounds& rounds) {
  Table table{.file = "loops",
              .columns = {"plugin", "seed", "loop", "landmark_rmse_aligned_m", "landmark_error_sum_m",
                          "x_error_mean_m", "y_error_mean_m", "z_error_mean_m"}};
  for (const StudyRun& run : runs) {
    const std::vector<Vec3> errors = round_errors(run.trace, rounds);
    for (std::size_t k = 0; k < errors.size(); ++k) {
      MapSample sample;
      for (const MapSample& one : run.trace.samples) {
        if (one.iterations == (k + 1) * rounds.steps) sample = one;
      }
      table.add({run.spec.plugin.label(), static_cast<double>(run.spec.seed), static_cast<double>(k + 1),
                 field(sample.rmse_aligned_m), field(sample.error_sum_m), errors[k].x(), errors[k].y(),
                 errors[k].z()});
    }
  }
  return table;
}

/// Landmark RMSE at the end of each round.
std::vector<Vec2> rmse_of_rounds(const Trace& trace, const Rounds& rounds) {
  std::vector<Vec2> points;
  for (const MapSample& sample : trace.samples) {
    if (sample.iterations % rounds.steps == 0 && sample.rmse_aligned_m)
      points.emplace_back(sample.iterations / rounds.steps, *sample.rmse_aligned_m);
  }
  return points;
}

/// The same as medians over the seeds.
std::vector<Vec2> rmse_by_round(const RunGroup& group, const Rounds& rounds) {
  std::vector<Vec2> points;
  for (std::uint32_t k = 1; k <= rounds.count; ++k) {
    const auto value = group_median(group, [&](const Trace& trace) -> std::optional<double> {
      for (const Vec2& point : rmse_of_rounds(trace, rounds)) {
        if (point.x() == k) return point.y();
      }
      return std::nullopt;
    });
    if (value) points.emplace_back(k, *value);
  }
  return points;
}

void add_fall(const RunGroup& group, const Rounds& rounds, const std::vector<Vec2>& by_round,
              Findings& findings) {
  if (const auto fit = fit_root_with_floor(by_round)) {
    findings.add("167", group.name, "landmark RMSE of one loop, falling as 1/sqrt(loops)", fit->scale, "m");
    findings.add("167", group.name, "floor of landmark RMSE", fit->floor, "m");
  }
  add_exponent(
      group, "167", "exponent of landmark RMSE over loops",
      [&](const Trace& trace) { return rmse_of_rounds(trace, rounds); }, findings);
}

/// Of several seeds the interval of their mean.
void add_late_changes(const RunGroup& group, const Rounds& rounds, Findings& findings) {
  static constexpr const char* kFigures[] = {"169", "171", "170"};
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<double> changes;
    for (const StudyRun* run : group.runs) {
      if (const auto change = late_change(run->trace, rounds, axis)) changes.push_back(*change);
    }
    const auto interval = mean_interval(changes);
    const std::string what = fmt::format("change of mean {} error over the last {} loops", "xyz"[axis],
                                         rounds.count - rounds.count / 2);
    if (interval) {
      findings.add(kFigures[axis], group.name, what, interval->value, interval->low, interval->high, "m");
    } else {
      findings.add(kFigures[axis], group.name, what, mean(changes), "m");
    }
  }
}

/// One axis of all groups.
Chart axis_chart(const std::vector<RunGroup>& groups, Eigen::Index axis, std::size_t part) {
  static constexpr const char* kFigures[] = {"169", "171", "170"};
  const char name = "xyz"[axis];
  return {.file = fmt::format("{}_error", name),
          .title = fmt::format("Loops: error in {}", name),
          .figures = kFigures[axis],
          .x = {"iteration"},
          .y = {fmt::format("error in {}, m, from the first pose, means of {} iterations", name, part)},
          .series = part_series(groups, part, 0, [axis](const PartMeans& means) -> std::optional<double> {
            if (!means.error) return std::nullopt;
            return means.error->signed_mean[axis];
          })};
}

Outcome conclude_forty_loops(const std::vector<StudyRun>& runs, const Request& request) {
  const std::vector<RunGroup> groups = group_runs(runs);
  const Rounds rounds = rounds_of(request);
  const std::size_t part = std::max<std::size_t>(rounds.steps / 20, 1);
  Findings findings(false);
  add_accuracy(groups, "167", findings);
  Chart fall{.file = "landmark_rmse_by_loop",
             .title = "Loops: landmark RMSE, aligned, at the end of each",
             .figures = "167",
             .x = {"loops", true},
             .y = {"landmark RMSE, m, after the best rigid fit", true}};
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const std::vector<Vec2> by_round = rmse_by_round(groups[i], rounds);
    add_fall(groups[i], rounds, by_round, findings);
    add_late_changes(groups[i], rounds, findings);
    fall.series.push_back({.name = groups[i].name,
                           .points = by_round,
                           .style = SeriesStyle::kMarks,
                           .colour = series_colour(i)});
    const auto fit = fit_root_with_floor(by_round);
    if (!fit) continue;
    Series line{.name = fmt::format("sqrt({:.4f}^2 / loops + {:.4f}^2)", fit->scale, fit->floor),
                .style = SeriesStyle::kDashed,
                .colour = series_colour(i)};
    for (const Vec2& point : by_round)
      line.points.emplace_back(point.x(), std::hypot(fit->scale / std::sqrt(point.x()), fit->floor));
    fall.series.push_back(std::move(line));
  }
  Outcome outcome{.tables = {findings.take(), rounds_table(runs, rounds)}};
  outcome.charts = {fall, landmark_error_chart(groups, "Loops: landmark error", "167"),
                    position_error_chart(groups, "Loops: position error", "168", part)};
  for (const Eigen::Index axis : {0, 2, 1}) outcome.charts.push_back(axis_chart(groups, axis, part));
  return outcome;
}

}  // namespace

const Study kFortyLoops{.name = "forty-loops",
                        .figures = "167-171",
                        .about =
                            "Forty times round the figure eight: to what the errors fall, and whether "
                            "they drift (6.9)",
                        .size = "40 loops of 3800 iterations",
                        .plan = plan_forty_loops,
                        .conclude = conclude_forty_loops};

}  // namespace hallway::study
