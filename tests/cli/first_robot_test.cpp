// SPDX-License-Identifier: MIT
// `hallway study first-robot` and `hallway study sonar-rooms` at a tiny size, and what they refuse.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

#include "cli/batch_results.hpp"
#include "cli/small_world.hpp"
#include "geometry/se3.hpp"
#include "support/data.hpp"
#include "support/long_mode.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kOfficeFiles[] = {"office.map", "office.toml", "office_faults.toml",
                                        "office_robot.map"};

/// `hallway study NAME`.
Ended study(const std::string& name, const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"study", name};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return hallway(arguments);
}

/// One run on each map and one office, of so few steps that the robot only sets off.
Ended tiny(const fs::path& out, const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"--quick", "--steps", "40", "--out", out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return study("first-robot", arguments);
}

/// Refused with that status and one message, before anything is written.
void expect_refused(const Ended& ended, int status, const std::string& part) {
  EXPECT_EQ(ended.status, status) << ended.err;
  EXPECT_EQ(ended.out, "");
  EXPECT_NE(ended.err.find(part), std::string::npos) << part << "\n" << ended.err;
  EXPECT_EQ(ended.err.find("hallway: "), ended.err.rfind("hallway: ")) << "one message: " << ended.err;
}

/// The files of a folder, but not those of the folders in it.
std::set<std::string> files_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file()) names.insert(entry.path().filename().string());
  }
  names.erase(".lock");
  return names;
}

void expect_same_files(const fs::path& a, const fs::path& b) {
  const std::set<std::string> names = files_in(a);
  EXPECT_EQ(names, files_in(b));
  for (const std::string& name : names)
    EXPECT_TRUE(read_file(a / name) == read_file(b / name)) << a.filename() << "/" << name;
}

/// Each chart of study.json is there, as SVG and as PNG.
void expect_charts(const Json& document, const fs::path& folder, std::size_t count) {
  EXPECT_EQ(document.at("charts").size(), count);
  for (const Json& chart : document.at("charts")) {
    const std::string file = chart.at("file").get<std::string>();
    const std::string svg = read_file(folder / (file + ".svg"));
    EXPECT_TRUE(svg.starts_with("<svg ")) << file;
    EXPECT_NE(svg.find(chart.at("title").get<std::string>()), std::string::npos) << file;
    EXPECT_TRUE(read_file(folder / (file + ".png")).starts_with("\x89PNG")) << file;
  }
}

