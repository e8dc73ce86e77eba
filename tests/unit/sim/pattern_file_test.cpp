// SPDX-License-Identifier: MIT
#include "sim/pattern_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "sim/simulator.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"
#include "unit/sim/small_world.hpp"

namespace hallway::sim {
namespace {

constexpr const char* kHead = "azimuth_deg,elevation_deg,t_s\n";

TEST(PatternFile, HasTheBeamsInItsOrder) {
  const sense::RayPattern pattern =
      parse_pattern("t_s,ring,elevation_deg,azimuth_deg\n0.05,3,-10,90\n0,1,0,-180\n", "p.csv", 0.1);
  ASSERT_EQ(pattern.rays.size(), 2u);
  EXPECT_DOUBLE_EQ(pattern.rays[0].azimuth_rad, 0.5 * std::numbers::pi);
  EXPECT_DOUBLE_EQ(pattern.rays[0].elevation_rad, -10.0 * std::numbers::pi / 180.0);
  EXPECT_DOUBLE_EQ(pattern.rays[0].share, 0.5);
  EXPECT_EQ(pattern.rays[0].ring, 3u);
  EXPECT_EQ(pattern.rays[1].share, 0.0);
  EXPECT_EQ(pattern.width, 0u);
  EXPECT_EQ(pattern.height, 0u);
}

struct BadPattern {
  const char* name;
  std::string text;
  int line;
  std::string cause;
};

class BadPatterns : public testing::TestWithParam<BadPattern> {};

TEST_P(BadPatterns, AreRefusedWithTheLine) {
  const auto error = hallway::test::error_of([&] { parse_pattern(GetParam().text, "p.csv", 0.1); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_EQ(error->where().file, "p.csv");
  EXPECT_EQ(error->where().line, GetParam().line) << error->what();
  EXPECT_NE(std::string(error->what()).find(GetParam().cause), std::string::npos) << error->what();
}

std::string with_head(const std::string& rows) {
  return kHead + rows;
}

INSTANTIATE_TEST_SUITE_P(
    All, BadPatterns,
    testing::Values(BadPattern{"NotANumber", with_head("0,0,0\nnan,0,0\n"), 3, "a finite number"},
                    BadPattern{"Infinite", with_head("0,inf,0\n"), 2, "a finite number"},
                    BadPattern{"Text", with_head("left,0,0\n"), 2, "a finite number"},
                    BadPattern{"Azimuth", with_head("361,0,0\n"), 2, "-360 to 360"},
                    BadPattern{"Elevation", with_head("0,-90.5,0\n"), 2, "-90 to 90"},
                    BadPattern{"BeforeTheScan", with_head("0,0,-0.001\n"), 2, "from 0 to below 0.1"},
                    BadPattern{"AtItsEnd", with_head("0,0,0.1\n"), 2, "from 0 to below 0.1"},
                    BadPattern{"None", with_head(""), 1, "there is no beam"},
                    BadPattern{"FieldMissing", with_head("0,0\n"), 2, ""},
                    BadPattern{"ColumnMissing", "azimuth_deg,elevation_deg\n0,0\n", 1, "t_s"},
                    BadPattern{"Cut", with_head("0,0,0\n1,1,0"), 3, ""}, BadPattern{"Empty", "", 0, "is empty"}),
    [](const auto& bad) { return std::string(bad.param.name); });

TEST(PatternFile, HasALimit) {
  std::string rows;
  for (std::size_t i = 0; i < sense::kMostRays; ++i) rows += "1,2,0\n";
  EXPECT_EQ(parse_pattern(with_head(rows), "p.csv", 1.0).rays.size(), sense::kMostRays);
  const auto error =
      hallway::test::error_of([&] { parse_pattern(with_head(rows + "1,2,0\n"), "p.csv", 1.0); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->where().line, static_cast<int>(sense::kMostRays) + 2);
}

class PatternOfALidar : public testing::Test {
 protected:
  std::unique_ptr<Simulator> make(const std::string& keys) {
    folder_.write("small.map", hallway::test::map_text(hallway::test::pillars()));
    const std::string text = hallway::test::scenario_text("[sensor.s]\nkind = 'lidar'\n" + keys);
    return std::make_unique<Simulator>(load_scenario(folder_.write("s.toml", text)), 1,
                                       trace::Backend::kBruteForce);
  }
  hallway::test::TempFolder folder_;
};

TEST_F(PatternOfALidar, MeasuresAsRingsAndColumnsOfTheSameBeamsDo) {
  std::string rows = kHead;
  for (const double elevation : {-5.0, 5.0}) {
    for (int column = 0; column < 36; ++column)
      rows += std::to_string(-180 + 10 * column) + "," + std::to_string(elevation) + "," +
              std::to_string(0.2 * column / 36.0) + "\n";
  }
  folder_.write("beams.csv", rows);
  const auto table = make("rate_hz = 5\npattern = 'beams.csv'\n");
  const auto spin =
      make("rate_hz = 5\nrings = 2\nlowest_deg = -5\nhighest_deg = 5\ncolumns = 36\nstep_deg = 10\n");
  const Frame a = table->step(4), b = spin->step(4);
  ASSERT_EQ(a.readings.size(), 1u);
  ASSERT_EQ(b.readings.size(), 1u);
  const auto &x = std::get<LidarSensed>(a.readings[0].sensed).reading.range_m,
             &y = std::get<LidarSensed>(b.readings[0].sensed).reading.range_m;
  ASSERT_EQ(x.size(), y.size());
  int hits = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::isinf(x[i]) || std::isinf(y[i])) continue;
    EXPECT_NEAR(x[i], y[i], 1e-5) << "times are of six decimals";
    ++hits;
  }
  EXPECT_GT(hits, 10);
}

TEST_F(PatternOfALidar, GoesBeforeThePresetsRingsAndNotTogetherWithOnes) {
  folder_.write("beams.csv", std::string(kHead) + "0,0,0\n");
  EXPECT_EQ(
      std::get<sense::LidarSpec>(make("preset = 'lidar16'\npattern = 'beams.csv'\n")->scenario().sensors[0])
          .pattern.rays.size(),
      1u);
  for (const char* key : {"rings = 4\n", "clockwise = true\n", "step_deg = 1\n"}) {
    const auto error =
        hallway::test::error_of([&] { make(std::string("rate_hz = 10\npattern = 'beams.csv'\n") + key); });
    ASSERT_TRUE(error) << key;
    EXPECT_NE(std::string(error->what()).find("together with `pattern`"), std::string::npos) << error->what();
    EXPECT_EQ(error->where().line, 12);
  }
  const auto missing = hallway::test::error_of([&] { make("rate_hz = 10\npattern = 'none.csv'\n"); });
  ASSERT_TRUE(missing);
  EXPECT_EQ(missing->code(), ErrorCode::kIo);
}

}  // namespace
}  // namespace hallway::sim
