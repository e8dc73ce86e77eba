// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "support/data.hpp"
#include "support/process.hpp"
#include "support/room_maps.hpp"
#include "support/temp_folder.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Ended compile(const fs::path& map, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"compile", map};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return hallway(arguments);
}

/// The document without what differs from run to run.
Json facts(const Ended& ended) {
  Json document = Json::parse(ended.out);
  for (const char* key : {"stages", "memory_peak_bytes", "from_cache", "warnings"}) document.erase(key);
  return document;
}

std::vector<fs::path> cached_files(const TempFolder& folder) {
  std::vector<fs::path> files;
  if (!fs::exists(folder.path() / ".hallway")) return files;
  for (const auto& entry : fs::directory_iterator(folder.path() / ".hallway")) files.push_back(entry.path());
  return files;
}

TEST(Compile, SealedMapHasItsRoomsAndNoLeak) {
  const TempFolder folder;
  const Ended ended = compile(folder.write("rooms.map", two_rooms()), {"--json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(ended.err, "");
  const Json document = Json::parse(ended.out);
  EXPECT_EQ(document.at("schema"), "hallway.compile/1");
  EXPECT_EQ(document.at("sealed"), true);
  EXPECT_EQ(document.at("brushes").at("used"), 6);
  EXPECT_EQ(document.at("leak"), nullptr);
  EXPECT_GE(document.at("clusters").get<int>(), 5);
  EXPECT_GE(document.at("portals").get<int>(), 4);
  EXPECT_LT(document.at("polygons_inside").get<int>(), document.at("polygons").get<int>());
  EXPECT_LT(document.at("visible").at("mean_share").get<double>(), 1.0);
  EXPECT_GT(document.at("visible").at("mean_share").get<double>(), 0.2);
  EXPECT_EQ(document.at("visible").at("level"), "full");
  EXPECT_GT(document.at("memory_peak_bytes").get<std::int64_t>(), 1 << 20);
  std::vector<std::string> stages;
  for (const Json& stage : document.at("stages")) {
    stages.push_back(stage.at("name").get<std::string>());
    EXPECT_GE(stage.at("seconds").get<double>(), 0.0);
  }
  EXPECT_EQ(stages, (std::vector<std::string>{"brushes", "cache", "partition", "visibility", "cache"}));
}

TEST(Compile, TextNamesEveryStage) {
  const TempFolder folder;
  const Ended ended = compile(folder.write("rooms.map", two_rooms()));
  ASSERT_EQ(ended.status, 0) << ended.err;
  for (const char* word : {"rooms.map: sealed", "brushes", "polygons", "nodes", "leaves", "clusters",
                           "portals", "visible", "memory", "time"}) {
    EXPECT_NE(ended.out.find(word), std::string::npos) << word << "\n" << ended.out;
  }
  EXPECT_EQ(ended.err, "");  // standard error is no terminal: no progress
}

TEST(Compile, LeakIsStatusOneWithOccupantWayAndOpening) {
  const TempFolder folder;
  const fs::path map = folder.write("rooms.map", two_rooms(hole()));
  const Ended ended = compile(map, {"--json"});
  EXPECT_EQ(ended.status, 1);
  const Json document = Json::parse(ended.out);
  EXPECT_EQ(document.at("status"), 1);
  EXPECT_EQ(document.at("sealed"), false);
  EXPECT_EQ(document.at("visible"), nullptr);
  const Json& leak = document.at("leak");
  EXPECT_EQ(leak.at("occupant").at("classname"), "hw_robot_start");
  EXPECT_GT(leak.at("occupant").at("line").get<int>(), 0);
  EXPECT_NEAR(leak.at("opening").at("width_m").get<double>(), 0.5, 1e-6);
  EXPECT_NEAR(leak.at("opening").at("height_m").get<double>(), 2.0, 1e-6);
  const Json& at = leak.at("opening").at("at_m");
  EXPECT_LE(std::abs(at[0].get<double>() + 0.5), 0.5 + 1e-9);
  EXPECT_LE(std::abs(at[1].get<double>() - 1.25), 0.25 + 1e-9);
  // From the robot through the hole it is 3 m at least, and no detour.
  EXPECT_GE(leak.at("length_m").get<double>(), 3.0);
  EXPECT_LE(leak.at("length_m").get<double>(), 6.0);
  EXPECT_EQ(document.at("points_file"), (folder.path() / "rooms.pts").string());
}

/// A name beside the map may be of something else.
TEST(Compile, AFileThatIsNoLeakPathStays) {
  const TempFolder folder;
  const std::string text = "1,2,3 my survey points\n";
  for (const std::string& map : {two_rooms(), two_rooms(hole())}) {
    const fs::path points = folder.write("rooms.pts", text);
    const Ended ended = compile(folder.write("rooms.map", map), {"--json"});
    EXPECT_EQ(read_file(points), text);
    EXPECT_EQ(Json::parse(ended.out).at("points_file"), nullptr);
    EXPECT_EQ(ended.err.find("holds something else") != std::string::npos, ended.status == 1) << ended.err;
  }
}

TEST(Compile, LeakTextSaysTheSame) {
  const TempFolder folder;
  const Ended ended = compile(folder.write("rooms.map", two_rooms(hole())));
  EXPECT_EQ(ended.status, 1);
  for (const char* word : {"leaks", "hw_robot_start", "line ", "0.50 m x 2.00 m", "rooms.pts"}) {
    EXPECT_NE(ended.out.find(word), std::string::npos) << word << "\n" << ended.out;
  }
}

TEST(Compile, PointFileRunsFromTheOccupantOutOfTheMapInMapUnits) {
  const TempFolder folder;
  compile(folder.write("rooms.map", two_rooms(hole())));
  std::istringstream text(read_file(folder.path() / "rooms.pts"));
  std::vector<std::array<double, 3>> points;
  for (std::array<double, 3> p{}; text >> p[0] >> p[1] >> p[2];) points.push_back(p);
  ASSERT_TRUE(text.eof());
  ASSERT_GE(points.size(), 6u);
  EXPECT_NEAR(points.front()[0], 200.0, 1e-6);
  EXPECT_NEAR(points.front()[1], 150.0, 1e-6);
  EXPECT_LE(points.back()[0], -100.0 + 1e-6);
  for (std::size_t i = 1; i < points.size(); ++i) {
    double squared = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      squared += std::pow(points[i][axis] - points[i - 1][axis], 2);
    EXPECT_LE(std::sqrt(squared), 50.0 + 1e-6);
  }
}

TEST(Compile, SealingTheMapTakesThePointFileAway) {
  const TempFolder folder;
  compile(folder.write("rooms.map", two_rooms(hole())));
  ASSERT_TRUE(fs::exists(folder.path() / "rooms.pts"));
  EXPECT_EQ(compile(folder.write("rooms.map", two_rooms())).status, 0);
  EXPECT_FALSE(fs::exists(folder.path() / "rooms.pts"));
}

TEST(Compile, SecondTimeComesFromTheCacheAndSaysTheSame) {
  const TempFolder folder;
  const fs::path map = folder.write("rooms.map", two_rooms());
  const Ended first = compile(map, {"--json"});
  ASSERT_EQ(cached_files(folder).size(), 1u);
  const Ended second = compile(map, {"--json"});
  EXPECT_EQ(Json::parse(first.out).at("from_cache"), false);
  EXPECT_EQ(Json::parse(second.out).at("from_cache"), true);
  EXPECT_EQ(facts(first), facts(second));
  // A full result serves who asks for a fast one, and says what it is.
  const Ended fast = compile(map, {"--json", "--level", "fast"});
  EXPECT_EQ(Json::parse(fast.out).at("visible").at("level"), "full");
}

TEST(Compile, NoCacheWritesNone) {
  const TempFolder folder;
  EXPECT_EQ(compile(folder.write("rooms.map", two_rooms()), {"--no-cache"}).status, 0);
  EXPECT_FALSE(fs::exists(folder.path() / ".hallway"));
}

TEST(Compile, DamagedCacheIsComputedAnew) {
  const TempFolder folder;
  const fs::path map = folder.write("rooms.map", two_rooms());
  const Ended first = compile(map, {"--json"});
  const fs::path file = cached_files(folder).at(0);
  const std::string good = read_file(file);
  std::string flipped = good;
  flipped[flipped.size() / 2] = static_cast<char>(flipped[flipped.size() / 2] ^ 1);
  for (const std::string& bad : {flipped, good.substr(0, good.size() / 2), std::string()}) {
    write_file_atomically(file, bad);
    const Ended again = compile(map, {"--json"});
    EXPECT_EQ(again.status, 0) << again.err;
    EXPECT_EQ(Json::parse(again.out).at("from_cache"), false);
    EXPECT_EQ(facts(first), facts(again));
    EXPECT_EQ(read_file(file), good);
  }
}

TEST(Compile, CacheThatCannotBeWrittenIsOneWarning) {
  const TempFolder folder;
  const fs::path map = folder.write("rooms.map", two_rooms());
  folder.write(".hallway", "in the way");
  const Ended ended = compile(map, {"--json"});
  EXPECT_EQ(ended.status, 0);
  EXPECT_EQ(Json::parse(ended.out).at("warnings").size(), 1u);
  EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
  EXPECT_NE(ended.err.find("cache"), std::string::npos) << ended.err;
}

TEST(Compile, ThreadsChangeNoByteOfTheResult) {
  std::vector<std::string> bytes;
  std::vector<Json> documents;
  for (const char* threads : {"1", "2", "8"}) {
    const TempFolder folder;
    const fs::path map = folder.write("rooms.map", two_rooms());
    Json document = facts(compile(map, {"--json", "--threads", threads}));
    document.erase("map");
    documents.push_back(document);
    bytes.push_back(read_file(cached_files(folder).at(0)));
  }
  EXPECT_EQ(bytes[0], bytes[1]);
  EXPECT_EQ(bytes[0], bytes[2]);
  EXPECT_EQ(documents[0], documents[1]);
  EXPECT_EQ(documents[0], documents[2]);
}

TEST(Compile, FolderAndNameWithSpaces) {
  const TempFolder folder;
  fs::create_directories(folder.path() / "my maps");
  const fs::path map = folder.write("my maps/two rooms.map", two_rooms(hole()));
  EXPECT_EQ(compile(map).status, 1);
  EXPECT_TRUE(fs::exists(folder.path() / "my maps/two rooms.pts"));
}

TEST(Compile, WarnsOfBadBrushesAndOccupantsInSolidOrRefusesThem) {
  const TempFolder folder;
  const fs::path map = folder.write("rooms.map", two_rooms(box_brush({0, 0, 0}, {0, 10, 10}, "flat"),
                                                           point_entity("light", {500, 100, 100})));
  const Ended ended = compile(map, {"--json"});
  EXPECT_EQ(ended.status, 0);
  EXPECT_EQ(Json::parse(ended.out).at("brushes").at("no_solids"), 1);
  EXPECT_EQ(Json::parse(ended.out).at("warnings").size(), 2u);
  EXPECT_NE(ended.err.find("light"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("rooms.map:"), std::string::npos) << ended.err;
  EXPECT_EQ(compile(map, {"--strict"}).status, 3);
}

TEST(Compile, BadInputsAreStatusThreeWithTheFileNamed) {
  const TempFolder folder;
  const fs::path pipe = folder.path() / "pipe.map";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const fs::path& bad : {folder.write("empty.map", ""), folder.write("byte.map", "{"), folder.path(),
                              pipe, fs::path("/dev/zero"), folder.path() / "missing.map"}) {
    const Ended ended = compile(bad);
    EXPECT_EQ(ended.status, 3) << bad;
    EXPECT_NE(ended.err.find(bad.filename().string()), std::string::npos) << ended.err;
    EXPECT_EQ(ended.out, "");
  }
}

TEST(Compile, WrongUseIsStatusTwo) {
  const TempFolder folder;
  const fs::path map = folder.write("rooms.map", two_rooms());
  EXPECT_EQ(compile(map, {"--level", "best"}).status, 2);
  EXPECT_EQ(compile(map, {"--threads", "0"}).status, 2);
  EXPECT_EQ(hallway({"compile"}).status, 2);
}

TEST(Compile, CtrlCEndsItInGoodOrder) {
  HALLWAY_DATA_OR_SKIP(map, "maps/id1/e1m1.map");
  // Takes seconds: the signal comes before the end, whichever stage it meets.
  Process process({hallway_program(), "compile", map, "--no-cache", "--threads", "1"});
  std::this_thread::sleep_for(std::chrono::milliseconds(400));
  ::kill(process.pid(), SIGINT);
  const Ended ended = process.wait();
  EXPECT_EQ(ended.status, 130);
  EXPECT_EQ(ended.out, "");
}

TEST(Compile, FullOutputIsAnErrorAndNoCrash) {
  const TempFolder folder;
  const fs::path map = folder.write("rooms.map", two_rooms());
  Process process({hallway_program(), "compile", map}, {}, {}, "/dev/full");
  EXPECT_EQ(process.wait().status, 3);
}

}  // namespace
}  // namespace hallway::test
