// SPDX-License-Identifier: MIT
// Batches: all combinations, what fails, what is resumed.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <map>
#include <thread>

#include "cli/batch_results.hpp"
#include "cli/small_world.hpp"
#include "support/marked_processes.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A small world with a plugin of its own and plans.
class Batch : public testing::Test {
 protected:
  Batch() {
    mark_processes();
    fs::copy_file(binary_folder() / "lib/hallway/plugins/slam_point.so", plugin());
  }
  void TearDown() override { EXPECT_EQ(lasting_processes(), std::vector<std::string>{}); }

  fs::path plugin() const { return world_.folder() / "mine.so"; }
  std::string plan(const std::string& text, const std::string& name = "plan.toml") const {
    return world_.folder().write(name, "schema = \"hallway.batch/1\"\nscenarios = [\"small.toml\"]\n" + text);
  }
  std::vector<std::string> arguments(const std::string& plan, const std::string& out = "batch") const {
    return {"batch", plan, "--quiet", "--force", "--out", world_.out(out)};
  }
  Ended batch(const std::string& plan, const std::vector<std::string>& more = {},
              const std::string& out = "batch") const {
    std::vector<std::string> all = arguments(plan, out);
    all.insert(all.end(), more.begin(), more.end());
    return hallway(all);
  }
  Json results(const std::string& out = "batch") const {
    return read_json(fs::path(world_.out(out)) / "results.json");
  }
  /// How many results a batch with --resume takes over.
  int taken_over(const std::string& plan) const {
    return Json::parse(batch(plan, {"--resume", "--json"}).out).at("reused").get<int>();
  }

  SmallWorld world_;
};

constexpr const char* kSweep = R"(steps = 30
seeds = [1, 2]

[[plugin]]
name = "slam_point"
params = { noise_m = [0.05, 0.2] }
)";

TEST_F(Batch, RunsAllCombinationsAndSaysWhatSingleRunsSay) {
  ASSERT_EQ(batch(plan(kSweep), {"--jobs", "2"}).status, 0);
  const Json all = results();
  ASSERT_EQ(all.at("cells").size(), 4u);
  ASSERT_EQ(world_.run({"--seed", "2", "--steps", "30", "--set", "slam_point.noise_m=0.2"}, "single").status,
            0);
  const Json single = read_json(fs::path(world_.out("single")) / "metrics.json");
  const Json cell = cell_of(all, "small+seed=2+noise_m=0.2");
  ASSERT_FALSE(cell.is_null()) << all.dump(1);
  EXPECT_EQ(without_times(cell.at("metrics")), without_times(single));
  const auto rows = read_csv(fs::path(world_.out("batch")) / "results.csv");
  ASSERT_EQ(rows.size(), 5u);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].size(), rows[0].size());
    EXPECT_EQ(rows[i].front(), all.at("cells").at(i - 1).at("name").get<std::string>());
  }
  EXPECT_EQ(rows[0][1], "input");
}

TEST_F(Batch, PicturesAreNamedByTheirRun) {
  ASSERT_EQ(
      batch(plan("steps = 10\n[[picture]]\nname = \"top\"\nview = \"top\"\nsize = \"200x100\"\n")).status, 0);
  EXPECT_TRUE(read_file(fs::path(world_.out("batch")) / "cells" / "small.top.png").starts_with("\x89PNG"));
}

