// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "cli/small_world.hpp"
#include "log/byte_io.hpp"
#include "log/run_log.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// A run of the small world, made once for all tests.
class Log : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    world_ = new SmallWorld;
    const Ended ended = world_->run({"--quiet"});
    ASSERT_EQ(ended.status, 0) << ended.err;
  }
  static void TearDownTestSuite() {
    delete world_;
    world_ = nullptr;
  }
  static fs::path run_folder() { return world_->out(); }
  static std::string log() { return run_folder() / "run.mcap"; }

  std::string path(const std::string& name) const { return folder_ / name; }
  static Json info(const std::string& file) {
    return Json::parse(hallway({"log", "info", file, "--json"}).out);
  }
  static std::uint64_t messages(const Json& info, const std::string& topic) {
    for (const Json& channel : info.at("channels")) {
      if (channel.at("topic") == topic) return channel.at("messages").get<std::uint64_t>();
    }
    return 0;
  }
  static void expect_same(const fs::path& a, const fs::path& b, const std::vector<std::string>& names) {
    for (const std::string& name : names)
      EXPECT_TRUE(read_file(a / name) == read_file(b / name)) << name << " differs";
  }

  static SmallWorld* world_;
  TempFolder folder_;
};

SmallWorld* Log::world_ = nullptr;

const std::vector<std::string> kAnswers{"trajectory.tum",  "landmarks.csv",      "landmarks.ply",
                                        "submaps.csv",     "matches.csv",        "truth.tum",
                                        "truth_poses.csv", "truth_landmarks.csv"};

