// SPDX-License-Identifier: MIT
// Planes out of clouds, and the bench: `hallway planes`, `hallway bench-em`.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/small_world.hpp"
#include "support/gray_png.hpp"
#include "support/process.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string levels() {
  return binary_folder() / "tests/abi/fixtures/levels.so";
}

/// Three points on z = 1, four on z = 2 and one on neither, which come in turn; with labels.
constexpr const char* kCloud =
    "x,y,z,label\n0,0,2,5\n0,0,1,4\n1,0,2,5\nnan,0,0,4\n1,0,1,4\n1,1,2,5\n0,1,1,4\n0,1,2,5\n0,0,7.5,-1\n";

Json document(const Ended& ended) {
  EXPECT_EQ(ended.status, 0) << ended.err;
  return ended.status == 0 ? Json::parse(ended.out) : Json();
}

Json planes(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "planes");
  arguments.insert(arguments.end(), {"--plugin", levels(), "--json"});
  return document(hallway(arguments));
}

/// `document` without the facts of the clock.
Json without_times(Json document) {
  document.erase("ms");
  document.erase("cpu_ms");
  return document;
}

TEST(Planes, AreFoundInACloudAndScored) {
  const TempFolder folder;
  const std::string cloud = folder.write("cloud.csv", kCloud);
  const Json found = planes({cloud});
  EXPECT_EQ(found.at("schema"), "hallway.planes/1");
  EXPECT_EQ(found.at("rows"), 9);
  EXPECT_EQ(found.at("points"), 8);
  EXPECT_EQ(found.at("not_finite"), 1);
  EXPECT_GE(found.at("ms").get<double>(), 0.0);
  ASSERT_EQ(found.at("planes").size(), 2u);
  const Json& first = found.at("planes").at(0);
  EXPECT_EQ(first.at("members"), Json({1, 4, 6})) << "rows of the file";
  EXPECT_EQ(first.at("normal"), Json({0.0, 0.0, -1.0}));
  EXPECT_EQ(first.at("offset"), -1.0);
  EXPECT_EQ(first.at("corners").size(), 4u);
  EXPECT_EQ(found.at("planes").at(1).at("members"), Json({0, 2, 5, 7}));
  EXPECT_EQ(found.at("score").at("apart").at("true_planes"), 2) << "so few points are counted apart";
  EXPECT_EQ(found.at("score").at("apart").at("matched"), 2);
}

TEST(Planes, ComeInEveryFormTheSame) {
  const TempFolder folder;
  const Json csv = planes({folder.write("a.csv", "x,y,z\n0,0,1\n1,0,1\n0,1,1\n9,9,9.5\n")});
  EXPECT_TRUE(csv.at("score").is_null());
  ASSERT_EQ(csv.at("planes").size(), 1u);
  const std::string points = "0 0 1\n1 0 1\n0 1 1\n9 9 9.5\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
      "z\nend_header\n";
  const std::string pcd =
      "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 4\nHEIGHT 1\n"
      "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 4\nDATA ascii\n";
  EXPECT_EQ(planes({folder.write("a.ply", ply + points)}).at("planes"), csv.at("planes"));
  EXPECT_EQ(planes({folder.write("a.pcd", pcd + points)}).at("planes"), csv.at("planes"));
  EXPECT_EQ(planes({folder.write("a.obj", "v 0 0 1\nv 1 0 1\nv 0 1 1\nv 9 9 9.5\n")}).at("planes"),
            csv.at("planes"));
  const std::string renamed = folder.write("b.csv", "up,right,ahead\n1,0,0\n1,1,0\n1,0,1\n9.5,9,9\n");
  EXPECT_EQ(planes({renamed, "--columns", "right,ahead,up"}).at("planes"), csv.at("planes"));
}

