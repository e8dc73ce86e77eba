// SPDX-License-Identifier: MIT
#include "study/first_robot/mapping.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "base/file.hpp"
#include "support/data.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"

namespace hallway::study {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using test::TempFolder;

/// What a run leaves that commanded the robot to move in some iterations, and its result.
batch::Result leave_run(const fs::path& folder, const std::string& topology, int moving, int iterations) {
  make_folder(folder);
  std::string commands = "iteration,linear_m_s,angular_rad_s\n";
  for (int i = 0; i < iterations; ++i)
    commands += std::to_string(i) + (i < moving ? ",0.3,-0.01\n" : ",0,0\n");
  write_file_atomically(folder / "commands.csv", commands);
  write_file_atomically(folder / "run.json", R"({"schema": "hallway.run/1", "period_ns": 50000000})");
  batch::Result result{.name = "run",
                       .labels = {{"map", "cubicles"}, {"office", ""}, {"faults", "yes"}, {"seed", "4"}}};
  result.metrics = Json::parse(R"({"drive": {"distance_m": 31.5}, "topology": )" + topology + "}");
  return result;
}

constexpr const char* kTopology = R"({
  "nodes": {"demanded": 20, "charted": 19, "found": 17, "undecided": 0, "wrong_kind": 1, "missed": 2, "accepted": 0,
            "duplicates": 0, "false": 1, "place_m": null},
  "openings": {"demanded": 8, "found": 8, "right_kind": 7},
  "edges": {"compared": 18, "not_driven": 0, "length_m": {"count": 18, "rmse": 0.05, "mean": 0.04, "median": 0.03, "max": 0.1}},
  "loop": "rightly closed", "came_around": true})";

const Table& table_of(const Outcome& outcome, const std::string& file) {
  const auto found =
      std::ranges::find_if(outcome.tables, [&](const Table& table) { return table.file == file; });
  if (found == outcome.tables.end()) throw std::runtime_error("no such table");
  return *found;
}

Field field_of(const Table& table, std::size_t row, const std::string& column) {
  const auto at = std::ranges::find(table.columns, column);
  return table.rows.at(row).at(static_cast<std::size_t>(at - table.columns.begin()));
}

double number_of(const Table& table, std::size_t row, const std::string& column) {
  return std::get<double>(field_of(table, row, column));
}

TEST(FirstRobotRuns, AreReadFromTheirMetricsAndCommands) {
  const TempFolder folder;
  const MappingRun run =
      read_mapping_run(leave_run(folder.path() / "run", kTopology, 600, 1000), folder.path() / "run");
  EXPECT_EQ(run.map, "cubicles");
  EXPECT_TRUE(run.faults);
  EXPECT_EQ(run.seed, 4u);
  EXPECT_FALSE(run.office);
  EXPECT_TRUE(run.is_right());
  EXPECT_EQ(run.nodes, 20.0);
  EXPECT_EQ(run.nodes_found, 17.0);
  EXPECT_EQ(run.nodes_missed, 2.0);
  EXPECT_EQ(run.nodes_false, 1.0);
  EXPECT_EQ(run.openings, 8.0);
  EXPECT_EQ(run.openings_right, 7.0);
  EXPECT_EQ(run.edge_rmse_m, 0.05);
  EXPECT_EQ(run.distance_m, 31.5);
  ASSERT_TRUE(run.time_s);
  EXPECT_NEAR(*run.time_s, 30.0, 1e-9);
}

TEST(FirstRobotRuns, OneWithoutATopologyIsNotScored) {
  const TempFolder folder;
  const MappingRun run =
      read_mapping_run(leave_run(folder.path() / "run", "null", 600, 1000), folder.path() / "run");
  EXPECT_EQ(run.loop, "");
  EXPECT_FALSE(run.nodes);
  EXPECT_EQ(run.distance_m, 31.5);
}

