// SPDX-License-Identifier: MIT
#include "sense/ray_pattern.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/errors.hpp"

namespace hallway::sense {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

TEST(RayPattern, OfASpinningScannerIsRowByRow) {
  const RayPattern pattern = spinning_pattern({.from_rad = -90 * kDegree,
                                               .step_rad = 45 * kDegree,
                                               .columns = 5,
                                               .elevations_rad = {-10 * kDegree, 0.0, 10 * kDegree}});
  ASSERT_EQ(pattern.width, 5u);
  ASSERT_EQ(pattern.height, 3u);
  ASSERT_EQ(pattern.rays.size(), 15u);
  for (std::uint32_t row = 0; row < 3; ++row) {
    for (std::uint32_t column = 0; column < 5; ++column) {
      const PatternRay& ray = pattern.rays[row * 5 + column];
      EXPECT_NEAR(ray.azimuth_rad, (-90.0 + 45.0 * column) * kDegree, 1e-15);
      EXPECT_NEAR(ray.elevation_rad, (-10.0 + 10.0 * row) * kDegree, 1e-15);
      EXPECT_NEAR(ray.share, column / 8.0, 1e-15) << "of a whole turn";
      EXPECT_EQ(ray.ring, row);
    }
  }
}

TEST(RayPattern, ClockwiseColumnsComeInTheirOrderToo) {
  const RayPattern pattern = spinning_pattern({.from_rad = 0.0, .step_rad = -1.0 * kDegree, .columns = 360});
  EXPECT_NEAR(pattern.rays[90].azimuth_rad, -90 * kDegree, 1e-14);
  EXPECT_NEAR(pattern.rays[90].share, 0.25, 1e-15);
}

TEST(RayPattern, ASweepThatLeavesATurnIsMovedByOne) {
  const RayPattern pattern =
      spinning_pattern({.from_rad = -180.0 * kDegree, .step_rad = -0.2 * kDegree, .columns = 1800});
  EXPECT_NEAR(pattern.rays[0].azimuth_rad, 180 * kDegree, 1e-12);
  EXPECT_NEAR(pattern.rays[900].azimuth_rad, 0.0, 1e-12);
  EXPECT_NEAR(pattern.rays[1799].azimuth_rad, -179.8 * kDegree, 1e-12);
}

TEST(RayPattern, ElevationsReachBothEnds) {
  const std::vector<double> elevations = equal_elevations(-0.3, 0.1, 5);
  ASSERT_EQ(elevations.size(), 5u);
  EXPECT_EQ(elevations.front(), -0.3);
  EXPECT_NEAR(elevations.back(), 0.1, 1e-16);
  EXPECT_NEAR(elevations[1] - elevations[0], 0.1, 1e-16);
  EXPECT_EQ(equal_elevations(-0.2, 0.4, 1), std::vector<double>{0.1});
}

TEST(RayPattern, AMillionRaysAreTakenAndMoreAreNot) {
  SpinSpec spec{.step_rad = std::numbers::pi / 8192, .columns = 16'384};
  spec.elevations_rad.assign(64, 0.0);
  EXPECT_EQ(spinning_pattern(spec).rays.size(), kMostRays);
  spec.elevations_rad.push_back(0.0);
  const auto error = test::error_of([&] { spinning_pattern(spec); });
  ASSERT_TRUE(error);
  EXPECT_NE(error->message().find("65 rings of 16384 columns"), std::string::npos) << error->message();
}

TEST(RayPattern, RefusesWhatIsNone) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const std::pair<SpinSpec, const char*> bad[] = {
      {{.columns = 0}, "no column"},
      {{.step_rad = 0.0}, "step"},
      {{.step_rad = kNan}, "step"},
      {{.step_rad = 0.01, .columns = 1000}, "more than a turn"},
      {{.from_rad = kNan}, "azimuth"},
      {{.from_rad = 7.0}, "azimuth"},
      {{.elevations_rad = {}}, "no ring"},
      {{.elevations_rad = {1.6}}, "elevation"},
      {{.elevations_rad = {kNan}}, "elevation"},
  };
  for (const auto& [spec, cause] : bad) {
    const auto error = test::error_of([&spec = spec] { spinning_pattern(spec); });
    ASSERT_TRUE(error) << cause;
    EXPECT_EQ(error->code(), ErrorCode::kBadInput);
    EXPECT_NE(error->message().find(cause), std::string::npos) << error->message();
  }
  RayPattern pattern = spinning_pattern({});
  pattern.rays[7].share = 1.0;
  EXPECT_NE(test::error_of([&] { check_pattern(pattern); })->message().find("ray 7"), std::string::npos);
  pattern = spinning_pattern({});
  pattern.width = 1799;
  EXPECT_TRUE(test::error_of([&] { check_pattern(pattern); }));
  EXPECT_TRUE(test::error_of([] { check_pattern({}); }));
}

}  // namespace
}  // namespace hallway::sense