TEST(Planes, OfADepthImageAreItsPixels) {
  const TempFolder folder;
  // The camera looks along x; the pixel at the middle of the image sees z = 0, as do its neighbours in the row.
  const std::string image = folder.write("a.png", gray_png(3, 3, {0, 0, 0, 2000, 2000, 2000, 0, 0, 0}));
  const Json found = planes({image, "--intrinsics", "3,3,1,1", "--depth-scale", "1000"});
  ASSERT_EQ(found.at("planes").size(), 1u);
  EXPECT_EQ(found.at("planes").at(0).at("members"), Json({3, 4, 5}));
  EXPECT_EQ(hallway({"planes", image, "--plugin", levels()}).status, 2);
  EXPECT_EQ(hallway({"planes", image, "--plugin", levels(), "--intrinsics", "3,3,1"}).status, 2);
}

TEST(Planes, AreWrittenAsFiles) {
  const TempFolder folder;
  const std::string cloud = folder.write("cloud.csv", kCloud);
  const fs::path out = folder / "out";
  const Ended ended = hallway({"planes", cloud, "--plugin", levels(), "--out", out});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.out.find("2 planes in 8 points"), std::string::npos) << ended.out;
  EXPECT_NE(ended.err.find("1 of 9 rows"), std::string::npos) << ended.err;
  EXPECT_EQ(without_times(Json::parse(read_file(out / "planes.json"))), without_times(planes({cloud})));
  EXPECT_TRUE(read_file(out / "planes.ply").starts_with("ply\n"));
  EXPECT_TRUE(read_file(out / "planes.png").starts_with("\x89PNG"));
  // What was written is a cloud itself.
  EXPECT_EQ(planes({out / "planes.ply"}).at("planes").size(), 2u);
}

TEST(Planes, TakeLabelsFromAFile) {
  const TempFolder folder;
  std::string cloud = "x,y,z\n", labels = "label\n";
  for (int i = 0; i < 60; ++i) {
    cloud += std::to_string(i % 6) + "," + std::to_string(i / 6) + "," + (i < 30 ? "1" : "2") + "\n";
    labels += i < 30 ? "7\n" : "0\n";
  }
  const std::string file = folder.write("a.csv", cloud), truth = folder.write("a.txt", labels);
  const Json score = planes({file, "--labels", truth, "--unlabelled", "0"}).at("score");
  EXPECT_EQ(score.at("true_planes"), 1);
  EXPECT_EQ(score.at("iou").at(0).at("recall"), 1.0);
  EXPECT_EQ(score.at("iou").at(0).at("precision"), 0.5);
  EXPECT_EQ(score.at("faults").at("extra"), 1);
  const Ended text = hallway({"planes", file, "--plugin", levels(), "--labels", truth, "--unlabelled", "0"});
  EXPECT_NE(text.out.find("\n  extra: 1\n"), std::string::npos) << text.out;
  EXPECT_EQ(planes({file, "--labels", truth}).at("score").at("true_planes"), 2);
  EXPECT_EQ(
      hallway({"planes", file, "--plugin", levels(), "--labels", folder.write("b.txt", "1\n2\n")}).status, 3);
}

TEST(Planes, InThisProcessAndInAnotherAreTheSame) {
  const TempFolder folder;
  const std::string cloud = folder.write("cloud.csv", kCloud);
  EXPECT_EQ(without_times(planes({cloud, "--in-process"})), without_times(planes({cloud})));
}