TEST(FirstRobotRuns, OneThatFailedHasNoNumbers) {
  const TempFolder folder;
  batch::Result result = leave_run(folder.path() / "run", kTopology, 600, 1000);
  result.status = 5;
  result.problem = "it crashed";
  const MappingRun run = read_mapping_run(result, folder.path() / "run");
  EXPECT_EQ(run.loop, "failed");
  EXPECT_EQ(run.problem, "it crashed");
  EXPECT_FALSE(run.distance_m);
}

TEST(FirstRobotRuns, ARobotThatStillDrivesHasNoTime) {
  const TempFolder folder;
  const fs::path run = folder.path() / "run";
  leave_run(run, kTopology, 900, 1000);  // stands for 5 s: that may be a sweep
  EXPECT_FALSE(time_until_it_stands_s(run / "commands.csv", 0.05));
  leave_run(run, kTopology, 0, 1000);
  EXPECT_FALSE(time_until_it_stands_s(run / "commands.csv", 0.05));
  write_file_atomically(run / "commands.csv", "iteration,linear_m_s,angular_rad_s\n0,0,0\nzero,0,0\n");
  {
    const auto error = test::error_of([&] { time_until_it_stands_s(run / "commands.csv", 0.05); });
    ASSERT_TRUE(error);
    EXPECT_EQ(error->code(), ErrorCode::kBadInput);
    EXPECT_NE(std::string(error->what()).find("commands.csv:3"), std::string::npos) << error->what();
  }
}

TEST(FirstRobotPlan, HasEveryRunOnceAndWritesTheOffices) {
  const TempFolder folder;
  const batch::Plan plan = plan_mapping({.seeds = 2,
                                         .offices = 2,
                                         .first_seed = 11,
                                         .maps = test::source_folder() / "maps",
                                         .out = folder.path(),
                                         .arguments = {"--plugin", "wall_follower"}});
  EXPECT_EQ(plan.cells.size(), 2 * 2 * named_maps().size() + 4);
  std::set<std::string> names;
  for (const batch::Cell& cell : plan.cells) {
    EXPECT_TRUE(names.insert(cell.name).second) << cell.name;
    EXPECT_TRUE(fs::exists(cell.arguments.at(1))) << cell.arguments.at(1);
    EXPECT_EQ(cell.arguments.at(5), "wall_follower");
    EXPECT_EQ(cell.labels.at(2).value == "yes", cell.arguments.at(1).ends_with("_faults.toml"));
    EXPECT_TRUE(cell.arguments.at(3) == "11" || cell.arguments.at(3) == "12");
  }
}

TEST(FirstRobotPlan, ComparesBothRulesOfExploration) {
  const TempFolder folder;
  const MappingRequest request{.seeds = 2,
                               .offices = 0,
                               .maps = test::source_folder() / "maps",
                               .out = folder.path(),
                               .arguments = {"--plugin", "wall_follower"},
                               .by_cost = true};
  const batch::Plan plan = plan_mapping(request);
  const std::size_t half = 2 * 2 * named_maps().size();
  ASSERT_EQ(plan.cells.size(), 2 * half);
  for (std::size_t i = 0; i < half; ++i) {
    const batch::Cell &right = plan.cells[i], &cost = plan.cells[half + i];
    EXPECT_EQ(right.labels[0].value + kByCost, cost.labels[0].value);
    EXPECT_EQ(right.labels[3].value, cost.labels[3].value);  // the same seeds
    std::vector<std::string> arguments = right.arguments;
    arguments.insert(arguments.end(), {"--set", "wall_follower.exploration=2"});
    EXPECT_EQ(arguments, cost.arguments);
    EXPECT_NE(right.name, cost.name);
  }
}

