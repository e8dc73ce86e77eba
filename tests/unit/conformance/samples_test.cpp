// SPDX-License-Identifier: MIT
// Plugins of other samples than points are given samples of theirs, and tests of memory and growth hold for these.
#include "unit/conformance/samples.hpp"

#include <map>
#include <string>
#include <vector>

#include "base/helper.hpp"

namespace hallway::conformance::test {
namespace {

/// Expects that a test was skipped since the plugin takes no points, has no parameters or texts, or for what `reason` may begin with.
void expect_reasons(const std::map<std::string, std::string>& skipped, const std::string& also) {
  for (const auto& [test, reason] : skipped) {
    const bool uncounted = reserves_addresses() && test.ends_with("-memory");
    EXPECT_TRUE(reason.starts_with("the plugin takes no ") || test.starts_with("params-") ||
                reason.starts_with(also) || uncounted)
        << test << ": " << reason;
  }
}

TEST(Samples, APluginOfPlanesAloneIsGivenPlanes) {
  const DefectivePlugin none("defective_samples", "defective_samples");
  const auto skipped = expect_good(setup_of_samples(none, "planes"));
  EXPECT_TRUE(skipped.contains("frame-tracks") && skipped.contains("frame-pixels"));
  expect_reasons(skipped, "the plugin refuses no sensors");
}

TEST(Samples, DefectsOfAPluginOfPlanesAreFound) {
  expect_defects_found("planes", 2);
}

TEST(Samples, PluginsOfContactZonesAndEncodersAreGivenThem) {
  const DefectivePlugin none("defective_samples", "defective_samples");
  for (const char* plugin : {"bump", "encoder"})
    expect_reasons(expect_good(setup_of_samples(none, plugin)), "the plugin refuses no sensors");
}

TEST(Samples, DefectsOfPluginsOfContactZonesAndEncodersAreFound) {
  expect_defects_found("bump", 1);
  expect_defects_found("encoder", 1);
}

TEST(Samples, DefectsInReadingIntrinsicsAreFound) {
  expect_intrinsic_defects_found("bump");
  expect_intrinsic_defects_found("encoder");
}

TEST(Samples, PluginsOfTheOtherSensorsOfRobotsAreGivenThem) {
  const DefectivePlugin none("defective_samples", "defective_samples");
  const std::map<std::string, std::vector<std::string>> own{
      {"range_scan", {"scan-no-returns", "scan-no-order", "scan-layers"}},
      {"odometry", {"odometry-unknown"}},
      {"imu", {"imu-missing-axes", "carried-samples"}},
      {"gnss", {"gnss-no-fix", "gnss-later-fix"}},
      {"magnetic", {"magnetic-unknown"}}};
  for (const auto& [plugin, tests] : own) {
    const auto skipped = expect_good(setup_of_samples(none, plugin));
    expect_reasons(skipped, "the plugin refuses no sensors");
    for (const std::string& test : tests) EXPECT_FALSE(skipped.contains(test)) << test;
  }
}

TEST(Samples, DefectsOfPluginsOfRaysAreFound) {
  expect_defects_found("range_scan", 4);
  expect_intrinsic_defects_found("range_scan", false);
  expect_found("range_scan", {{"fails_for_no_returns", "scan-no-returns"},
                              {"fails_for_no_order", "scan-no-order"},
                              {"fails_for_layers", "scan-layers"},
                              {"fails_for_reserved", "reserved-members"}});
}

TEST(Samples, DefectsOfPluginsOfOdometryAreFound) {
  expect_defects_found("odometry", 1, false);
  expect_found("odometry", {{"fails_for_unknown", "odometry-unknown"},
                            {"fails_for_unmeasured", "odometry-unknown"},
                            {"fails_for_reserved", "reserved-members"}});
}

TEST(Samples, DefectsOfPluginsOfImusAreFound) {
  expect_defects_found("imu", 1, false);
  expect_intrinsic_defects_found("imu", false);
  expect_found("imu", {{"fails_for_missing_axes", "imu-missing-axes"},
                       {"fails_for_several", "carried-samples"},
                       {"fails_for_reserved", "reserved-members"}});
}

TEST(Samples, DefectsOfPluginsOfGnssAreFound) {
  expect_defects_found("gnss", 1, false);
  expect_intrinsic_defects_found("gnss", false);
  expect_found("gnss", {{"fails_for_no_fix", "gnss-no-fix"}, {"fails_for_later_fix", "gnss-later-fix"}});
}

TEST(Samples, DefectsOfPluginsOfCompassesAreFound) {
  expect_defects_found("magnetic", 1, false);
  expect_found("magnetic",
               {{"fails_for_unknown", "magnetic-unknown"}, {"fails_for_reserved", "reserved-members"}});
}

TEST(Samples, SlamPlaneIsGivenPlanes) {
  const DefectivePlugin none("defective_samples", "defective_samples");
  SuiteSetup setup = none.setup();
  setup.subject.file = PLUGINS "/slam_plane.so";
  const auto skipped = expect_good(setup);
  expect_reasons(skipped, "the plugin refuses a second sensor");
  EXPECT_FALSE(skipped.contains("params-sensor")) << "its noise is that of the sensor of planes";
}

TEST(Samples, TheExampleThatDrivesIsGood) {
  const DefectivePlugin none("defective_samples", "defective_samples");
  SuiteSetup setup = none.setup();
  setup.subject.file = EXAMPLE_THAT_DRIVES;
  expect_reasons(expect_good(setup), "the plugin refuses no sensors");
}

TEST(Samples, OfAKindThatNoRowHasAreNotMade) {
  const DefectivePlugin none("defective_samples", "defective_samples");
  SuiteSetup setup = setup_of_samples(none, "made_up");
  setup.only = {"outputs-valid", "activate-unknown-kind", "stride"};
  const auto skipped = expect_good(setup);
  for (const std::string& test : setup.only) {
    ASSERT_TRUE(skipped.contains(test)) << test;
    EXPECT_EQ(skipped.at(test), "the plugin needs samples of kind 1000, which this suite does not make");
  }
}

}  // namespace
}  // namespace hallway::conformance::test
