// SPDX-License-Identifier: MIT
#include "study/curves.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "study/statistics.hpp"

namespace hallway::study {
namespace {

/// The labels that differ between runs, and the plugin where it does.
std::set<std::string> varied_names(const std::vector<StudyRun>& runs) {
  std::set<std::string> varied;
  for (const StudyRun& run : runs) {
    for (const RunLabel& label : run.spec.labels) {
      if (label.value != runs.front().spec.label(label.name)) varied.insert(label.name);
    }
    if (run.spec.plugin.label() != runs.front().spec.plugin.label()) varied.insert("plugin");
  }
  if (varied.empty()) varied.insert("plugin");
  return varied;
}

/// The plugin without the parameters that are the same in all runs.
std::string short_plugin(const PluginChoice& plugin, const std::vector<StudyRun>& runs) {
  PluginChoice few{.plugin = plugin.plugin};
  for (const auto& parameter : plugin.parameters) {
    const bool shared = std::all_of(runs.begin(), runs.end(), [&](const StudyRun& run) {
      const auto& others = run.spec.plugin.parameters;
      return std::find(others.begin(), others.end(), parameter) != others.end();
    });
    if (!shared) few.parameters.push_back(parameter);
  }
  return few.label();
}

std::string short_name(const RunSpec& spec, const std::set<std::string>& varied,
                       const std::vector<StudyRun>& runs) {
  std::string name;
  for (const RunLabel& label : spec.labels) {
    if (varied.contains(label.name)) name += (name.empty() ? "" : ", ") + label.name + " " + label.value;
  }
  if (varied.contains("plugin")) name += (name.empty() ? "" : ", ") + short_plugin(spec.plugin, runs);
  return name;
}

/// For each group a line of medians by x. @param add  calls its second argument with the x and y of a run's trace
template <typename Add>
std::vector<Series> median_series(const std::vector<RunGroup>& groups, Add add) {
  std::vector<Series> all;
  for (const RunGroup& group : groups) {
    std::map<double, std::vector<double>> values;
    for (const StudyRun* run : group.runs) {
      add(run->trace, [&](double x, const std::optional<double>& y) {
        if (y) values[x].push_back(*y);
      });
    }
    Series line{.name = group.name, .colour = series_colour(all.size())};
    for (const auto& [x, y] : values) line.points.emplace_back(x, *median(y));
    all.push_back(std::move(line));
  }
  return all;
}

}  // namespace

std::vector<RunGroup> group_runs(const std::vector<StudyRun>& runs) {
  std::vector<RunGroup> groups;
  if (runs.empty()) return groups;
  const std::set<std::string> varied = varied_names(runs);
  std::map<std::string, std::size_t> known;
  for (const StudyRun& run : runs) {
    const auto [at, is_new] = known.emplace(run.spec.group(), groups.size());
    if (is_new) groups.push_back({.name = short_name(run.spec, varied, runs)});
    groups[at->second].runs.push_back(&run);
  }
  return groups;
}

PartMeans part_means(const Trace& trace, std::size_t begin, std::size_t end) {
  PartMeans means;
  end = std::min(end, trace.steps.size());
  if (begin >= end) return means;
  const double n = static_cast<double>(end - begin);
  MeanError error;
  Vec3 truth = Vec3::Zero();
  std::size_t errors = 0, truths = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const TraceStep& step = trace.steps[i];
    means.visible += step.visible / n;
    means.cpu_ms += step.cpu_ms / n;
    if (step.truth) truth += *step.truth, ++truths;
    if (const auto one = trace.position_error(i)) {
      error.distance += one->norm();
      error.signed_mean += *one;
      ++errors;
    }
  }
  if (truths > 0) means.truth = truth / static_cast<double>(truths);
  if (errors > 0) {
    error.distance /= static_cast<double>(errors);
    error.signed_mean /= static_cast<double>(errors);
    means.error = error;
  }
  return means;
}

std::vector<Series> sample_series(const std::vector<RunGroup>& groups, SampleNumber number) {
  return median_series(groups, [&](const Trace& trace, const auto& add) {
    for (const MapSample& sample : trace.samples) add(sample.iterations, number(sample));
  });
}

std::vector<Series> part_series(const std::vector<RunGroup>& groups, std::size_t length, std::size_t begin,
                                const PartNumber& number) {
  return median_series(groups, [&](const Trace& trace, const auto& add) {
    for (std::size_t at = begin; at + length <= trace.steps.size(); at += length)
      add(static_cast<double>(at) + 0.5 * static_cast<double>(length),
          number(part_means(trace, at, at + length)));
  });
}

std::optional<double> group_median(const RunGroup& group,
                                   const std::function<std::optional<double>(const Trace&)>& number) {
  std::vector<double> values;
  for (const StudyRun* run : group.runs) {
    if (const auto value = number(run->trace)) values.push_back(*value);
  }
  return median(std::move(values));
}

Findings::Findings(bool clock)
    : table_{.file = clock ? "times_findings" : "findings",
             .columns = {"figures", "of", "what", "value", "low", "high", "unit"},
             .clock = clock} {}

void Findings::add(const std::string& figures, const std::string& group, const std::string& what,
                   const std::optional<double>& value, const std::string& unit) {
  add(figures, group, what, value, std::nullopt, std::nullopt, unit);
}

void Findings::add(const std::string& figures, const std::string& group, const std::string& what,
                   const std::optional<double>& value, const std::optional<double>& low,
                   const std::optional<double>& high, const std::string& unit) {
  table_.add({figures, group, what, field(value), field(low), field(high), unit});
}

}  // namespace hallway::study