TEST(FirstRobotTables, CountLoopsOfEachGroup) {
  const auto run = [](const char* map, bool faults, const char* loop, std::optional<double> distance_m) {
    return MappingRun{.map = map,
                      .faults = faults,
                      .loop = loop,
                      .nodes = 10.0,
                      .nodes_found = 9.0,
                      .openings = 4.0,
                      .openings_right = 3.0,
                      .distance_m = distance_m};
  };
  const std::vector<MappingRun> runs{run("cubicles", false, "rightly closed", 30.0),
                                     run("cubicles", false, "rightly closed", 50.0),
                                     run("cubicles", true, "wrongly closed", 35.0),
                                     run("cubicles", true, "uncertain", 36.0),
                                     run("cubicles", true, "rightly closed", std::nullopt),
                                     run("offices", true, "open", 12.0),
                                     run("offices", true, "", 12.0),
                                     run("cubicles", false, "failed", std::nullopt)};
  const Outcome outcome = conclude_mapping(runs);
  const Table& rates = table_of(outcome, "rates");
  ASSERT_EQ(rates.rows.size(), 3u);
  EXPECT_EQ(number_of(rates, 0, "runs"), 3.0);
  EXPECT_EQ(number_of(rates, 0, "rightly_closed"), 2.0);
  EXPECT_EQ(number_of(rates, 0, "failed"), 1.0);
  EXPECT_EQ(number_of(rates, 0, "rate"), 2.0 / 3.0);
  EXPECT_EQ(number_of(rates, 0, "distance_median_m"), 40.0);
  EXPECT_EQ(number_of(rates, 0, "openings_right_kind_share"), 0.75);
  EXPECT_EQ(number_of(rates, 1, "wrongly_closed"), 1.0);
  EXPECT_EQ(number_of(rates, 1, "uncertain"), 1.0);
  EXPECT_EQ(number_of(rates, 2, "open"), 1.0);
  EXPECT_EQ(number_of(rates, 2, "not_scored"), 1.0);
  EXPECT_EQ(number_of(rates, 2, "rate_high"),
            number_of(table_of(conclude_mapping({&runs[5], 1}), "rates"), 0, "rate_high"));
  EXPECT_TRUE(std::holds_alternative<std::monostate>(
      field_of(table_of(conclude_mapping({&runs[6], 1}), "rates"), 0, "rate")));  // nothing was scored
  EXPECT_TRUE(std::holds_alternative<std::monostate>(field_of(rates, 2, "time_median_s")));
  for (std::size_t row = 0; row < rates.rows.size(); ++row) {
    double sum = 0.0;
    for (const char* column :
         {"rightly_closed", "wrongly_closed", "uncertain", "open", "failed", "not_scored"})
      sum += number_of(rates, row, column);
    EXPECT_EQ(sum, number_of(rates, row, "runs"));
    EXPECT_LE(number_of(rates, row, "rate_low"), number_of(rates, row, "rate"));
    EXPECT_GE(number_of(rates, row, "rate_high"), number_of(rates, row, "rate"));
  }
  EXPECT_EQ(table_of(outcome, "runs").rows.size(), runs.size());
}

TEST(FirstRobotCharts, HistogramsHoldEveryRunThatHasTheNumber) {
  std::vector<MappingRun> runs;
  for (int i = 0; i < 7; ++i)
    runs.push_back({.map = "cubicles", .faults = i % 2 == 0, .distance_m = 9.0 * i, .time_s = 100.0});
  runs.push_back({.map = "cubicles", .faults = true});
  const std::vector<Chart> charts = mapping_charts(runs);
  ASSERT_EQ(charts.size(), 3u);
  EXPECT_EQ(charts[0].x.names, std::vector<std::string>{"cubicles"});
  double area = 0.0;
  for (const Series& series : charts[1].series) {
    for (std::size_t i = 1; i < series.points.size(); ++i)
      area += series.points[i].y() * (series.points[i].x() - series.points[i - 1].x());
  }
  EXPECT_NEAR(area, 7.0 * 10.0, 1e-9);
  for (const Chart& chart : charts) EXPECT_GT(print_svg(chart).size(), 1000u);
}

}  // namespace
}  // namespace hallway::study