TEST_F(Batch, OneThatFailsStopsNoOther) {
  const std::string file =
      plan("steps = 30\n[[plugin]]\nname = \"" + (binary_folder() / "tests/abi/fixtures/breaks.so").string() +
           "\"\nparams = { how = [\"segv\", \"exit\", \"nothing\"], at = 5 }\n"
           "[[plugin]]\nname = \"slam_point\"\n[[plugin]]\nname = \"nobody\"\n");
  const Ended ended = batch(file, {"--jobs", "3"});
  EXPECT_EQ(ended.status, 1) << ended.err;
  const Json all = results();
  ASSERT_EQ(all.at("cells").size(), 5u);
  EXPECT_EQ(all.at("cells").at(0).at("verdict").at("what"), "crash");
  EXPECT_EQ(all.at("cells").at(0).at("verdict").at("iteration"), 5);
  EXPECT_EQ(all.at("cells").at(1).at("verdict").at("what"), "exit");
  EXPECT_EQ(all.at("cells").at(2).at("status"), 0);
  EXPECT_EQ(all.at("cells").at(3).at("status"), 0);
  EXPECT_EQ(all.at("cells").at(4).at("status"), 4);
  EXPECT_EQ(read_csv(fs::path(world_.out("batch")) / "results.csv").size(), 6u);
}

TEST_F(Batch, AThresholdThatIsMissedIsStatus1) {
  const std::string run = "steps = 30\n[threshold]\n";
  EXPECT_EQ(batch(plan(run + "lost_iterations = { most = 30 }\niterations = { least = 30 }\n")).status, 0);
  for (const char* missed :
       {"iterations = { most = 29 }\n", "iterations = { least = 31 }\n", "no_such_number = { most = 1 }\n"}) {
    EXPECT_EQ(batch(plan(run + missed)).status, 1) << missed;
    EXPECT_EQ(results().at("violations").size(), 1u) << missed;
    EXPECT_EQ(results().at("cells").at(0).at("status"), 0);
  }
}

TEST_F(Batch, ResumeRunsAgainWhatReadsSomethingElseNow) {
  const std::string file = plan("steps = 20\nseeds = [1, 2, 3]\n[[plugin]]\nname = \"mine.so:slam_point\"\n");
  ASSERT_EQ(batch(file).status, 0);
  EXPECT_EQ(taken_over(file), 3);
  world_.folder().write("small.toml", small_scenario() + "# changed\n");
  EXPECT_EQ(taken_over(file), 0) << "the scenario";
  EXPECT_EQ(taken_over(file), 3);
  world_.folder().write("small.map", small_map() + "// changed\n");
  EXPECT_EQ(taken_over(file), 0) << "the map";
  EXPECT_EQ(taken_over(file), 3);
  std::ofstream(plugin(), std::ios::app) << "changed";
  EXPECT_EQ(taken_over(file), 0) << "the plugin";
  EXPECT_EQ(taken_over(file), 3);
  fs::remove_all(fs::path(world_.out("batch")) / "cells" / "small+seed=2");
  EXPECT_EQ(taken_over(file), 2) << "a folder that is gone";
}

TEST_F(Batch, ResumeSeesAMapOfAnotherNameAndAPluginThatTheScenarioNames) {
  world_.folder().write("other.map", small_map());
  const std::string scenario = replaced(replaced(small_scenario(), "small.map", "other.map"),
                                        "\"slam_point\"", "\"./mine.so:slam_point\"");
  world_.folder().write("small.toml", scenario);
  const std::string file = plan("steps = 20\n");
  ASSERT_EQ(batch(file).status, 0);
  EXPECT_EQ(taken_over(file), 1);
  world_.folder().write("other.map", small_map() + "// changed\n");
  EXPECT_EQ(taken_over(file), 0);
  std::ofstream(plugin(), std::ios::app) << "changed";
  EXPECT_EQ(taken_over(file), 0);
  EXPECT_EQ(taken_over(file), 1);
}

TEST_F(Batch, ResumeSeesTheRobotFileOfAScenario) {
  const std::string robot =
      "{\n\"classname\" \"worldspawn\"\n\"_hallway_robot\" \"1\"\n}\n{\n\"classname\" \"hw_body\"\n"
      "\"radius_m\" \"0.1\"\n\"bottom_m\" \"-0.1\"\n\"top_m\" \"0.1\"\n}\n";
  world_.folder().write("robot.map", robot);
  world_.folder().write("small.toml",
                        replaced(small_scenario(), "[robot]\n", "[robot]\nfile = \"robot.map\"\n"));
  const std::string file = plan("steps = 20\n");
  ASSERT_EQ(batch(file).status, 0);
  EXPECT_EQ(taken_over(file), 1);
  world_.folder().write("robot.map", robot + "// changed\n");
  EXPECT_EQ(taken_over(file), 0);
  EXPECT_EQ(taken_over(file), 1);
}

