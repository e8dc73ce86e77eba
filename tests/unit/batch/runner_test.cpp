// SPDX-License-Identifier: MIT
//
// The runner with a program of its own in the place of `hallway`: a shell script that does what its arguments say.
#include "batch/runner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "base/error.hpp"
#include "base/file.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"

namespace hallway::batch {
namespace {

namespace fs = std::filesystem;

class RunnerTest : public testing::Test {
 protected:
  RunnerTest() {
    // run WORD ... --out DIR: writes a run folder with the word's length as its metric, and counts its calls.
    program_ = folder_.write("program.sh", R"(#!/bin/sh
echo "$2" >> ")" + (folder_ / "calls").string() +
                                               R"("
while [ $# -gt 0 ]; do [ "$1" = --out ] && out=$2; [ -z "$word" ] && [ "$1" != run ] && word=$1; shift; done
case $word in
  fails) echo "hallway: some reason" >&2; exit 5;;
  dies) kill -9 $$;;
  sleeps) sleep 60;;
esac
mkdir -p "$out"
echo "{\"length\": ${#word}}" > "$out/metrics.json"
echo '{"command": "run", "inputs": [], "settings": [], "plugins": [], "host": {"plugin_files": []}, "verdict": null}' > "$out/run.json"
)");
    fs::permissions(program_, fs::perms::owner_all);
  }

  static Plan plan_of(const std::vector<std::string>& words) {
    Plan plan;
    for (const std::string& word : words)
      plan.cells.push_back({.name = "cell_" + word, .labels = {{"word", word}}, .arguments = {"run", word}});
    return plan;
  }

  RunnerSetup setup(unsigned jobs = 2, bool resume = false) const {
    return {.program = program_, .folder = folder_ / "batch", .jobs = jobs, .resume = resume};
  }

  std::size_t calls() const {
    std::ifstream file(folder_ / "calls");
    return static_cast<std::size_t>(std::count(std::istreambuf_iterator<char>(file), {}, '\n'));
  }

  test::TempFolder folder_;
  fs::path program_;
};

TEST_F(RunnerTest, OneThatFailsStopsNoOther) {
  const auto results = run_cells(plan_of({"aa", "fails", "bbb", "dies", "c"}), setup());
  ASSERT_EQ(results.size(), 5u);
  EXPECT_EQ(results[0].metrics["length"], 2);
  EXPECT_EQ(results[1].status, 5);
  EXPECT_EQ(results[1].problem, "some reason");
  EXPECT_TRUE(results[1].metrics.is_null());
  EXPECT_EQ(results[2].metrics["length"], 3);
  EXPECT_EQ(results[3].status, 128 + 9);
  EXPECT_EQ(results[4].metrics["length"], 1);
  EXPECT_TRUE(results[4].good());
}

TEST_F(RunnerTest, ResultsAreInTheOrderOfThePlanForAnyNumberOfJobs) {
  std::vector<std::string> words;
  for (std::size_t i = 1; i <= 12; ++i) words.emplace_back(i, 'x');
  for (const unsigned jobs : {1u, 3u, 20u}) {
    const auto results = run_cells(plan_of(words), setup(jobs));
    ASSERT_EQ(results.size(), words.size());
    for (std::size_t i = 0; i < words.size(); ++i) EXPECT_EQ(results[i].metrics["length"], i + 1);
  }
}

TEST_F(RunnerTest, ResumeRunsOnlyWhatIsNewOrChanged) {
  Plan plan = plan_of({"a", "fails", "dies"});
  const fs::path input = folder_.write("input.csv", "1");
  plan.cells[0].inputs = {input};
  run_cells(plan, setup());
  EXPECT_EQ(calls(), 3u);
  plan.cells.push_back({.name = "new", .arguments = {"run", "new"}});
  auto results = run_cells(plan, setup(2, true));
  EXPECT_EQ(calls(), 6u);  // the new one, the one that was killed, and the one that does not say what it read
  EXPECT_TRUE(results[0].reused);
  EXPECT_EQ(results[0].metrics["length"], 1);
  EXPECT_EQ(results[1].status, 5);
  EXPECT_FALSE(results[3].reused);
  folder_.write("input.csv", "2");
  results = run_cells(plan, setup(2, true));
  EXPECT_EQ(calls(), 9u);  // what reads the input, and those two again
  EXPECT_FALSE(results[0].reused);
  run_cells(plan, setup(2, false));
  EXPECT_EQ(calls(), 13u);
  fs::remove_all(folder_ / "batch" / "cells" / "cell_a");
  run_cells(plan, setup(2, true));
  EXPECT_EQ(calls(), 16u) << "its folder is gone";
  plan.pictures.push_back({.name = "top", .arguments = {}});
  EXPECT_FALSE(run_cells(plan, setup(2, true))[0].reused) << "its picture is missing";
}