TEST(Planes, WhatCannotBeDoneIsSaidByTheStatus) {
  const TempFolder folder;
  const std::string cloud = folder.write("cloud.csv", kCloud);
  const auto status = [&](const std::string& file, const std::string& plugin) {
    return hallway({"planes", file, "--plugin", plugin}).status;
  };
  EXPECT_EQ(status(folder / "none.csv", levels()), 3);
  EXPECT_EQ(status(folder.write("a.csv", "x,y,z\n1,2\n"), levels()), 3);
  EXPECT_EQ(status(folder.write("a.txt", "1 2 3\n"), levels()), 3);
  EXPECT_EQ(status(cloud, "slam_point"), 3) << "finds no planes";
  EXPECT_EQ(status(cloud, "no_such_plugin"), 4);
  EXPECT_EQ(status(cloud, levels() + ":fault=throws"), 5);
  EXPECT_EQ(status(cloud, levels() + ":no_such=1"), 2);
  EXPECT_EQ(status(cloud, levels() + ":"), 2);
  EXPECT_EQ(status(folder.write("empty.csv", "x,y,z\n"), levels()), 0);
  const Ended ended = hallway({"planes", folder / "none.csv", "--plugin", levels(), "--json"});
  EXPECT_NE(Json::parse(ended.out).dump().find("none.csv"), std::string::npos);
}

Json bench(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "bench-em");
  arguments.push_back("--json");
  return document(hallway(arguments));
}

/// The scores of the plugins of a bench, scene by scene, without times.
Json scores(const Json& results) {
  Json all = Json::array();
  for (const Json& plugin : results.at("plugins")) {
    all.push_back(plugin.at("score"));
    for (const Json& scene : plugin.at("scenes")) all.push_back(without_times(scene));
  }
  return all;
}

TEST(BenchEm, GivesAllTheSameScenesAndIsRepeatable) {
  const std::vector<std::string> arguments{"--plugin", levels(), "--plugin", levels() + ":step_m=0.5",
                                           "--scenes", "3",      "--points", "300..600",
                                           "--planes", "3..5"};
  const Json results = bench(arguments);
  EXPECT_EQ(results.at("schema"), "hallway.bench_em/1");
  EXPECT_EQ(results.at("seed"), 1);
  ASSERT_EQ(results.at("plugins").size(), 2u);
  for (const Json& plugin : results.at("plugins")) {
    EXPECT_EQ(plugin.at("id"), "levels");
    ASSERT_EQ(plugin.at("scenes").size(), 3u);
    const auto points = plugin.at("scenes").at(0).at("points").get<int>();
    EXPECT_GE(points, 300);
    EXPECT_LE(points, 600);
  }
  EXPECT_EQ(results.at("plugins").at(0).at("score").at("true_planes"),
            results.at("plugins").at(1).at("score").at("true_planes"));
  EXPECT_EQ(scores(bench(arguments)), scores(results));
  std::vector<std::string> other = arguments;
  other.insert(other.end(), {"--seed", "2"});
  EXPECT_NE(scores(bench(other)), scores(results));
}

TEST(BenchEm, ScenesThatWereWrittenAreThoseThatWereTried) {
  const TempFolder folder;
  const fs::path out = folder / "out";
  const std::vector<std::string> shape{"--plugin", levels(),   "--scenes", "2",
                                       "--points", "300..600", "--planes", "3..5"};
  std::vector<std::string> write = shape;
  write.insert(write.end(), {"--out", out, "--write-scenes", "--pictures", "1"});
  const Json made = bench(write);
  EXPECT_TRUE(fs::exists(out / "scene_00.csv"));
  EXPECT_TRUE(fs::exists(out / "scene_01_planes.csv"));
  EXPECT_EQ(Json::parse(read_file(out / "results.json")), made);
  std::size_t pictures = 0;
  for (const auto& entry : fs::directory_iterator(out))
    pictures += entry.path().extension() == ".png" ? 1u : 0u;
  EXPECT_EQ(pictures, 1u);
  EXPECT_EQ(scores(bench({"--plugin", levels(), "--scenes-dir", out})), scores(made));
}

