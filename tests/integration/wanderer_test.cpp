// SPDX-License-Identifier: MIT
// The plugin `wanderer` drives through whole worlds from free starts, with noise and slip: its body never meets what is solid, says an oracle that shares no
// code with the program, and it never stands for long.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/data.hpp"
#include "support/long_mode.hpp"
#include "support/process.hpp"
#include "support/python.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr double kPeriod_s = 0.1, kLongestStand_s = 10.0;
constexpr double kRadius_m = 0.2, kLow_m = 0.03, kHigh_m = 0.5;  // of the body, in its frame

std::string scenario(const fs::path& map) {
  return "map = \"" + map.string() + "\"\nperiod_s = 0.1\nsteps = 1\n" + R"(
[robot]
start = "free"
radius_m = 0.2
bottom_m = 0.03
top_m = 0.5
[robot.drive]
kind = "differential"
wheel_base_m = 0.3
max_speed_m_s = 0.6
latency_s = 0.03
forward_noise = { mean = 0.0, sigma = 0.05, correlation_s = 1.0 }
angular_noise = { mean = 0.0, sigma = 0.1, correlation_s = 1.0 }
left_slip = { mean = 0.02, sigma = 0.02, correlation_s = 0.5 }
right_slip = { mean = 0.02, sigma = 0.02, correlation_s = 0.5 }
[sensor.bumper]
kind = "bump"
[sensor.wheels]
kind = "encoders"
[[plugin]]
name = "wanderer"
)";
}

class Wanderer : public testing::Test {
 protected:
  void SetUp() override {
    const auto found = python_with_numpy();
    if (!found) GTEST_SKIP() << "no Python with numpy; HALLWAY_PYTHON names one";
    python_ = *found;
  }

  /// What the oracle says of the run of a seed, for a body of that radius.
  Json look(const fs::path& run, double radius_m) const {
    const fs::path said = folder_ / "said.json";
    const std::string command =
        "'" + python_ + "' -B '" + (source_folder() / "tests/integration/body_oracle.py").string() + "' '" +
        run.string() + "' " + std::to_string(radius_m) + " " + std::to_string(kLow_m) + " " +
        std::to_string(kHigh_m) + " > '" + said.string() + "'";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return Json::parse(read_file(said));
  }

  /// Runs the wanderer. @return the shares of the rooms that it entered, by seed
  std::vector<double> expect_free(const fs::path& map, int usual_s) const {
    const std::string file = folder_.write("wander.toml", scenario(map));
    const int first = sized(1, 1001), seeds = sized(1, 20), steps = sized(10 * usual_s, 36'000);
    std::vector<double> shares;
    int contacts = 0;
    for (int seed = first; seed < first + seeds; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      const fs::path out = folder_ / "run";
      const Ended ended = hallway({"run", file, "--quiet", "--force", "--seed", std::to_string(seed),
                                   "--steps", std::to_string(steps), "--out", out});
      EXPECT_EQ(ended.status, 0) << ended.err;
      const Json drive = Json::parse(read_file(out / "metrics.json")).at("drive"),
                 seen = look(out, kRadius_m);
      const double stand_s = kPeriod_s * seen.at("longest_stand_frames").get<double>();
      if (long_mode()) {
        std::printf(
            "seed %d: %.0f m, %d contacts, %d of %d rooms, %d of %d cells, longest stand %.1f s, least gap "
            "%.6f mm\n",
            seed, drive.at("distance_m").get<double>(), drive.at("contacts").get<int>(),
            drive.at("rooms_entered").get<int>(), drive.at("rooms").get<int>(),
            drive.at("cells_visited").get<int>(), drive.at("floor_cells").get<int>(), stand_s,
            1e3 * seen.at("least_gap_m").get<double>());
        std::fflush(stdout);
      }
      EXPECT_EQ(seen.at("poses"), steps);
      EXPECT_GT(seen.at("least_gap_m"), 0.0) << seen;
      EXPECT_LE(stand_s, kLongestStand_s);
      EXPECT_EQ(drive.at("falls"), 0);
      EXPECT_GT(drive.at("distance_m"), 0.1 * kPeriod_s * steps);
      contacts += drive.at("contacts").get<int>();
      shares.push_back(drive.at("rooms_entered").get<double>() / drive.at("rooms").get<double>());
      if (seed == first) {
        EXPECT_LT(look(out, kRadius_m + 0.002).at("least_gap_m"), 0.0) << "a wider body would meet something";
      }
    }
    EXPECT_GT(contacts, 0);
    std::sort(shares.begin(), shares.end());
    return shares;
  }

  TempFolder folder_;
  std::string python_;
};

TEST_F(Wanderer, SeesMostOfTheOffice) {
  const std::vector<double> shares = expect_free(source_folder() / "maps/office.map", 180);
  if (long_mode()) {
    EXPECT_GE(shares.at(shares.size() / 2), 0.5) << "of the rooms, in the median seed";
  }
}

TEST_F(Wanderer, DrivesInAModel) {
  HALLWAY_DATA_OR_SKIP(building, "models/buildings/willowgarage/meshes/willowgarage_visual.dae");
  const fs::path map = folder_ / "willowgarage.map";
  ASSERT_EQ(hallway({"import", building, "--copy", "--out", map}).status, 0);
  expect_free(map, 60);
}

TEST_F(Wanderer, DrivesInAMapOfQuake) {
  HALLWAY_DATA_OR_SKIP(map, "maps/id1/e1m1.map");
  expect_free(map, 60);
}

}  // namespace
}  // namespace hallway::test
