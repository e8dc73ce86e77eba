// SPDX-License-Identifier: MIT
// What studies make of results whose answer is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "study/study.hpp"
#include "unit/study/hand_made_runs.hpp"

namespace hallway::study {
namespace {

const Study& study_of(std::string_view name) {
  const auto all = studies();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Study& one) { return one.name == name; });
  if (found == all.end()) throw std::runtime_error("no such study");
  return *found;
}

/// The row of a table of findings.
std::vector<double> finding(const Outcome& outcome, const std::string& what) {
  for (const Table& table : outcome.tables) {
    if (!table.file.ends_with("findings")) continue;
    for (const auto& row : table.rows) {
      if (std::get<std::string>(row[2]) != what) continue;
      std::vector<double> numbers;
      for (std::size_t i = 3; i < 6; ++i) {
        if (const auto* number = std::get_if<double>(&row[i])) numbers.push_back(*number);
      }
      return numbers;
    }
  }
  return {};
}

Request small_request() {
  return {.plugins = {{.plugin = "a"}}, .seeds = 2, .quick = true};
}

TEST(Studies, HaveNamesFiguresAndPlans) {
  std::set<std::string_view> names;
  for (const Study& study : studies()) {
    EXPECT_TRUE(names.insert(study.name).second);
    EXPECT_FALSE(study.figures.empty());
    Request request = small_request();
    request.plugins.push_back({.plugin = "b"});
    const auto specs = study.plan(request);
    EXPECT_GE(specs.size(), 2u) << study.name;
    std::set<std::string> runs;
    for (const RunSpec& spec : specs) {
      EXPECT_TRUE(runs.insert(spec.group() + std::to_string(spec.seed)).second) << study.name;
      EXPECT_GT(spec.iterations(), 0u);
      EXPECT_GE(spec.sample_every, 1u);
    }
  }
}

TEST(Studies, RunsOfOneGroundFollowEachOther) {
  for (const Study& study : studies()) {
    Request request = small_request();
    request.plugins.push_back({.plugin = "b"});
    std::set<std::string> left;
    std::string last;
    for (const RunSpec& spec : study.plan(request)) {
      const std::string key = ground_key(spec);
      if (key == last) continue;
      EXPECT_TRUE(left.insert(key).second) << study.name;
      last = key;
    }
  }
}

TEST(Density, FindsTheExponentOfTime) {
  const Study& study = study_of("density");
  const Request request = small_request();
  std::vector<StudyRun> runs;
  for (const RunSpec& spec : study.plan(request)) {
    const double visible = 2.0 * std::stod(spec.label("density"));
    StudyRun run = test::even_run("a", spec.seed, 20, Vec3::Zero(), 1e-4 * std::pow(visible, 1.3));
    run.spec = spec;
    for (TraceStep& step : run.trace.steps) step.visible = static_cast<std::uint32_t>(visible);
    runs.push_back(std::move(run));
  }
  const auto row = finding(study.conclude(runs, request), "exponent of time over visible points");
  ASSERT_EQ(row.size(), 3u);
  EXPECT_NEAR(row[0], 1.3, 1e-9);
}

TEST(Stationary, FindsTheExponentOfTheError) {
  const Study& study = study_of("stationary");
  const Request request = small_request();
  std::vector<StudyRun> runs;
  for (const RunSpec& spec : study.plan(request)) {
    StudyRun run = test::even_run("a", spec.seed, 400, Vec3::Zero(), 1.0);
    run.spec = spec;
    for (std::uint32_t i = 2; i <= 400; i += 2)
      run.trace.samples.push_back({.iterations = i, .rmse_aligned_m = 0.1 / std::sqrt(i)});
    runs.push_back(std::move(run));
  }
  const auto row = finding(study.conclude(runs, request), "exponent of landmark RMSE over iterations");
  ASSERT_EQ(row.size(), 3u);
  EXPECT_NEAR(row[0], -0.5, 1e-9);
}

TEST(FortyLoops, FindsTheFloorAndTheLateDrift) {
  const Study& study = study_of("forty-loops");
  Request request = small_request();
  std::vector<StudyRun> runs;
  for (const RunSpec& spec : study.plan(request)) {
    constexpr std::uint32_t kSteps = 760;
    StudyRun run = test::even_run("a", spec.seed, spec.iterations(), Vec3::Zero(), 1.0);
    run.spec = spec;
    for (std::size_t i = 0; i < run.trace.steps.size(); ++i) {
      const double round = static_cast<double>(i / kSteps);
      const double drift = spec.seed == 1 ? 0.001 : 0.003;  // a loop
      *run.trace.steps[i].estimate += Vec3(0.5, drift * round, 0.0);
    }
    for (std::uint32_t k = 1; k <= 4; ++k)
      run.trace.samples.push_back(
          {.iterations = k * kSteps, .rmse_aligned_m = std::hypot(0.01 / std::sqrt(k), 0.002)});
    runs.push_back(std::move(run));
  }
  const Outcome outcome = study.conclude(runs, request);
  EXPECT_NEAR(finding(outcome, "landmark RMSE of one loop, falling as 1/sqrt(loops)").at(0), 0.01, 1e-9);
  EXPECT_NEAR(finding(outcome, "floor of landmark RMSE").at(0), 0.002, 1e-9);
  EXPECT_NEAR(finding(outcome, "change of mean x error over the last 2 loops").at(0), 0.0, 1e-12);
  const auto y = finding(outcome, "change of mean y error over the last 2 loops");
  ASSERT_EQ(y.size(), 3u);
  EXPECT_NEAR(y[0], 0.004, 1e-9);  // of 2 and 6 mm
  EXPECT_NEAR(y[2] - y[0], 12.7062 * 0.002, 1e-6);
}