TEST(BenchEm, LevelPlanesAreFoundByAPluginForLevelPlanes) {
  const TempFolder folder;
  std::string points = "x,y,z,label\n";
  for (int i = 0; i < 90; ++i)
    points += std::to_string(i % 6) + "," + std::to_string(i / 6 % 5) + "," + std::to_string(i / 30 + 1) +
              "," + std::to_string(i / 30) + "\n";
  folder.write("s.csv", points);
  const Json score =
      bench({"--plugin", levels(), "--scenes-dir", folder.path()}).at("plugins").at(0).at("score");
  EXPECT_EQ(score.at("true_planes"), 3);
  EXPECT_EQ(score.at("iou").at(2).at("recall"), 1.0);
  EXPECT_EQ(score.at("iou").at(2).at("precision"), 1.0);
  EXPECT_LT(score.at("normal_error_deg").at("max").get<double>(), 1e-6);
  const Ended ended = hallway({"bench-em", "--plugin", levels(), "--scenes-dir", folder.path()});
  EXPECT_NE(ended.out.find("1 scenes, 3 planes"), std::string::npos) << ended.out;
}

TEST(BenchEm, WhatCannotBeDoneIsSaidByTheStatus) {
  const TempFolder folder;
  const auto status = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"bench-em", "--plugin", levels(), "--scenes", "1"});
    return hallway(arguments).status;
  };
  EXPECT_EQ(status({"--planes", "5..3"}), 2);
  EXPECT_EQ(status({"--planes", "0..3"}), 2);
  EXPECT_EQ(status({"--points", "x"}), 2);
  EXPECT_EQ(status({"--sigma", "0..1"}), 2);
  EXPECT_EQ(status({"--half-size", "0..2"}), 2);
  EXPECT_EQ(status({"--write-scenes"}), 2);
  EXPECT_EQ(status({"--scenes-dir", folder.path()}), 3) << "no scenes in it";
  EXPECT_EQ(status({"--scenes-dir", folder / "none"}), 3);
  EXPECT_EQ(hallway({"bench-em", "--plugin", levels() + ":fault=throws", "--scenes", "1"}).status, 5);
  EXPECT_EQ(hallway({"bench-em", "--scenes", "1"}).status, 2);
}

/// A scenario whose last plugin answers with what it read in the planes that the one before it found.
std::string scenario_with_a_reader() {
  const std::string reader = binary_folder() / "tests/abi/fixtures/reads_planes.so:reads_both";
  return replaced(
      small_scenario(), "name = \"slam_point\"\n",
      "name = \"" + levels() + "\"\nparams = { near_m = 0.5 }\n\n[[plugin]]\nname = \"" + reader + "\"\n");
}

TEST(PlanesInAPipeline, AreTheSameInOneProcessInSeveralAndInAReplay) {
  const SmallWorld world;
  world.folder().write("small.toml", scenario_with_a_reader());
  ASSERT_EQ(world.run({"--in-process"}, "together").status, 0);
  ASSERT_EQ(world.run({}, "apart").status, 0);
  const std::string trajectory = read_file(fs::path(world.out("together")) / "trajectory.tum");
  EXPECT_EQ(trajectory, read_file(fs::path(world.out("apart")) / "trajectory.tum"));
  EXPECT_NE(trajectory.find(" 0 0 0 1\n"), std::string::npos) << trajectory.substr(0, 200);
  EXPECT_EQ(read_file(fs::path(world.out("together")) / "run.mcap"),
            read_file(fs::path(world.out("apart")) / "run.mcap"));
  const fs::path plugins =
      fs::path(world.folder().path()) / "plugins";  // a replay looks for them by their ids
  fs::create_directory(plugins);
  for (const char* file : {"levels.so", "reads_planes.so"}) {
    fs::copy_file(binary_folder() / "tests/abi/fixtures" / file, plugins / file);
  }
  for (const bool in_process : {false, true}) {
    const std::string name = in_process ? "again_together" : "again_apart";
    std::vector<std::string> arguments{
        "replay", world.out("apart") + "/run.mcap", "--out", world.out(name), "--plugin-path", plugins};
    if (in_process) arguments.push_back("--in-process");
    const Ended ended = hallway(arguments);
    ASSERT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(read_file(fs::path(world.out(name)) / "trajectory.tum"), trajectory);
  }
}

}  // namespace
}  // namespace hallway::test
