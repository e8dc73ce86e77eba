// SPDX-License-Identifier: MIT
#include "slam_point/core/options.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <stdexcept>
#include <string>

#include "slam_point/core/mapper.hpp"

namespace hallway::slam_point {
namespace {

TEST(Options, DefaultsAreInRange) {
  EXPECT_NO_THROW(Options().validate());
}

TEST(Options, EachParameterIsCheckedAtBothEnds) {
  for (const OptionRow<Options>& parameter : parameters()) {
    const double margin = parameter.whole != nullptr ? 1.0 : 0.01 * (parameter.max - parameter.min);
    for (const double value : {parameter.min - margin, parameter.max + margin}) {
      Options options;
      parameter.set(options, value);
      try {
        Mapper mapper(options);
        FAIL() << parameter.name << " = " << value << " was accepted";
      } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find(parameter.name), std::string::npos) << error.what();
      }
    }
  }
}

TEST(Options, NotANumberIsRefused) {
  Options options;
  options.noise_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(options.validate(), std::invalid_argument);
}

TEST(Options, ParametersHaveDistinctNamesAndAreFoundByThem) {
  std::set<std::string> names;
  for (const OptionRow<Options>& parameter : parameters()) {
    EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name;
    EXPECT_EQ(find_option(parameters(), parameter.name), &parameter);
    EXPECT_NE(parameter.real != nullptr, parameter.whole != nullptr) << parameter.name;
    EXPECT_STRNE(parameter.help, "");
  }
  EXPECT_EQ(find_option(parameters(), "no_such"), nullptr);
}

TEST(Options, BoundsThatAreZeroFollowTheNoise) {
  Options options;
  options.noise_m = 0.1;
  EXPECT_DOUBLE_EQ(options.match_bound(), 1.2);
  EXPECT_DOUBLE_EQ(options.map_bound(), 1.6);
  options.map_bound_m = 3.0;
  EXPECT_DOUBLE_EQ(options.map_bound(), 3.0);
}

TEST(Options, BoundsDeriveFromNoLessThanTheirLeastNoise) {
  Options options;
  options.noise_m = 1e-4;
  EXPECT_DOUBLE_EQ(options.match_bound(), 12e-4);
  options.least_bound_noise_m = 0.01;
  EXPECT_DOUBLE_EQ(options.match_bound(), 0.12);
  EXPECT_DOUBLE_EQ(options.map_bound(), 0.16);
  EXPECT_DOUBLE_EQ(options.separation(), 0.05);
  options.noise_m = 0.02;
  EXPECT_DOUBLE_EQ(options.match_bound(), 0.24) << "a larger noise counts";
  options.match_bound_m = 0.003;
  EXPECT_DOUBLE_EQ(options.match_bound(), 0.003) << "what is set stands";
}

}  // namespace
}  // namespace hallway::slam_point
