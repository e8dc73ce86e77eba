// SPDX-License-Identifier: MIT
#include <utility>

#include "study/curves.hpp"
#include "study/first_robot/mapping.hpp"
#include "study/statistics.hpp"

namespace hallway::study {
namespace {

using RunNumber = std::optional<double> MappingRun::*;

std::uint64_t count_of(const MappingGroup& group, const std::string& loop) {
  std::uint64_t count = 0;
  for (const MappingRun* run : group.runs) count += run->loop == loop ? 1u : 0u;
  return count;
}

std::vector<double> numbers_of(const MappingGroup& group, RunNumber number) {
  std::vector<double> numbers;
  for (const MappingRun* run : group.runs) {
    if (run->*number) numbers.push_back(*(run->*number));
  }
  return numbers;
}

/// Sum of one number over that of another, over the runs that have both.
std::optional<double> share_of(const MappingGroup& group, RunNumber part, RunNumber whole) {
  double parts = 0.0, wholes = 0.0;
  for (const MappingRun* run : group.runs) {
    if (!(run->*part) || !(run->*whole)) continue;
    parts += *(run->*part);
    wholes += *(run->*whole);
  }
  if (wholes <= 0.0) return std::nullopt;
  return parts / wholes;
}

Table runs_table(std::span<const MappingRun> runs) {
  Table table{.file = "runs",
              .columns = {"map", "office", "faults", "seed", "loop", "nodes", "nodes_found", "nodes_missed",
                          "nodes_false", "openings", "openings_right_kind", "edge_length_rmse_m",
                          "distance_m", "time_s", "problem"}};
  for (const MappingRun& run : runs) {
    table.add({run.map, run.office ? Field(static_cast<double>(*run.office)) : Field(),
               run.faults ? "yes" : "no", static_cast<double>(run.seed),
               run.loop.empty() ? Field() : Field(run.loop), field(run.nodes), field(run.nodes_found),
               field(run.nodes_missed), field(run.nodes_false), field(run.openings),
               field(run.openings_right), field(run.edge_rmse_m), field(run.distance_m), field(run.time_s),
               run.problem.empty() ? Field() : Field(run.problem)});
  }
  return table;
}

Table rates_table(const std::vector<MappingGroup>& groups) {
  Table table{.file = "rates",
              .columns = {"map", "faults", "runs", "rightly_closed", "wrongly_closed", "uncertain", "open",
                          "failed", "not_scored", "rate", "rate_low", "rate_high", "nodes_found_share",
                          "openings_right_kind_share", "distance_median_m", "time_median_s"}};
  for (const MappingGroup& group : groups) {
    const std::uint64_t right = count_of(group, "rightly closed");
    const auto rate = share_interval(right, group.counted());
    const auto number = [](std::uint64_t count) { return Field(static_cast<double>(count)); };
    table.add({group.map, group.faults ? "yes" : "no", number(group.runs.size()), number(right),
               number(count_of(group, "wrongly closed")), number(count_of(group, "uncertain")),
               number(count_of(group, "open")), number(count_of(group, "failed")),
               number(count_of(group, "")), rate ? Field(rate->value) : Field(),
               rate ? Field(rate->low) : Field(), rate ? Field(rate->high) : Field(),
               field(share_of(group, &MappingRun::nodes_found, &MappingRun::nodes)),
               field(share_of(group, &MappingRun::openings_right, &MappingRun::openings)),
               field(median(numbers_of(group, &MappingRun::distance_m))),
               field(median(numbers_of(group, &MappingRun::time_s)))});
  }
  return table;
}

const char* figures_of(const std::string& map) {
  if (map == "cubicles") return "26";
  return map == "cubicles_changed" ? "27, 28" : "";
}

Table findings_table(const std::vector<MappingGroup>& groups) {
  Findings findings(false);
  for (const MappingGroup& group : groups) {
    const std::string figures = figures_of(group.map);
    const auto add_share = [&](const char* what, std::uint64_t count) {
      const auto share = share_interval(count, group.counted());
      if (!share) return;
      findings.add(figures, group.name(), what, share->value, share->low, share->high, "1");
    };
    add_share("loop rightly closed", count_of(group, "rightly closed"));
    add_share("loop wrongly closed", count_of(group, "wrongly closed"));
    findings.add(figures, group.name(), "openings charted as what they are",
                 share_of(group, &MappingRun::openings_right, &MappingRun::openings), "1");
    findings.add(figures, group.name(), "distance, median",
                 median(numbers_of(group, &MappingRun::distance_m)), "m");
    findings.add(figures, group.name(), "time until it stands, median",
                 median(numbers_of(group, &MappingRun::time_s)), "s");
  }
  return findings.take();
}

}  // namespace

Outcome conclude_mapping(std::span<const MappingRun> runs) {
  const std::vector<MappingGroup> groups = group_mapping_runs(runs);
  return {.tables = {findings_table(groups), rates_table(groups), runs_table(runs)},
          .charts = mapping_charts(runs)};
}

}  // namespace hallway::study
