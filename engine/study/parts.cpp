// SPDX-License-Identifier: MIT
#include "study/parts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "study/statistics.hpp"

namespace hallway::study {

std::vector<PluginChoice> default_plugins(const Study& study) {
  PluginChoice plugin{.plugin = "slam_point"};
  if (study.name == "victoria-park")  // what plugins/slam_point/README.md advises for these data
    plugin.parameters = {{"noise_m", "0.25"}, {"overlap", "0.3"}, {"separation_m", "2.5"}};
  if (study.name == "constants") return {plugin};  // adds mode=thesis itself
  PluginChoice faithful = plugin;
  faithful.parameters.insert(faithful.parameters.begin(), {"mode", "thesis"});
  if (study.name == "victoria-park") {  // trees are in view for a few scans only
    faithful.parameters = {{"mode", "thesis"},           {"noise_m", "0.25"},
                           {"separation_m", "2.5"},      {"thesis_levels", "1"},
                           {"thesis_look_back", "10"},   {"thesis_accuracy_reduction", "5"},
                           {"thesis_previous_min", "3"}, {"thesis_matching", "predicted"}};
  }
  return {plugin, faithful};
}

std::vector<MapEdit> cloud_of(double per_100m, std::uint64_t seed) {
  return {{"hw_landmark_cloud", "per_100m", format_double(per_100m)},
          {"hw_landmark_cloud", "seed", fmt::to_string(seed)}};
}

std::uint32_t steps_of(const Request& request, const DriveSize& size) {
  if (request.steps > 0) return request.steps;
  return request.quick ? size.quick : size.full;
}

void add_drives(const Request& request, const std::vector<RunLabel>& labels, Drive drive, double per_100m,
                std::uint32_t sample_every, std::vector<RunSpec>& specs) {
  const std::vector<MapEdit> edits = drive.edits;
  for (std::uint64_t seed = 1; seed <= request.seeds; ++seed) {
    drive.seed = seed;
    drive.edits = edits;
    for (const MapEdit& edit : cloud_of(per_100m, seed)) drive.edits.push_back(edit);
    for (const PluginChoice& plugin : request.plugins)
      specs.push_back({labels, drive, plugin, seed, std::max(sample_every, 1u)});
  }
}

void add_accuracy(const std::vector<RunGroup>& groups, const std::string& figures, Findings& findings) {
  for (const RunGroup& group : groups) {
    const auto add = [&](const char* what, const char* unit, auto number) {
      findings.add(figures, group.name, what, group_median(group, number), unit);
    };
    add("landmark RMSE aligned, online", "m",
        [](const Trace& trace) { return trace.metrics.landmark_rmse_m.aligned; });
    add("landmark RMSE aligned, at the end", "m",
        [](const Trace& trace) { return trace.metrics.landmark_rmse_final_aligned_m; });
    add("true landmarks mapped, share", "1",
        [](const Trace& trace) { return trace.metrics.landmark_coverage(); });
    add("position RMSE aligned", "m",
        [](const Trace& trace) { return trace.metrics.position_rmse_m.aligned; });
    add("frames with a pose, share", "1", [](const Trace& trace) { return trace.metrics.pose_coverage(); });
    for (const auto verdict : {eval::PathVerdict::kDiverged, eval::PathVerdict::kLost}) {
      const auto count = std::count_if(group.runs.begin(), group.runs.end(), [&](const StudyRun* run) {
        return run->trace.metrics.verdict == verdict;
      });
      findings.add(figures, group.name, fmt::format("runs {}", eval::name_of(verdict)),
                   static_cast<double>(count), "1");
    }
    add("iterations without a pose", "1", [](const Trace& trace) -> std::optional<double> {
      if (!trace.metrics.lost_iterations) return std::nullopt;
      return static_cast<double>(*trace.metrics.lost_iterations);
    });
    add("misassociated observations, share", "1", [](const Trace& trace) -> std::optional<double> {
      if (!trace.metrics.association_errors || trace.metrics.observations == 0) return std::nullopt;
      return static_cast<double>(*trace.metrics.association_errors) /
             static_cast<double>(trace.metrics.observations);
    });
  }
}

void add_times(const std::vector<RunGroup>& groups, const std::string& figures, Findings& findings) {
  for (const RunGroup& group : groups) {
    const auto add = [&](const char* what, double eval::TimeSummary::*number) {
      findings.add(figures, group.name, what,
                   group_median(group,
                                [number](const Trace& trace) -> std::optional<double> {
                                  if (!trace.metrics.iteration_cpu_ms) return std::nullopt;
                                  return (*trace.metrics.iteration_cpu_ms).*number;
                                }),
                   "ms");
    };
    add("iteration, mean", &eval::TimeSummary::mean);
    add("iteration, 99th percentile", &eval::TimeSummary::p99);
    add("iteration, worst", &eval::TimeSummary::max);
  }
}

void add_exponent(const RunGroup& group, const std::string& figures, const std::string& what,
                  const std::function<std::vector<Vec2>(const Trace&)>& points, Findings& findings) {
  std::vector<double> exponents;
  for (const StudyRun* run : group.runs) {
    if (const auto fit = fit_power(points(run->trace))) exponents.push_back(fit->slope);
  }
  if (const auto interval = mean_interval(exponents)) {
    findings.add(figures, group.name, what, interval->value, interval->low, interval->high, "1");
  } else {
    findings.add(figures, group.name, what, mean(exponents), "1");
  }
}

Chart landmark_error_chart(const std::vector<RunGroup>& groups, const std::string& title,
                           const std::string& figures) {
  return {.file = "landmark_error",
          .title = title,
          .figures = figures,
          .x = {"iteration"},
          .y = {"sum of landmark errors, m, from the first pose"},
          .series = sample_series(groups, [](const MapSample& sample) { return sample.error_sum_m; })};
}

Chart landmark_rmse_chart(const std::vector<RunGroup>& groups, const std::string& title,
                          const std::string& figures) {
  return {.file = "landmark_rmse",
          .title = title,
          .figures = figures,
          .x = {"iteration"},
          .y = {"landmark RMSE, m, after the best rigid fit"},
          .series = sample_series(groups, [](const MapSample& sample) { return sample.rmse_aligned_m; })};
}

Chart position_error_chart(const std::vector<RunGroup>& groups, const std::string& title,
                           const std::string& figures, std::size_t part) {
  return {.file = "position_error",
          .title = title,
          .figures = figures,
          .x = {"iteration"},
          .y = {fmt::format("position error, m, from the first pose, means of {} iterations", part)},
          .series = part_series(groups, part, 0, [](const PartMeans& means) -> std::optional<double> {
            if (!means.error) return std::nullopt;
            return means.error->distance;
          })};
}

}  // namespace hallway::study