TEST_F(Log, InfoSaysWhatIsInARunsLog) {
  const Json facts = info(log());
  EXPECT_EQ(facts.at("status"), 0);
  EXPECT_TRUE(facts.at("damage").is_null());
  for (const char* topic : {"/hallway/frame", "/hallway/truth/pose", "/hallway/truth/identities",
                            "/hallway/output/pose", "/hallway/output/associations"}) {
    EXPECT_EQ(messages(facts, topic), 60u) << topic;
  }
  for (const char* topic : {"/hallway/activation", "/hallway/truth/landmarks", "/hallway/output/map"}) {
    EXPECT_EQ(messages(facts, topic), 1u) << topic;
  }
  EXPECT_EQ(facts.at("metadata"), Json::array({"hallway.run"}));
  EXPECT_GE(facts.at("chunks").get<int>(), 6) << "6 s of driving";
  const Ended text = hallway({"log", "info", run_folder()});
  EXPECT_EQ(text.status, 0);
  EXPECT_NE(text.out.find("/hallway/frame"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("0.000000000 s to 5.900000000 s"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("damage       none"), std::string::npos) << text.out;
}

/// The points of an iteration in observations.csv.
Json points_in_table(const std::string& table, std::uint64_t iteration) {
  Json points = Json::array();
  std::istringstream lines(table);
  std::string line;
  for (std::getline(lines, line); std::getline(lines, line);) {
    std::vector<double> row;
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) row.push_back(std::stod(field));
    if (row.at(0) == static_cast<double>(iteration)) points.push_back({row.at(2), row.at(3), row.at(4)});
  }
  return points;
}

TEST_F(Log, InfoCountsTheSamplesOfEachSensor) {
  const Json sensors = info(log()).at("sensors");
  const std::string table = read_file(run_folder() / "observations.csv");
  const auto rows = std::count(table.begin(), table.end(), '\n') - 1;
  EXPECT_EQ(sensors,
            Json::parse(R"([{"id": 0, "name": "eyes", "kind": "points", "samples": 60, "elements": )" +
                        std::to_string(rows) + R"(, "first_ns": 0, "last_ns": 5900000000}])"));
  EXPECT_EQ(info(log()).at("warnings"), Json::array());
  const std::string text = hallway({"log", "info", run_folder()}).out;
  EXPECT_NE(text.find("  sensors      1\n    0 eyes "), std::string::npos) << text;
  EXPECT_NE(text.find("60  points  " + std::to_string(rows) + " elements  0.000000000 s to 5.900000000 s\n"),
            std::string::npos)
      << text;
}

TEST_F(Log, FrameIsPrintedAsItIs) {
  const Ended ended = hallway({"log", "frame", run_folder(), "12"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(ended.err, "");
  EXPECT_TRUE(ended.out.ends_with("}\n"));
  const Json frame = Json::parse(ended.out);
  EXPECT_EQ(frame.at("sequence"), 12);
  EXPECT_EQ(frame.at("t_ns"), 1'200'000'000);
  ASSERT_EQ(frame.at("samples").size(), 1u);
  const Json& sample = frame.at("samples").front();
  EXPECT_EQ(sample.at("sensor"), 0);
  EXPECT_EQ(sample.at("kind"), "points");
  EXPECT_EQ(sample.at("sequence"), 12);
  EXPECT_EQ(sample.at("t_end_ns"), 1'200'000'000);
  const Json expected = points_in_table(read_file(run_folder() / "observations.csv"), 12);
  ASSERT_FALSE(expected.empty());
  EXPECT_EQ(sample.at("payload").at("points"), expected);

  const Ended document = hallway({"log", "frame", log(), "12", "--json"});
  EXPECT_EQ(document.status, 0);
  EXPECT_NE(document.out.find(R"("frame":)" + ended.out.substr(0, ended.out.size() - 1) + ","),
            std::string::npos)
      << "the same text";
  EXPECT_EQ(Json::parse(document.out).at("schema"), "hallway.log_frame/1");
  EXPECT_EQ(Json::parse(document.out).at("passed_over"), Json::array());
}

TEST_F(Log, FrameOfASensorByItsNameOrId) {
  const std::string all = hallway({"log", "frame", log(), "12"}).out;
  for (const char* eyes : {"eyes", "0"})
    EXPECT_EQ(hallway({"log", "frame", log(), "12", "--sensor", eyes}).out, all);
  for (const char* none : {"nose", "1", "eye"}) {
    const Ended ended = hallway({"log", "frame", log(), "12", "--sensor", none});
    EXPECT_EQ(ended.status, 2) << none;
    EXPECT_NE(ended.err.find("0 (eyes)"), std::string::npos) << ended.err;
  }
}

TEST_F(Log, FrameThatThereIsNot) {
  const Ended ended = hallway({"log", "frame", log(), "60"});
  EXPECT_EQ(ended.status, 1);
  EXPECT_EQ(ended.out, "");
  EXPECT_NE(ended.err.find("run.mcap: holds no frame 60; its 60 frames are of the iterations 0 to 59"),
            std::string::npos)
      << ended.err;
  const Json document = Json::parse(hallway({"log", "frame", log(), "60", "--json"}).out);
  EXPECT_EQ(document.at("status"), 1);
  EXPECT_TRUE(document.at("frame").is_null());
  for (const char* wrong : {"-1", "x", "4294967296"})
    EXPECT_EQ(hallway({"log", "frame", log(), wrong}).status, 2) << wrong;
  // A part of a log keeps the numbers.
  ASSERT_EQ(hallway({"log", "cut", log(), "--from-iteration", "10", "--to-iteration", "29", "--out",
                     path("part.mcap")})
                .status,
            0);
  EXPECT_EQ(hallway({"log", "frame", path("part.mcap"), "12"}).out,
            hallway({"log", "frame", log(), "12"}).out);
  const Ended before = hallway({"log", "frame", path("part.mcap"), "9"});
  EXPECT_EQ(before.status, 1);
  EXPECT_NE(before.err.find("its 20 frames are of the iterations 10 to 29"), std::string::npos) << before.err;
}

TEST_F(Log, FrameOfADamagedLogIsThereUpToTheDamage) {
  const std::string whole = read_file(log());
  const std::string cut = folder_.write("cut.mcap", whole.substr(0, whole.size() * 6 / 10));
  EXPECT_EQ(hallway({"log", "frame", cut, "3"}).out, hallway({"log", "frame", log(), "3"}).out);
  const Ended lost = hallway({"log", "frame", cut, "59"});
  EXPECT_EQ(lost.status, 1);
  EXPECT_NE(lost.err.find("holds no frame 59 before the damage at byte "), std::string::npos) << lost.err;
  const Json facts = info(cut);
  EXPECT_EQ(facts.at("sensors").front().at("samples"), messages(facts, "/hallway/frame"));
}

TEST_F(Log, FramesThatCannotBeReadAreToldAndNothingWorse) {
  hallway::log::StringOutput output;
  hallway::log::RunLogWriter writer(output, "a test", "{}");
  writer.add_activation(R"({"sensors": [{"id": 0}]})");
  writer.add_frame({0, 0}, "no frame");
  writer.add_frame({1, 1}, "none either");
  writer.finish();
  const std::string file = folder_.write("wrong.mcap", output.text());
  const Ended told = hallway({"log", "info", file, "--json"});
  EXPECT_EQ(told.status, 0) << "the file is not damaged";
  const Json facts = Json::parse(told.out);
  EXPECT_EQ(facts.at("sensors"), Json::array());
  ASSERT_EQ(facts.at("warnings").size(), 2u) << told.out;
  EXPECT_NE(told.err.find("the description of the sensors cannot be read"), std::string::npos) << told.err;
  EXPECT_NE(told.err.find("wrong.mcap: 2 frames cannot be read; the first: "), std::string::npos) << told.err;
  const Ended frame = hallway({"log", "frame", file, "0"});
  EXPECT_EQ(frame.status, 3);
  EXPECT_NE(frame.err.find("wrong.mcap"), std::string::npos) << frame.err;
  EXPECT_NE(frame.err.find("frame, byte 0"), std::string::npos) << frame.err;
}

TEST_F(Log, FrameOfALogWithoutFramesIsAnError) {
  hallway::log::StringOutput output;
  hallway::log::RunLogWriter writer(output, "a test", "{}");
  writer.finish();
  const std::string file = folder_.write("empty.mcap", output.text());
  const Ended frame = hallway({"log", "frame", file, "0"});
  EXPECT_EQ(frame.status, 3);
  EXPECT_NE(frame.err.find("empty.mcap: holds no frames of Hallway"), std::string::npos) << frame.err;
  EXPECT_EQ(info(file).at("sensors"), Json::array());
}

TEST_F(Log, ReplayGivesTheSameAnswersAsTheRun) {
  const Ended ended = hallway({"replay", log(), "--quiet", "--out", path("again")});
  ASSERT_EQ(ended.status, 0) << ended.err;
  expect_same(run_folder(), path("again"), kAnswers);
  // The replay's own log gives them once more, and says the same as the log it was made from.
  ASSERT_EQ(hallway({"replay", path("again"), "--quiet", "--out", path("third")}).status, 0);
  expect_same(run_folder(), path("third"), kAnswers);
  EXPECT_EQ(info(log()).at("channels"), info(path("again")).at("channels"));
}

TEST_F(Log, SameRunSameBytes) {
  ASSERT_EQ(world_->run({"--quiet", "--threads", "3"}, "second").status, 0);
  expect_same(run_folder(), world_->out("second"), {"run.mcap"});
}

TEST_F(Log, ALogCutAnywhereIsReplayedUpToTheDamageAndRecovered) {
  const std::string whole = read_file(log());
  std::uint64_t frames = 0;
  for (const double share : {0.4, 0.6, 0.8, 0.999}) {
    const auto size = static_cast<std::size_t>(share * static_cast<double>(whole.size()));
    const std::string cut = folder_.write("cut.mcap", whole.substr(0, size));
    const Ended told = hallway({"log", "info", cut});
    EXPECT_EQ(told.status, 1);
    EXPECT_NE(told.out.find("of " + std::to_string(size)), std::string::npos) << told.out;
    const Ended mended = hallway({"log", "recover", cut, "--force"});
    ASSERT_EQ(mended.status, 0) << mended.err;
    EXPECT_NE(mended.err.find("what stands before it is kept"), std::string::npos) << mended.err;
    const Json facts = info(path("cut.recovered.mcap"));
    EXPECT_TRUE(facts.at("damage").is_null());
    EXPECT_GT(messages(facts, "/hallway/frame"), frames);
    frames = messages(facts, "/hallway/frame");
    EXPECT_EQ(messages(facts, "/hallway/truth/identities"), frames) << "a moment is kept whole";
    for (const std::string& file : {cut, path("cut.recovered.mcap")}) {
      const Ended replayed = hallway({"replay", file, "--quiet", "--force", "--out", path("part")});
      EXPECT_EQ(replayed.status, 0) << replayed.err;
      EXPECT_EQ(replayed.err.find("kept what stands before") != std::string::npos, file == cut)
          << replayed.err;
      const std::string poses = read_file(fs::path(path("part")) / "trajectory.tum");
      EXPECT_TRUE(read_file(run_folder() / "trajectory.tum").starts_with(poses));
      EXPECT_EQ(Json::parse(read_file(fs::path(path("part")) / "run.json")).at("iterations"), frames);
    }
  }
}

TEST_F(Log, CutTakesASpanOfIterationsOrOfTime) {
  ASSERT_EQ(hallway({"log", "cut", log(), "--from-iteration", "10", "--to-iteration", "29", "--out",
                     path("a.mcap")})
                .status,
            0);
  ASSERT_EQ(hallway({"log", "cut", log(), "--from", "1", "--to", "2.9", "--out", path("b.mcap")}).status, 0);
  EXPECT_TRUE(read_file(path("a.mcap")) == read_file(path("b.mcap"))) << "frames lie 0.1 s apart";
  const Json facts = info(path("a.mcap"));
  EXPECT_EQ(messages(facts, "/hallway/frame"), 20u);
  EXPECT_EQ(messages(facts, "/hallway/truth/landmarks"), 1u) << "of the whole log";
  EXPECT_EQ(messages(facts, "/hallway/activation"), 1u);
  EXPECT_EQ(messages(facts, "/hallway/output/map"), 0u);
  const Ended replayed = hallway({"replay", path("a.mcap"), "--quiet", "--out", path("part")});
  ASSERT_EQ(replayed.status, 0) << replayed.err;
  EXPECT_EQ(Json::parse(read_file(fs::path(path("part")) / "run.json")).at("iterations"), 20);
  // All of it is a copy that says the same.
  ASSERT_EQ(hallway({"log", "cut", log(), "--from", "0", "--out", path("all.mcap")}).status, 0);
  EXPECT_EQ(info(path("all.mcap")).at("channels"), info(log()).at("channels"));
}

TEST_F(Log, CutRefusesWhatMakesNoSense) {
  EXPECT_EQ(hallway({"log", "cut", log(), "--out", path("a.mcap")}).status, 2);
  EXPECT_EQ(
      hallway({"log", "cut", log(), "--from", "1", "--to-iteration", "3", "--out", path("a.mcap")}).status,
      2);
  EXPECT_EQ(hallway({"log", "cut", log(), "--from", "3", "--to", "1", "--out", path("a.mcap")}).status, 2);
  EXPECT_EQ(hallway({"log", "cut", log(), "--from-iteration", "70", "--out", path("a.mcap")}).status, 3);
  folder_.write("a.mcap", "mine");
  EXPECT_EQ(hallway({"log", "cut", log(), "--from", "1", "--out", path("a.mcap")}).status, 3);
  EXPECT_EQ(read_file(path("a.mcap")), "mine");
}

TEST_F(Log, ConvertToCsvAndBackLosesNothingThatReplayNeeds) {
  const Ended to_csv = hallway({"log", "convert", log(), "--out", path("csv")});
  ASSERT_EQ(to_csv.status, 0) << to_csv.err;
  EXPECT_EQ(to_csv.err, "");
  expect_same(run_folder(), path("csv"), {"observations.csv", "truth_poses.csv", "truth_landmarks.csv"});
  ASSERT_EQ(hallway({"log", "convert", path("csv"), "--out", path("back.mcap")}).status, 0);
  for (const std::string& from : {path("csv"), path("back.mcap")}) {
    const Ended ended = hallway({"replay", from, "--quiet", "--force", "--out", path("again")});
    ASSERT_EQ(ended.status, 0) << ended.err;
    expect_same(run_folder(), path("again"), kAnswers);
  }
}

TEST_F(Log, ConvertTakesAnyObservations) {
  const std::string csv = folder_.write("obs.csv", "iteration,x,y,z\n0,1,2,3\n3,4,5,6\n");
  const Ended ended = hallway({"log", "convert", csv, "--period", "0.5", "--out", path("a.mcap"), "--json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(Json::parse(ended.out).at("frames"), 4);
  const Json facts = info(path("a.mcap"));
  EXPECT_EQ(messages(facts, "/hallway/frame"), 4u) << "two of them without points";
  EXPECT_EQ(messages(facts, "/hallway/truth/identities"), 0u);
  EXPECT_EQ(hallway({"replay", path("a.mcap"), "--out", path("run")}).status, 2) << "nobody names a plugin";
  EXPECT_EQ(
      hallway({"replay", path("a.mcap"), "--plugin", "slam_point", "--quiet", "--out", path("run")}).status,
      0);
}

TEST_F(Log, ALogNamesPluginsByTheirIdAlone) {
  fs::copy(run_folder(), path("other"));
  const std::string manifest = read_file(fs::path(path("other")) / "run.json");
  const std::string hostile = replaced(manifest, "\"id\": \"slam_point\"", "\"id\": \"./slam_point.so\"");
  ASSERT_NE(hostile, manifest);
  write_file_atomically(fs::path(path("other")) / "run.json", hostile);
  ASSERT_EQ(hallway({"log", "convert", path("other"), "--out", path("other.mcap")}).status, 0);
  for (const std::string& log : {path("other"), path("other.mcap")}) {
    const Ended ended = hallway({"replay", log, "--quiet", "--out", path("run")});
    EXPECT_EQ(ended.status, 3);
    EXPECT_NE(ended.err.find("which is no id"), std::string::npos) << ended.err;
    EXPECT_EQ(hallway({"replay", log, "--plugin", "slam_point", "--quiet", "--force", "--out", path("ours")})
                  .status,
              0);
  }
}

TEST_F(Log, WhatIsNoLogIsAnErrorWithItsName) {
  for (const std::string content : {"", "x", "iteration,x,y,z\n"}) {
    const std::string file = folder_.write("no.mcap", content);
    for (const char* command : {"info", "recover"}) {
      const Ended ended = hallway({"log", command, file});
      EXPECT_EQ(ended.status, 3);
      EXPECT_NE(ended.err.find("no.mcap"), std::string::npos) << ended.err;
    }
    const Ended frame = hallway({"log", "frame", file, "0"});
    EXPECT_EQ(frame.status, 3);
    EXPECT_NE(frame.err.find("no.mcap"), std::string::npos) << frame.err;
    EXPECT_EQ(hallway({"replay", file, "--plugin", "slam_point", "--out", path("run")}).status, 3);
    EXPECT_FALSE(fs::exists(path("run")));
    EXPECT_FALSE(fs::exists(path("no.recovered.mcap")));
  }
  EXPECT_EQ(hallway({"log", "info", path("missing.mcap")}).status, 3);
  EXPECT_EQ(hallway({"log", "info", folder_.path()}).status, 3);
}

TEST_F(Log, ARunThatIsKilledLeavesALogThatCanBeRecovered) {
  const fs::path out = path("killed");
  Process process(
      {hallway_program(), "run", world_->scenario(), "--steps", "2000000", "--quiet", "--out", out});
  const fs::path log = out.string() + ".part-" + std::to_string(process.pid()) + "/run.mcap";
  std::error_code code;
  for (int i = 0; i < 6000; ++i) {
    const std::uintmax_t size = fs::file_size(log, code);
    if (!code && size > 200'000) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ::kill(process.pid(), SIGKILL);
  EXPECT_EQ(process.wait().status, 128 + SIGKILL);
  EXPECT_FALSE(fs::exists(out));
  const Ended ended = hallway({"log", "recover", log.parent_path(), "--out", path("mended.mcap")});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const Json facts = info(path("mended.mcap"));
  EXPECT_TRUE(facts.at("damage").is_null());
  EXPECT_GT(messages(facts, "/hallway/frame"), 10u);
  EXPECT_EQ(hallway({"replay", path("mended.mcap"), "--quiet", "--out", path("run")}).status, 0);
}

TEST_F(Log, TheFrameThatKilledARunInItsOwnProcessIsTheLastOneInItsLog) {
  for (const std::string how : {"segv", "_exit", "exit"}) {
    const fs::path out = path("killed-" + how);
    Process process({hallway_program(), "run", world_->scenario(), "--in-process", "--plugin",
                     binary_folder() / "tests/abi/fixtures/breaks.so", "--set", "breaks.how=" + how, "--set",
                     "breaks.at=17", "--quiet", "--out", out});
    const fs::path left = out.string() + ".part-" + std::to_string(process.pid());
    const int status = process.wait().status;
    EXPECT_TRUE(how == "segv" ? status == 128 + SIGSEGV || status == 1 : status == (how == "exit" ? 0 : 7))
        << status;
    EXPECT_FALSE(fs::exists(out));
    const std::string mended = path(how + ".mcap");
    ASSERT_EQ(hallway({"log", "recover", left, "--out", mended}).status, 0);
    const Json facts = info(mended);
    EXPECT_TRUE(facts.at("damage").is_null());
    EXPECT_EQ(messages(facts, "/hallway/frame"), 18u) << "17 and the deadly one";
    EXPECT_EQ(messages(facts, "/hallway/truth/identities"), 18u);
    EXPECT_EQ(messages(facts, "/hallway/output/pose"), 17u);
    EXPECT_EQ(messages(info(left), "/hallway/frame"), 18u) << "info reads what was kept, too";
    for (const std::string& log :
         {mended, left.string()}) {  // and it kills again, where that can be looked at
      const Ended ended =
          hallway({"replay", log, "--plugin", binary_folder() / "tests/abi/fixtures/breaks.so", "--set",
                   "how=" + how, "--set", "at=17", "--force", "--out", path("again")});
      EXPECT_EQ(ended.status, 5) << ended.err;
      EXPECT_EQ(Json::parse(read_file(fs::path(path("again")) / "run.json")).at("verdict").at("iteration"),
                17);
    }
  }
}

TEST_F(Log, NoCommandReplacesWhatItReads) {
  const std::string before = read_file(run_folder() / "metrics.json"), bytes = read_file(log());
  const std::string folder = run_folder().string();
  EXPECT_EQ(hallway({"log", "convert", log(), "--out", folder, "--force"}).status, 2);
  for (const std::string& input : {log(), folder, folder + "/observations.csv"}) {
    EXPECT_EQ(hallway({"log", "convert", input, "--out", log(), "--force"}).status,
              input.ends_with(".csv") ? 0 : 2)
        << input;
    if (input.ends_with(".csv")) write_file_atomically(log(), bytes);  // that one is not read
  }
  EXPECT_EQ(hallway({"log", "convert", log(), "--foxglove", "--out", log(), "--force"}).status, 2);
  EXPECT_EQ(hallway({"log", "convert", folder + "/observations.csv", "--truth-poses",
                     folder + "/truth_poses.csv", "--out", folder + "/truth_poses.csv", "--force"})
                .status,
            2);
  EXPECT_EQ(hallway({"replay", log(), "--steps", "2", "--out", folder, "--force"}).status, 2);
  EXPECT_EQ(hallway({"replay", folder, "--steps", "2", "--out",
                     folder + "/../" + run_folder().filename().string(), "--force"})
                .status,
            2);
  EXPECT_EQ(hallway({"log", "cut", log(), "--from", "1", "--to", "2", "--out", log(), "--force"}).status, 2);
  EXPECT_EQ(read_file(run_folder() / "metrics.json"), before);
  EXPECT_TRUE(read_file(log()) == bytes);
}

}  // namespace
}  // namespace hallway::test