TEST_F(Batch, APluginThatEndedWhileItWasLoadedIsTriedAgain) {
  world_.folder().write(
      "small.toml",
      replaced(small_scenario(), "\"slam_point\"",
               "\"" + (binary_folder() / "tests/abi/fixtures/dies_in_call.so").string() + "\""));
  const std::string file = plan("steps = 20\n");
  ::setenv("HALLWAY_DIES_IN", "init", 1);
  ::setenv("HALLWAY_DIES_BY", "abort", 1);
  EXPECT_EQ(batch(file).status, 1);
  EXPECT_EQ(results().at("cells").at(0).at("verdict").at("call"), "init");
  ::unsetenv("HALLWAY_DIES_IN");
  ::unsetenv("HALLWAY_DIES_BY");
  EXPECT_EQ(taken_over(file), 0);
  EXPECT_EQ(results().at("cells").at(0).at("status"), 0);
  EXPECT_EQ(taken_over(file), 1);
}

/// What a batch has left, by the names of its files, without what clocks and the machine decide.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).string();
    if (!entry.is_regular_file() || name.ends_with("timing.csv")) continue;
    if (name == "results.csv") continue;  // its numbers are those of results.json
    files[name] = read_file(entry.path());
    if (!name.ends_with(".json")) continue;
    Json json = Json::parse(files[name]);
    const auto erase_times = [](Json& object) {
      for (const char* key : {"host", "wall_s", "iteration_ms", "iteration_cpu_ms"}) object.erase(key);
      if (object.contains("metrics") && object["metrics"].is_object())
        object["metrics"] = without_times(object["metrics"]);
    };
    erase_times(json);
    if (json.contains("cells")) {
      for (Json& cell : json["cells"]) erase_times(cell);
    }
    files[name] = json.dump();
  }
  return files;
}

