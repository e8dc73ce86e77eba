// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "study/parts.hpp"
#include "study/statistics.hpp"

namespace hallway::study {
namespace {

/// With 3 % of moving landmarks and without any: what finding them costs (figure 117).
std::vector<RunSpec> plan_binning(const Request& request) {
  std::vector<RunSpec> specs;
  for (const char* percent : {"0", "3"}) {
    Drive drive{.scenario = "figure_eight", .steps = steps_of(request, {kLoopSteps, 200})};
    drive.edits = {{"hw_landmark_cloud", "moving_share", percent == std::string("3") ? "0.03" : "0"}};
    add_drives(request, {{"moving", percent + std::string(" %")}}, drive, 100.0,
               std::max(drive.steps / 19, 1u), specs);
  }
  return specs;
}

/// Points of which some move: the deviations of their distances, as the thesis draws them.
class Deviations {
 public:
  /// @param moving_percent  of the points move, each for itself
  /// @param grouped_percent of the points move in each of four groups
  Deviations(std::size_t points, int moving_percent, int grouped_percent, std::uint32_t trial)
      : random_(1, stream_id("study.binning")), trial_(trial) {
    std::vector<std::uint32_t> order(points);
    for (std::size_t i = 0; i < points; ++i) order[i] = static_cast<std::uint32_t>(i);
    for (std::size_t i = points; i > 1; --i) {
      const auto other = static_cast<std::size_t>(random_.uniform(trial, i) * static_cast<double>(i));
      std::swap(order[i - 1], order[other]);
    }
    body_.assign(points, 0);
    std::size_t next = 0;
    const auto give = [&](int percent, bool together) {
      const auto count = static_cast<std::size_t>(
          std::lround(static_cast<double>(points) * static_cast<double>(percent) / 100.0));
      for (std::size_t i = 0; i < count && next < points; ++i) {
        if (i == 0 || !together) ++bodies_;
        body_[order[next++]] = bodies_;
      }
    };
    give(moving_percent, false);
    for (int group = 0; group < 4; ++group) give(grouped_percent, true);
  }

  /// Points of one body, or that both stand, keep their distance to 5 cm of noise; others do not.
  double operator()(std::uint32_t a, std::uint32_t b) const {
    const double drawn = random_.uniform(trial_ + 1000, std::uint64_t{std::min(a, b)} << 32 | std::max(a, b));
    return body_[a] == body_[b] ? 0.06 + 0.02 * drawn : 0.5 + drawn;
  }

 private:
  Random random_;
  std::uint32_t trial_;
  std::vector<std::uint32_t> body_;  ///< 0: stands
  std::uint32_t bodies_ = 0;
};

/// A way to bin.
struct BinningCase {
  int moving_percent = 0;
  int grouped_percent = 0;
  bool priority = false;
  std::string name() const {
    if (grouped_percent > 0)
      return fmt::format("{} %, and 4 groups of {} %", moving_percent, grouped_percent);
    return fmt::format("{} %", moving_percent);
  }
};

struct BinningMedian {
  double comparisons = 0.0;
  double largest = 0.0;
};

BinningMedian measure(const BinPoints& bin_points, const BinningCase& one, std::size_t points,
                      std::uint32_t trials) {
  std::vector<double> comparisons, largest;
  for (std::uint32_t trial = 0; trial < trials; ++trial) {
    const Deviations deviations(points, one.moving_percent, one.grouped_percent, trial);
    const BinCount count = bin_points(points, one.priority, deviations);
    comparisons.push_back(static_cast<double>(count.comparisons));
    largest.push_back(static_cast<double>(count.largest));
  }
  return {median(comparisons).value_or(0.0), median(largest).value_or(0.0)};
}

/// Makes the charts of one way to bin, and fills the table.
class BinningStudy {
 public:
  BinningStudy(const BinPoints& bin_points, const Request& request)
      : bin_points_(bin_points), trials_(request.seeds) {
    const std::size_t step = request.quick ? 40 : 20, most = request.quick ? 80 : 200;
    for (std::size_t n = step; n <= most; n += step) sizes_.push_back(n);
  }

  /// @param with_largest  shows the points in the largest bin instead of the comparisons
  Chart chart(const char* file, const char* title, const char* figures, const std::vector<BinningCase>& cases,
              bool with_largest) {
    Chart chart{.file = file,
                .title = title,
                .figures = figures,
                .x = {"points"},
                .y = {with_largest ? "points in the largest bin" : "comparisons of two points"}};
    for (const BinningCase& one : cases) {
      Series line{.name = one.name(), .colour = series_colour(chart.series.size())};
      for (const std::size_t n : sizes_) {
        const BinningMedian found = measure(bin_points_, one, n, trials_);
        line.points.emplace_back(static_cast<double>(n), with_largest ? found.largest : found.comparisons);
        if (!with_largest) add_row(one, n, found);
      }
      chart.series.push_back(std::move(line));
    }
    if (!with_largest) add_reference(chart);
    return chart;
  }

