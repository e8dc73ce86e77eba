// SPDX-License-Identifier: MIT
// Runs of a sensor that gives planes: what a plugin is fed, what is recorded of it, and that it is fed the same again.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "base/file.hpp"
#include "base/text.hpp"
#include "cli/small_world.hpp"
#include "support/data.hpp"
#include "support/process.hpp"
#include "support/temp_folder.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Strings = std::vector<std::string>;

/// Answers with what it is fed.
std::string echo() {
  return binary_folder() / "tests/abi/fixtures/echoes_planes.so";
}

std::string scenario(const std::string& name = "loop_corridor") {
  return source_folder() / "maps" / (name + ".toml");
}

Strings noise() {
  return {"--set", "sensor.eyes.noise_m=0.02",     "--set", "sensor.eyes.noise_angle_deg=0.3",
          "--set", "sensor.eyes.noise_end_m=0.005"};
}

Ended run(const fs::path& out, const Strings& more = {}) {
  Strings arguments{"run", scenario(), "--plugin", echo(), "--steps", "80", "--out", out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return hallway(arguments);
}

Ended replay(const fs::path& log, const fs::path& out, const Strings& more = {}) {
  Strings arguments{"replay", log, "--plugin", echo(), "--out", out};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return hallway(arguments);
}

/// The columns of a table from the one of a name on, some of them, row by row.
std::string columns(const fs::path& table, const std::string& first, std::size_t count) {
  std::istringstream lines(read_file(table));
  std::string line, text;
  std::size_t at = 0;
  for (bool header = true; std::getline(lines, line); header = false) {
    const std::vector<std::string_view> fields = split(line, ',');
    if (header)
      at = static_cast<std::size_t>(std::find(fields.begin(), fields.end(), first) - fields.begin());
    for (std::size_t i = 0; i < count; ++i) text += std::string(fields.at(at + i)) + ",";
    text += "\n";
  }
  return text;
}

/// What a run answered, which is what it was fed.
void expect_same_answers(const fs::path& a, const fs::path& b) {
  for (const char* file :
       {"trajectory.tum", "planes.csv", "matches.csv", "true_walls.csv", "truth_poses.csv"})
    EXPECT_EQ(read_file(a / file), read_file(b / file)) << file << " of " << b;
}

class PlaneRuns : public testing::Test {
 protected:
  void SetUp() override {
    const Ended ended = run(first(), noise());
    ASSERT_EQ(ended.status, 0) << ended.err;
  }
  fs::path first() const { return folder_ / "first"; }
  fs::path out(const std::string& name) const { return folder_ / name; }

  TempFolder folder_;
};

TEST_F(PlaneRuns, RecordWhatIsFed) {
  // 19 columns of geometry, which the echo has put down too.
  EXPECT_EQ(columns(first() / "observed_planes.csv", "nx", 19), columns(first() / "planes.csv", "nx", 19));
  EXPECT_FALSE(fs::exists(first() / "observations.csv"));
  EXPECT_FALSE(fs::exists(first() / "truth_landmarks.csv"));
  const auto manifest = nlohmann::ordered_json::parse(read_file(first() / "run.json"));
  EXPECT_EQ(manifest.at("sensors").at(0).at("kind"), "planes");
  EXPECT_EQ(manifest.at("sensors").at(0).at("noise_m"), nlohmann::ordered_json({0.02, 0.02, 0.0}));
  // The walls that were seen are true ones.
  const std::string walls = read_file(first() / "true_walls.csv");
  std::istringstream ids(columns(first() / "observed_planes.csv", "wall_id", 1));
  std::string id;
  for (std::getline(ids, id); std::getline(ids, id);)
    ASSERT_NE(walls.find("\n" + id), std::string::npos) << id;
}

TEST_F(PlaneRuns, AreReplayedFromEveryFormOfTheRecord) {
  ASSERT_EQ(replay(first(), out("folder")).status, 0);
  ASSERT_EQ(replay(first() / "run.mcap", out("mcap")).status, 0);
  ASSERT_EQ(replay(first() / "observed_planes.csv", out("csv"), {"--in-process"}).status, 0);
  for (const char* name : {"folder", "mcap", "csv"}) expect_same_answers(first(), out(name));
}

TEST_F(PlaneRuns, AreTheSameInThisProcessAndOnAnyNumberOfThreads) {
  Strings more = noise();
  more.insert(more.end(), {"--in-process", "--threads", "2"});
  ASSERT_EQ(run(out("again"), more).status, 0);
  expect_same_answers(first(), out("again"));
  EXPECT_EQ(read_file(first() / "observed_planes.csv"), read_file(out("again") / "observed_planes.csv"));
}

TEST_F(PlaneRuns, DifferBySeedAndNoise) {
  ASSERT_EQ(run(out("exact")).status, 0);
  Strings other = noise();
  other.insert(other.end(), {"--seed", "2"});
  ASSERT_EQ(run(out("seed"), other).status, 0);
  const auto planes = [&](const fs::path& run) { return read_file(run / "observed_planes.csv"); };
  EXPECT_NE(planes(first()), planes(out("exact")));
  EXPECT_NE(planes(first()), planes(out("seed")));
  EXPECT_EQ(read_file(first() / "true_walls.csv"), read_file(out("seed") / "true_walls.csv"));
}

TEST_F(PlaneRuns, AreConvertedThereAndBack) {
  ASSERT_EQ(hallway({"log", "convert", first() / "run.mcap", "--out", out("tables")}).status, 0);
  for (const char* file : {"observed_planes.csv", "true_walls.csv", "truth_poses.csv"})
    EXPECT_EQ(read_file(first() / file), read_file(out("tables") / file)) << file;
  const fs::path log = out("back.mcap");
  ASSERT_EQ(hallway({"log", "convert", out("tables"), "--out", log}).status, 0);
  ASSERT_EQ(replay(log, out("again")).status, 0);
  expect_same_answers(first(), out("again"));
}

TEST_F(PlaneRuns, HaveTheTrueWallsInTheirLogAndNoTracks) {
  const Ended ended = hallway({"log", "info", first() / "run.mcap", "--json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.out.find("/hallway/truth/walls"), std::string::npos);
  EXPECT_EQ(hallway({"replay", first(), "--plugin", echo(), "--ids-as-tracks", "--out", out("x")}).status, 2);
}

TEST_F(PlaneRuns, AreNotForPluginsThatWantPoints) {
  const Ended ended =
      hallway({"run", scenario(), "--plugin", "slam_point", "--steps", "5", "--out", out("points")});
  EXPECT_EQ(ended.status, 3);
  EXPECT_NE(ended.err.find("needs points, which no sensor gives; the sensors give: planes"),
            std::string::npos)
      << ended.err;
}

TEST_F(PlaneRuns, SayWhatIsWrongInATableOfPlanes) {
  const auto refused = [&](const std::string& text, const std::string& why) {
    const Ended ended = replay(folder_.write("bad.csv", text), out("bad"), {"--force"});
    EXPECT_EQ(ended.status, 3) << ended.err;
    EXPECT_NE(ended.err.find(why), std::string::npos) << ended.err;
  };
  const std::string plain = "iteration,nx,ny,nz,offset_m,cx,cy,cz,x0,y0,z0,x1,y1,z1,x2,y2,z2,x3,y3,z3\n";
  const std::string good = "0,0,0,-1,-1,0,0,1,1,1,1,1,-1,1,-1,-1,1,-1,1,1\n";
  EXPECT_EQ(replay(folder_.write("good.csv", plain + good), out("good")).status, 0);
  refused(plain + "0,0,0,-2,-2,0,0,1,1,1,1,1,-1,1,-1,-1,1,-1,1,1\n", "iteration 0");
  refused(plain + "0,0,0,-1,-1,0,0,1\n", "bad.csv:2");
  refused("iteration,nx,ny,offset_m\n0,0,0,1\n", "nz");
}

struct BadSensor {
  const char* name;
  const char* lines;    ///< behind `kind = "planes"`
  const char* message;  ///< in the message
};

class PlaneSensors : public testing::TestWithParam<BadSensor> {};

TEST_P(PlaneSensors, AreRefused) {
  const TempFolder folder;
  folder.write("small.map", small_map());
  const std::string file =
      folder.write("a.toml",
                   "map = \"small.map\"\nsteps = 2\n[robot]\npath = \"straight\"\nspeed_m_s = "
                   "1\n[sensor.eyes]\nkind = \"planes\"\n" +
                       std::string(GetParam().lines) + "\n[[plugin]]\nname = \"echoes_planes\"\n");
  const Ended ended = hallway({"run", file, "--plugin", echo(), "--out", folder / "out"});
  EXPECT_EQ(ended.status, 3) << ended.err;
  EXPECT_NE(ended.err.find("a.toml:8"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("sensor.eyes."), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find(GetParam().message), std::string::npos) << ended.err;
}

INSTANTIATE_TEST_SUITE_P(Bad, PlaneSensors,
                         testing::Values(BadSensor{"OfPoints", "noise_per_m = 0.1", "unknown key"},
                                         BadSensor{"NotLevel", "pitch_deg = 3", "unknown key"},
                                         BadSensor{"ThreeNoises", "noise_m = [1, 2, 3]", "number"},
                                         BadSensor{"Occlusion", "occlusion = 1", "true or false"},
                                         BadSensor{"Sides", "bounded_sides = \"no\"", "true or false"},
                                         BadSensor{"Angle", "noise_angle_deg = -0.1", "out of range"},
                                         BadSensor{"End", "noise_end_m = -1", "out of range"},
                                         BadSensor{"Length", "min_length_m = -1", "out of range"},
                                         BadSensor{"Misspelt", "oclusion = true", "occlusion"},
                                         BadSensor{"Ranges", "min_range_m = 200", "above max_range_m"}),
                         [](const auto& bad) { return std::string(bad.param.name); });

TEST(PlaneSensorKinds, AreNamedWhereOneIsMisspelt) {
  const TempFolder folder;
  folder.write("small.map", small_map());
  const std::string file = folder.write(
      "a.toml", replaced(small_scenario(), "kind = \"points\"", "kind = \"plane\"\nocclusion = true"));
  const Ended ended = hallway({"run", file, "--out", folder / "out"});
  EXPECT_EQ(ended.status, 3);
  EXPECT_NE(ended.err.find("points, planes"), std::string::npos) << ended.err;
}

TEST(PlaneSensorWays, MustBeLevel) {
  const TempFolder folder;
  const Ended ended = hallway({"run", scenario("office"), "--plugin", echo(), "--set",
                               "sensor.eyes.kind=planes", "--out", folder / "out"});
  EXPECT_EQ(ended.status, 3);
  EXPECT_NE(ended.err.find("level"), std::string::npos) << ended.err;
  EXPECT_FALSE(fs::exists(folder / "out"));
}

}  // namespace
}  // namespace hallway::test