TEST(FirstRobotStudy, WritesTablesChartsAndFiguresTheSameEveryTime) {
  const TempFolder folder;
  const fs::path a = folder.path() / "a", b = folder.path() / "b";
  const Ended ended = tiny(a, {"--json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const Json document = Json::parse(ended.out);
  EXPECT_EQ(document.at("schema"), "hallway.study/1");
  EXPECT_EQ(document.at("study"), "first-robot");
  EXPECT_EQ(document.at("folder"), a.string());
  const Json runs = document.at("tables").at("runs");
  EXPECT_EQ(runs.size(), 14u) << "three maps by two rules and an office, with faults and without";
  for (const Json& run : runs) {
    EXPECT_EQ(run.at("loop"), "open") << run.dump();
    EXPECT_TRUE(run.at("problem").is_null());
  }
  EXPECT_EQ(read_csv(a / "runs.csv").size(), 15u);
  EXPECT_EQ(read_csv(a / "rates.csv").size(), 15u);
  expect_charts(document, a, 3);
  for (const char* figure : {"figure_26.png", "figure_27.png", "figure_28.png"})
    EXPECT_GT(fs::file_size(a / figure), 10'000u) << figure;
  EXPECT_TRUE(fs::exists(a / "cells/offices_1-faults-seed_1/run.mcap"));

  const Ended again = tiny(b, {"--jobs", "2"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.out.find("two_loops"), std::string::npos) << again.out;
  expect_same_files(a, b);
  expect_same_files(a / "offices", b / "offices");
}

/// Where the openings that a run has charted truly are, by its true poses.
std::vector<Vec2> charted_openings(const fs::path& run) {
  struct Pose {
    double x_m, y_m, yaw_rad;
  };
  std::map<std::int64_t, Pose> poses;  // by time, in ns
  std::istringstream lines(read_file(run / "truth.tum"));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#")) continue;
    std::istringstream words(line);
    double t_s = 0.0, x = 0.0, y = 0.0, z = 0.0, qx = 0.0, qy = 0.0, qz = 0.0, qw = 0.0;
    words >> t_s >> x >> y >> z >> qx >> qy >> qz >> qw;
    poses[std::llround(t_s * 1e9)] = {x, y, 2.0 * std::atan2(qz, qw)};
  }
  std::vector<Vec2> places;
  const Json chart = read_json(run / "topology.json");
  for (const Json& node : chart.at("nodes")) {
    if (node.at("kind") == "discontinuity") continue;
    const auto pose = poses.lower_bound(node.at("t_ns").get<std::int64_t>() - 1000);
    if (pose == poses.end()) throw std::runtime_error(run.string() + ": a node behind the last pose");
    const double c = std::cos(pose->second.yaw_rad), s = std::sin(pose->second.yaw_rad);
    const double x = node.at("x_m").get<double>(), y = node.at("y_m").get<double>();
    places.push_back({pose->second.x_m + c * x - s * y, pose->second.y_m + s * x + c * y});
  }
  return places;
}

/// Whether each place has one of the others within 0.75 m.
bool has_all(const std::vector<Vec2>& places, const std::vector<Vec2>& wanted) {
  return !wanted.empty() && std::ranges::all_of(wanted, [&](const Vec2& one) {
    return std::ranges::any_of(places, [&](const Vec2& place) { return (place - one).norm() <= 0.75; });
  });
}

// Seeds on which nothing was tuned.
TEST(FirstRobotMaps, AreOftenRightAndHardlyEverWrong) {
  if (!long_mode()) GTEST_SKIP() << "only with HALLWAY_TEST_LONG=1";
  const TempFolder folder;
  const fs::path out = folder.path() / "out";
  // With parameters it is not compared with exploration by cost.
  const Ended ended = study("first-robot", {"--plugin", "wall_follower:exploration=1", "--first-seed", "9501",
                                            "--jobs", "2", "--quiet", "--out", out});
  ASSERT_EQ(ended.status, 0) << ended.err;
  struct Count {
    int runs = 0, right = 0, wrong = 0;
  };
  std::map<std::string, Count> counts;
  const Json study = read_json(out / "study.json");
  for (const Json& run : study.at("tables").at("runs")) {
    const std::string map = run.at("map").get<std::string>(), faults = run.at("faults").get<std::string>();
    Count& count = counts[map + (faults == "yes" ? " with faults" : "")];
    ++count.runs;
    count.right += run.at("loop") == "rightly closed" ? 1 : 0;
    count.wrong += run.at("loop") == "wrongly closed" ? 1 : 0;
  }
  struct Demand {
    std::string map;
    int runs, right, wrong;
  };
  const Demand demands[] = {{"cubicles", 20, 19, 0},         {"cubicles with faults", 20, 17, 0},
                            {"two_loops", 20, 17, 0},        {"two_loops with faults", 20, 17, 0},
                            {"cubicles_changed", 20, 17, 0}, {"cubicles_changed with faults", 20, 17, 0},
                            {"offices", 100, 85, 1},         {"offices with faults", 100, 85, 1}};
  EXPECT_EQ(counts.size(), std::size(demands));
  for (const Demand& demand : demands) {
    const Count& count = counts[demand.map];
    EXPECT_EQ(count.runs, demand.runs) << demand.map;
    EXPECT_GE(count.right, demand.right) << demand.map;
    EXPECT_LE(count.wrong, demand.wrong) << demand.map;
  }
  for (const std::string map : {"cubicles", "two_loops"}) {
    const std::vector<Vec2> office = charted_openings(out / "cells" / (map + "-seed_9501"));
    int whole = 0;
    for (const auto& cell : fs::directory_iterator(out / "cells")) {
      const std::string name = cell.path().filename().string();
      if (!cell.is_directory() || !name.starts_with(map + "-")) continue;
      if (name.starts_with(map + "-faults-")) {
        // A robot that went into a room also drove by its doorway from within.
        whole += has_all(charted_openings(cell.path()), office) ? 1 : 0;
      } else {
        const Json openings = read_json(cell.path() / "metrics.json").at("topology").at("openings");
        EXPECT_EQ(openings.at("found"), openings.at("demanded")) << name;
      }
    }
    EXPECT_GE(whole, map == "cubicles" ? 20 : 17) << map << " with faults, of 20";
  }
}

TEST(FirstRobotRun, IsNotLostWithoutPoses) {
  const TempFolder folder;
  const fs::path out = folder.path() / "run";
  const Ended ended =
      hallway({"run", source_folder() / "maps/cubicles.toml", "--steps", "40", "--quiet", "--out", out});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const Json metrics = read_json(out / "metrics.json");
  EXPECT_TRUE(metrics.at("verdict").is_null());
  EXPECT_TRUE(metrics.at("lost_iterations").is_null());
  EXPECT_TRUE(metrics.at("coverage").at("poses").is_null());
  const Ended printed =
      hallway({"run", source_folder() / "maps/cubicles.toml", "--steps", "40", "--force", "--out", out});
  EXPECT_NE(printed.out.find("none: the plugin gives no poses"), std::string::npos) << printed.out;
  EXPECT_EQ(printed.out.find("lost"), std::string::npos) << printed.out;
  EXPECT_EQ(printed.out.find("without a pose"), std::string::npos) << printed.out;
}

TEST(FirstRobotStudy, HasTheStatusOfItsRunsWhereAllFail) {
  const TempFolder folder;
  struct Case {
    std::vector<std::string> arguments;
    int status;
    std::string part;
    std::string runs;
  };
  // The rule of exploration is compared where the plugin has it.
  for (const Case& one :
       {Case{{"--plugin", "no_such_plugin"}, 4, "no_such_plugin", "cubicles-seed_1 and 5 more: "},
        Case{{"--set", "no_such_parameter=1"}, 2, "no_such_parameter", "cubicles-seed_1 and 11 more: "}}) {
    std::vector<std::string> arguments = one.arguments;
    arguments.insert(arguments.end(), {"--offices", "0"});
    const fs::path out = folder.path() / one.part;
    const Ended ended = tiny(out, arguments);
    EXPECT_EQ(ended.status, one.status) << ended.err;
    EXPECT_NE(ended.err.find(one.runs), std::string::npos) << ended.err;
    EXPECT_NE(ended.err.find(one.part), std::string::npos) << ended.err;
    EXPECT_EQ(std::ranges::count(ended.err, '\n'), 1) << ended.err;
    const Json study = read_json(out / "study.json");
    for (const Json& run : study.at("tables").at("runs")) EXPECT_EQ(run.at("loop"), "failed");
  }
}

TEST(FirstRobotStudy, RefusesWhatItCannotDo) {
  const TempFolder folder;
  const fs::path out = folder.path() / "out";
  const std::string taken = folder.write("taken", "text");
  expect_refused(tiny(out, {"--runs", "-1"}), 2, "--runs");
  expect_refused(tiny(out, {"--runs", "10001"}), 2, "--runs");
  expect_refused(tiny(out, {"--offices", "-1"}), 2, "--offices");
  expect_refused(tiny(out, {"--first-seed", "-1"}), 2, "--first-seed");
  expect_refused(tiny(out, {"--first-seed", "18446744073709551617"}), 2, "--first-seed");
  expect_refused(tiny(out, {"--steps", "-1"}), 2, "--steps");
  expect_refused(tiny(out, {"--seeds", "3"}), 2, "--seeds");
  expect_refused(tiny(out, {"cubicle"}), 2, "cubicle");
  expect_refused(tiny(out, {"--runs", "0", "--offices", "0"}), 2, "nothing to run");
  expect_refused(tiny(out, {"--maps", folder.path() / "nowhere"}), 3, "nowhere/cubicles.toml");
  expect_refused(tiny(out, {"--maps", folder.path() / "nowhere", "--runs", "0"}), 3, "robots/first.map");
  EXPECT_FALSE(fs::exists(out));
  expect_refused(tiny(taken), 3, "taken");
  expect_refused(tiny(taken + "/below"), 3, "taken");
  expect_refused(tiny("/proc/hallway-study"), 3, "/proc/hallway-study");
  EXPECT_EQ(read_file(taken), "text");
}

TEST(FirstRobotStudy, EarlierResultsStayWithoutForce) {
  const TempFolder folder;
  const std::vector<std::string> one_office{"--runs", "0"};
  const fs::path out = folder.path() / "out";
  ASSERT_EQ(tiny(out, one_office).status, 0);
  const std::string before = read_file(out / "study.json");
  expect_refused(tiny(out, one_office), 3, "--force");
  EXPECT_EQ(read_file(out / "study.json"), before);
  EXPECT_EQ(tiny(out, {"--runs", "0", "--force"}).status, 0);
  expect_refused(tiny(out / "cells/offices_1-seed_1", {"--runs", "0", "--force"}), 3, "folder of a run");
}

TEST(MakeOffice, GivesTheSameBytesAndReplacesOnlyByForce) {
  const TempFolder folder;
  const fs::path a = folder.path() / "a", b = folder.path() / "b";
  fs::create_directories(a);
  fs::create_directories(b);
  const auto make = [](const fs::path& out, const std::string& seed, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"--make-office", seed, "--out", out / "office.map"});
    return study("first-robot", more);
  };
  const Ended ended = make(a, "7", {"--json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(Json::parse(ended.out).at("files").size(), std::size(kOfficeFiles));
  ASSERT_EQ(make(b, "7").status, 0);
  expect_same_files(a, b);
  for (const char* file : kOfficeFiles) {
    SCOPED_TRACE(file);
    const std::string before = read_file(a / file);
    for (const char* other : kOfficeFiles) {
      if (std::string(other) != file) fs::remove(a / other);
    }
    expect_refused(make(a, "8"), 3, std::string(file) + ": is there already; --force replaces it");
    EXPECT_EQ(files_in(a), std::set<std::string>{file});
    EXPECT_EQ(read_file(a / file), before);
    ASSERT_EQ(make(a, "7", {"--force"}).status, 0);
    expect_same_files(a, b);
  }
  ASSERT_EQ(make(a, "8", {"--force"}).status, 0);
  EXPECT_NE(read_file(a / "office.map"), read_file(b / "office.map"));
}

TEST(MakeOffice, RefusesWhatItCannotDo) {
  const TempFolder folder;
  const std::string map = folder.path() / "office.map";
  const auto make = [&](const std::string& seed, const std::string& out, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"--make-office", seed, "--out", out});
    return study("first-robot", more);
  };
  for (const char* seed : {"-1", "9000000000000000001", "18446744073709551617", "seven", ""})
    expect_refused(make(seed, map), 2, "--make-office");
  expect_refused(make("7", folder.path() / "office.txt"), 2, ".map");
  expect_refused(make("7", folder.path() / "no/office.map"), 3, "no/office.map");
  expect_refused(make("7", "/proc/office.map"), 3, "/proc/office.map");
  expect_refused(make("7", map, {"--maps", folder.path() / "nowhere"}), 3, "nowhere/robots/first.map");
  EXPECT_TRUE(files_in(folder.path()).empty());
}

TEST(SonarRoomsStudy, WritesTablesAndChartsTheSameEveryTime) {
  const TempFolder folder;
  const fs::path a = folder.path() / "a", b = folder.path() / "b";
  const Ended ended = study("sonar-rooms", {"--openings", "8", "--threads", "1", "--out", a, "--json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  const Json document = Json::parse(ended.out);
  EXPECT_EQ(document.at("study"), "sonar-rooms");
  EXPECT_EQ(document.at("tables").at("sweeps").size(), 48u) << "of three kinds, with faults and without";
  for (const char* table : {"findings", "parameters", "confusion", "sweeps"}) {
    EXPECT_EQ(read_csv(a / (std::string(table) + ".csv")).size(), document.at("tables").at(table).size() + 1)
        << table;
  }
  expect_charts(document, a, 4);
  const Ended again = study("sonar-rooms", {"--openings", "8", "--threads", "2", "--out", b});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.out.find("--set wall_follower.room_depth_m="), std::string::npos) << again.out;
  expect_same_files(a, b);
}

TEST(SonarRoomsStudy, RefusesWhatItCannotDo) {
  const TempFolder folder;
  const auto rooms = [](const fs::path& out, std::vector<std::string> more = {}) {
    more.insert(more.begin(), {"--out", out, "--openings", "8"});
    return study("sonar-rooms", more);
  };
  const fs::path out = folder.path() / "out";
  const std::string taken = folder.write("taken", "text");
  expect_refused(study("sonar-rooms", {"--openings", "-8", "--out", out}), 2, "--openings");
  expect_refused(study("sonar-rooms", {"--openings", "4", "--out", out}), 2, "--openings");
  expect_refused(rooms(out, {"--first-seed", "-8"}), 2, "--first-seed");
  expect_refused(rooms(out, {"--threads", "0"}), 2, "--threads");
  expect_refused(rooms(out, {"--plugin", "wall_follower"}), 2, "--plugin");
  expect_refused(rooms(out, {"--maps", folder.path() / "nowhere"}), 3, "nowhere/cubicles.toml");
  EXPECT_FALSE(fs::exists(out));
  expect_refused(rooms(taken), 3, "taken");
  expect_refused(rooms("/proc/hallway-study"), 3, "/proc/hallway-study");
  ASSERT_EQ(rooms(out).status, 0);
  expect_refused(rooms(out), 3, "--force");
  EXPECT_EQ(rooms(out, {"--force"}).status, 0);
}

}  // namespace
}  // namespace hallway::test
