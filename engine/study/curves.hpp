// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "study/chart.hpp"
#include "study/study.hpp"

namespace hallway::study {

/// Runs that differ by their seeds alone.
struct RunGroup {
  std::string name{};  ///< what tells it from the other groups
  std::vector<const StudyRun*> runs{};
};

/// The runs by their labels and plugins, in the order of their first appearance. Names have only what not all groups share.
std::vector<RunGroup> group_runs(const std::vector<StudyRun>& runs);

/// Position errors in some iterations, metres.
struct MeanError {
  double distance = 0.0;  ///< mean of the distances
  Vec3 signed_mean = Vec3::Zero();
};

/// Means over the iterations [begin, end) of a run; zero where there are none.
struct PartMeans {
  double visible = 0.0;
  double cpu_ms = 0.0;
  std::optional<MeanError> error{};
  std::optional<Vec3> truth{};  ///< mean true position
};
PartMeans part_means(const Trace& trace, std::size_t begin, std::size_t end);

/// A number of a run's look at the map.
using SampleNumber = std::optional<double> (*)(const MapSample&);

/// For each group a line: over iterations, the median over the seeds.
std::vector<Series> sample_series(const std::vector<RunGroup>& groups, SampleNumber number);

/// A number of a part of a run.
using PartNumber = std::function<std::optional<double>(const PartMeans&)>;

/// The same of parts of `length` iterations (at least 1), from iteration `begin` on; x is the middle of a part.
std::vector<Series> part_series(const std::vector<RunGroup>& groups, std::size_t length, std::size_t begin,
                                const PartNumber& number);

/// The median over a group's runs of what `number` gives of each; empty where it gives nothing.
std::optional<double> group_median(const RunGroup& group,
                                   const std::function<std::optional<double>(const Trace&)>& number);

/// The table `findings`: what a study comes to, one number in each row.
class Findings {
 public:
  /// @param clock  of numbers that are times
  explicit Findings(bool clock);
  /// @param figures  of the thesis
  void add(const std::string& figures, const std::string& group, const std::string& what,
           const std::optional<double>& value, const std::string& unit);
  /// With the bounds of a 95 % interval.
  void add(const std::string& figures, const std::string& group, const std::string& what,
           const std::optional<double>& value, const std::optional<double>& low,
           const std::optional<double>& high, const std::string& unit);
  Table take() { return std::move(table_); }

 private:
  Table table_;
};

}  // namespace hallway::study