TEST_F(Batch, OneThatWasKilledAndResumedIsLikeOneThatWasNot) {
  const std::string file =
      plan("steps = 150\nseeds = [1, 2, 3, 4, 5, 6]\n[[picture]]\nname = \"top\"\nsize = \"100x80\"\n");
  ASSERT_EQ(batch(file, {"--jobs", "2"}, "whole").status, 0);
  for (int kills = 0; kills < 3; ++kills) {
    std::vector<std::string> all = arguments(file);
    all.insert(all.begin(), hallway_program());
    all.insert(all.end(), {"--jobs", "2", "--resume"});
    Process process(all);
    // After one more result.
    const fs::path next =
        fs::path(world_.out("batch")) / "cells" / ("small+seed=" + std::to_string(kills + 1) + ".json");
    for (int i = 0; i < 12000 && !fs::exists(next); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_TRUE(fs::exists(next));
    ::kill(process.pid(), SIGKILL);
    process.wait();
    lasting_processes();  // waits for their end
  }
  ASSERT_EQ(batch(file, {"--jobs", "2", "--resume"}).status, 0);
  const auto whole = contents(world_.out("whole"));
  const auto resumed = contents(world_.out("batch"));
  ASSERT_GT(whole.size(), 60u);
  for (const auto& [name, text] : whole) {
    ASSERT_TRUE(resumed.contains(name)) << name;
    EXPECT_TRUE(resumed.at(name) == text) << name;
  }
  for (const auto& [name, text] : resumed) EXPECT_TRUE(whole.contains(name)) << name << " is left over";
}

TEST_F(Batch, WhenItIsKilledItsRunsEnd) {
  std::vector<std::string> all = arguments(plan("steps = 10000000\nseeds = [1, 2]\n"));
  all.insert(all.begin(), hallway_program());
  all.insert(all.end(), {"--jobs", "2"});
  Process process(all);
  for (int i = 0; i < 12000 && marked_processes().size() < 5; ++i)  // the batch, two runs, a plugin of each
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_GE(marked_processes().size(), 5u);
  ::kill(process.pid(), SIGKILL);
  process.wait();
  EXPECT_EQ(lasting_processes(), std::vector<std::string>{}) << "runs go on without their batch";
}

TEST_F(Batch, ACellThatCannotBeWrittenStopsNoOther) {
  fs::create_directories(fs::path(world_.out("batch")) / "cells" / "small+seed=3.json");
  std::ofstream(fs::path(world_.out("batch")) / "cells" / "small+seed=1") << "a file in the way";
  const std::string file = plan("steps = 20\nseeds = [1, 2, 3]\n");
  EXPECT_EQ(batch(file).status, 1);
  const Json all = results();
  EXPECT_EQ(cell_of(all, "small+seed=1").at("status"), 3);
  EXPECT_NE(cell_of(all, "small+seed=1").at("problem").get<std::string>().find("is not a folder"),
            std::string::npos);
  EXPECT_EQ(cell_of(all, "small+seed=2").at("status"), 0);
  EXPECT_EQ(cell_of(all, "small+seed=3").at("status"), 3) << "its result cannot be kept";
  EXPECT_FALSE(cell_of(all, "small+seed=3").at("metrics").is_null()) << "but is known";
  EXPECT_EQ(read_file(fs::path(world_.out("batch")) / "cells" / "small+seed=1"), "a file in the way");
}

TEST_F(Batch, AFullDiskIsAResultLikeAnyOther) {
  const std::string file = plan("steps = 400\nseeds = [1, 2]\n");
  // No file larger than this: what a disk that is full says of each write beyond.
  const std::string command =
      "ulimit -f 40; exec " + hallway_program() + " batch " + file + " --quiet --out " + world_.out("batch");
  const Ended ended = Process({"/bin/sh", "-c", command}).wait();
  EXPECT_EQ(ended.status, 1) << ended.err;
  const Json table = results();
  ASSERT_EQ(table.at("cells").size(), 2u);
  for (const Json& cell : table.at("cells")) {
    EXPECT_EQ(cell.at("status"), 3) << cell.dump(1);
    EXPECT_TRUE(cell.at("metrics").is_null());
  }
  EXPECT_EQ(batch(file, {"--resume"}).status, 0) << "with room again";
}

TEST_F(Batch, TwoAtOnceInOneFolderAreAClearError) {
  const std::string file = plan("steps = 10000000\nseeds = [1, 2, 3]\n");
  std::vector<std::string> all = arguments(file);
  all.insert(all.begin(), hallway_program());
  Process first(all);
  const fs::path log = fs::path(world_.out("batch")) / "cells" / "small+seed=1.log";
  for (int i = 0; i < 12000 && !fs::exists(log); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const Ended second = batch(file);
  EXPECT_EQ(second.status, 3);
  EXPECT_NE(second.err.find("another batch is at work in this folder"), std::string::npos) << second.err;
  ::kill(first.pid(), SIGINT);
  EXPECT_EQ(first.wait().status, 130);
}

TEST_F(Batch, APlanThatIsWrongNamesItsLine) {
  for (const auto& [text, said] : std::vector<std::pair<std::string, std::string>>{
           {"sceds = [1]\n", "plan.toml:3: unknown key \"sceds\""}, {"seeds = [\"x\"]\n", "plan.toml:3"}}) {
    const Ended ended = batch(plan(text));
    EXPECT_EQ(ended.status, 3);
    EXPECT_NE(ended.err.find(said), std::string::npos) << ended.err;
  }
  EXPECT_EQ(batch(world_.folder() / "none.toml").status, 3);
  EXPECT_FALSE(fs::exists(world_.out("batch")));
}

}  // namespace
}  // namespace hallway::test