  Table take() { return std::move(table_); }

 private:
  void add_row(const BinningCase& one, std::size_t n, const BinningMedian& found) {
    table_.add({static_cast<double>(one.moving_percent), static_cast<double>(one.grouped_percent),
                one.priority ? 1.0 : 0.0, static_cast<double>(n), found.comparisons, found.largest});
  }

  void add_reference(Chart& chart) const {
    Series line{.name = "n log2 n", .style = SeriesStyle::kDashed, .colour = render::palette::kInk};
    for (const std::size_t n : sizes_) {
      const double size = static_cast<double>(n);
      line.points.emplace_back(size, size * std::log2(size));
    }
    chart.series.push_back(std::move(line));
  }

  const BinPoints& bin_points_;
  std::uint32_t trials_;
  std::vector<std::size_t> sizes_;
  Table table_{
      .file = "binning",
      .columns = {"moving_percent", "grouped_percent", "priority", "points", "comparisons", "largest_bin"}};
};

void add_comparisons(const Request& request, Outcome& outcome) {
  BinningStudy study(request.bin_points, request);
  const auto cases = [](std::initializer_list<int> percents, bool priority) {
    std::vector<BinningCase> all;
    for (const int percent : percents) all.push_back({percent, 0, priority});
    return all;
  };
  outcome.charts.push_back(study.chart("in_turn", "Binning: comparisons, each bin in its turn", "111, 113",
                                       cases({0, 10, 20, 30, 50, 70, 90}, false), false));
  outcome.charts.push_back(study.chart("largest_bin", "Binning: points in the largest bin", "112",
                                       cases({0, 10, 20, 30, 50, 70, 90}, false), true));
  outcome.charts.push_back(study.chart("groups", "Binning: comparisons where groups move", "114",
                                       {{10, 0, false}, {20, 0, false}, {50, 0, false}, {10, 10, false}},
                                       false));
  outcome.charts.push_back(study.chart("priority", "Binning: comparisons, what joined goes first", "115",
                                       cases({0, 10, 20, 30, 40}, true), false));
  outcome.charts.push_back(study.chart("priority_threshold",
                                       "Binning: comparisons near the share that ends them", "116",
                                       cases({40, 43, 45, 47, 49, 50}, true), false));
  outcome.tables.push_back(study.take());
}

/// What an iteration takes more where 3 % of the landmarks move, as a share.
void add_cost(const std::vector<RunGroup>& groups, Findings& times) {
  const auto time = [](const RunGroup& group) {
    return group_median(group, [](const Trace& trace) {
      return std::optional(part_means(trace, 0, trace.steps.size()).cpu_ms);
    });
  };
  for (const RunGroup& group : groups) {
    const RunSpec& spec = group.runs.front()->spec;
    if (spec.label("moving") != "3 %") continue;
    for (const RunGroup& other : groups) {
      const RunSpec& standing = other.runs.front()->spec;
      if (standing.label("moving") != "0 %" || standing.plugin.label() != spec.plugin.label()) continue;
      const auto with = time(group), without = time(other);
      if (with && without && *without > 0.0)
        times.add("117", spec.plugin.label(), "time with 3 % moving landmarks over that without",
                  *with / *without, "1");
    }
  }
}

Outcome conclude_binning(const std::vector<StudyRun>& runs, const Request& request) {
  const std::vector<RunGroup> groups = group_runs(runs);
  Findings findings(false), times(true);
  add_accuracy(groups, "117", findings);
  add_cost(groups, times);
  add_times(groups, "117", times);
  Outcome outcome{.tables = {findings.take(), times.take()}};
  if (request.bin_points) add_comparisons(request, outcome);
  const std::size_t part = std::max<std::size_t>(runs.front().spec.iterations() / 190, 1);
  outcome.charts.push_back(
      {.file = "cost",
       .title = "Binning: time of an iteration with and without moving landmarks",
       .figures = "117",
       .x = {"iteration"},
       .y = {"CPU time of the plugin, ms"},
       .series =
           part_series(groups, part, 0, [](const PartMeans& means) { return std::optional(means.cpu_ms); }),
       .clock = true});
  return outcome;
}

}  // namespace

const Study kBinning{.name = "binning",
                     .figures = "111-117",
                     .about =
                         "How many comparisons finding moving points takes, and what it costs in a run "
                         "(6.5.3)",
                     .size = "20 to 200 points; 3800 iterations with and without moving landmarks",
                     .plan = plan_binning,
                     .conclude = conclude_binning};

}  // namespace hallway::study