TEST_F(RunnerTest, WhatAnEarlierBatchLeftIsNotTakenForAResult) {
  fs::create_directories(folder_ / "batch" / "cells" / "cell_fails");
  folder_.write("batch/cells/cell_fails/run.json", R"({"verdict": {"what": "crash"}})");
  folder_.write("batch/cells/cell_fails/metrics.json", R"({"length": 7})");
  fs::create_directories(folder_ / "batch" / "cells" / "cell_fails.part-123");
  fs::create_directories(folder_ / "batch" / "cells" / "somebody.part-else");
  const std::vector<std::string> unfinished{"cell_fails.json.tmp-123", "cell_fails.top.png.tmp-7"};
  const std::vector<std::string> foreign{"cell_fails.json.tmp-", "cell_fails.txt.tmp-7",
                                         "another.json.tmp-7"};
  for (const auto& names : {unfinished, foreign})
    for (const std::string& name : names) folder_.write("batch/cells/" + name, "begun");
  folder_.write("batch/results.json.tmp-5", "begun");
  folder_.write("batch/notes.json.tmp-5", "begun");
  Plan plan = plan_of({"fails"});
  plan.pictures.push_back({.name = "top", .arguments = {}});
  const auto results = run_cells(plan, setup());
  EXPECT_TRUE(results[0].metrics.is_null());
  EXPECT_TRUE(results[0].verdict.is_null());
  EXPECT_FALSE(fs::exists(folder_ / "batch" / "cells" / "cell_fails.part-123"));
  EXPECT_TRUE(fs::exists(folder_ / "batch" / "cells" / "somebody.part-else"));
  EXPECT_FALSE(fs::exists(folder_ / "batch" / "results.json.tmp-5"));
  EXPECT_TRUE(fs::exists(folder_ / "batch" / "notes.json.tmp-5"));
  for (const std::string& name : unfinished)
    EXPECT_FALSE(fs::exists(folder_ / "batch" / "cells" / name)) << name;
  for (const std::string& name : foreign) EXPECT_TRUE(fs::exists(folder_ / "batch" / "cells" / name)) << name;
}

TEST_F(RunnerTest, ReplacingRemovesTheRunsOfAnotherPlan) {
  run_cells(plan_of({"a", "b"}), setup());
  folder_.write("batch/results.json", "{}");
  folder_.write("batch/notes.txt", "mine");
  RunnerSetup replacing = setup();
  replacing.replace = true;
  run_cells(plan_of({"c"}), replacing);
  EXPECT_FALSE(fs::exists(folder_ / "batch" / "cells" / "cell_a.json"));
  EXPECT_TRUE(fs::exists(folder_ / "batch" / "cells" / "cell_c.json"));
  EXPECT_FALSE(fs::exists(folder_ / "batch" / "results.json")) << "the table of another plan";
  EXPECT_TRUE(fs::exists(folder_ / "batch" / "notes.txt"));
}

TEST_F(RunnerTest, IsStoppedWithWhatIsDone) {
  RunnerSetup stopping = setup(1);
  std::size_t done = 0;
  stopping.progress = [&](std::size_t count) { done = count; };
  stopping.stop = [&] { return done == 2; };
  const auto results = run_cells(plan_of({"a", "bb", "sleeps", "c"}), stopping);
  EXPECT_EQ(results.size(), 2u);
}

TEST_F(RunnerTest, TwoInOneFolderAreAConflict) {
  RunnerSetup outer = setup(1);
  std::optional<Error> conflict;
  outer.progress = [&](std::size_t) {
    conflict = test::error_of([&] { run_cells(plan_of({"b"}), setup(1)); });
  };
  run_cells(plan_of({"a"}), outer);
  ASSERT_TRUE(conflict);
  EXPECT_EQ(conflict->code(), ErrorCode::kIo);
  EXPECT_NE(conflict->message().find("another batch"), std::string::npos);
}

}  // namespace
}  // namespace hallway::batch