TEST(MapSize, ComparesTimesAtEqualNumbersOfPoints) {
  const Study& study = study_of("map-size");
  const Request request = small_request();
  std::vector<StudyRun> runs;
  for (const RunSpec& spec : study.plan(request)) {
    StudyRun run = test::even_run("a", spec.seed, 1000, Vec3::Zero(), 1.0);
    run.spec = spec;
    for (std::size_t i = 0; i < 1000; ++i) {
      TraceStep& step = run.trace.steps[i];
      // Late iterations see more points and take longer for that, and a tenth longer for the map.
      step.visible = i < 500 ? (i % 2 == 0 ? 20 : 40) : (i % 4 == 0 ? 20 : 40);
      step.cpu_ms = step.visible * (i < 500 ? 1.0 : 1.1);
    }
    runs.push_back(std::move(run));
  }
  const auto row = finding(study.conclude(runs, request),
                           "time of the ninth tenth over the second, at equal visible points");
  ASSERT_EQ(row.size(), 1u);
  EXPECT_NEAR(row[0], 1.1, 1e-12);
}

TEST(Binning, CountsWhatTheBinningSays) {
  const Study& study = study_of("binning");
  Request request = small_request();
  // Compares all pairs; those that deviate little from the first point are its bin.
  request.bin_points = [](std::size_t points, bool,
                          const std::function<double(std::uint32_t, std::uint32_t)>& deviation) {
    std::size_t largest = 0;
    for (std::uint32_t i = 0; i < points; ++i) {
      std::size_t near = 1;
      for (std::uint32_t k = 0; k < points; ++k) near += k != i && deviation(i, k) < 0.1 ? 1u : 0u;
      largest = std::max(largest, near);
    }
    return BinCount{points * (points - 1) / 2, largest};
  };
  std::vector<StudyRun> runs;
  for (const RunSpec& spec : study.plan(request)) {
    runs.push_back(
        test::even_run("a", spec.seed, 20, Vec3::Zero(), spec.label("moving") == "3 %" ? 1.02 : 1.0));
    runs.back().spec = spec;
  }
  const Outcome outcome = study.conclude(runs, request);
  EXPECT_NEAR(finding(outcome, "time with 3 % moving landmarks over that without").at(0), 1.02, 1e-12);
  const auto table = std::find_if(outcome.tables.begin(), outcome.tables.end(),
                                  [](const Table& one) { return one.file == "binning"; });
  ASSERT_NE(table, outcome.tables.end());
  for (const auto& row : table->rows) {
    const double percent = std::get<double>(row[0]), grouped = std::get<double>(row[1]),
                 n = std::get<double>(row[3]);
    EXPECT_EQ(std::get<double>(row[4]), n * (n - 1) / 2);
    const double standing = n - std::round(n * percent / 100) - 4 * std::round(n * grouped / 100);
    if (percent <= 50) {
      EXPECT_EQ(std::get<double>(row[5]), standing) << percent << " % of " << n;
    }
  }
  request.bin_points = nullptr;
  EXPECT_LT(study.conclude(runs, request).tables.size(), outcome.tables.size());
}

TEST(Outcome, TablesHaveARowForEachRunAndNoTimesButWhereTheySaySo) {
  std::vector<StudyRun> runs{test::even_run("a", 1, 20, {0.1, 0.0, 0.0}, 1.0),
                             test::even_run("a", 2, 20, {0.1, 0.0, 0.0}, 1.0)};
  runs[0].trace.metrics.iterations = 20;
  runs[0].trace.metrics.iteration_cpu_ms = eval::TimeSummary{1.0, 1.0, 1.0, 1.0};
  runs[0].trace.counters = {{"closes", 2.0, 4.0}, {"match_us", 5.0, 6.0}};
  runs[1].trace.failure = "crashed";
  const auto tables = common_tables(runs);
  ASSERT_EQ(tables.size(), 4u);
  const auto has = [](const Table& table, const std::string& column) {
    return std::find(table.columns.begin(), table.columns.end(), column) != table.columns.end();
  };
  EXPECT_EQ(tables[0].rows.size(), 2u);
  EXPECT_FALSE(tables[0].clock);
  EXPECT_TRUE(has(tables[0], "iterations"));
  EXPECT_TRUE(has(tables[0], "counter.closes.mean"));
  EXPECT_FALSE(has(tables[0], "iteration_cpu_ms.mean"));
  EXPECT_FALSE(has(tables[0], "counter.match_us.mean"));
  EXPECT_EQ(std::get<std::string>(tables[0].rows[1][3]), "crashed");
  EXPECT_EQ(tables[2].file, "times");
  EXPECT_TRUE(tables[2].clock && has(tables[2], "iteration_cpu_ms.mean") &&
              has(tables[2], "counter.match_us.mean"));
}

}  // namespace
}  // namespace hallway::study
