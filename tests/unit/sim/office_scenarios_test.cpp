// SPDX-License-Identifier: MIT
// The offices of the first robot in maps/.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "sim/simulator.hpp"
#include "support/data.hpp"

namespace hallway::sim {
namespace {

Scenario shipped(const std::string& name) {
  return load_scenario(test::source_folder() / "maps" / (name + ".toml"));
}

class OfficeScenario : public testing::TestWithParam<const char*> {};

TEST_P(OfficeScenario, HasASealedMapWithoutProblems) {
  const Simulator simulator(shipped(GetParam()), 1, trace::Backend::kEmbree);
  for (const Error& problem : simulator.problems()) ADD_FAILURE() << problem.what();
  EXPECT_TRUE(simulator.compiled().sealed());
}

TEST_P(OfficeScenario, DiffersFromThatWithFaultsByFaultsOnly) {
  const Scenario plain = shipped(GetParam()), faulty = shipped(std::string(GetParam()) + "_faults");
  std::set<std::string> changed;
  const auto value = [](const Scenario& scenario, const std::string& key) {
    for (const Setting& setting : scenario.settings)
      if (setting.key == key) return setting.value;
    return std::string("none");
  };
  for (const Scenario* scenario : {&plain, &faulty})
    for (const Setting& setting : scenario->settings)
      if (value(plain, setting.key) != value(faulty, setting.key)) changed.insert(setting.key);
  std::set<std::string> expected{"robot.drive.turn_slip",    "robot.drive.turn_slip_noise",
                                 "sensor.sonar.missed_rate", "sensor.sonar.false_rate",
                                 "sensor.sonar.crosstalk",   "material.*white*.echo_deg"};
  for (const std::string detector : {"left", "front-left", "front", "front-right", "right"})
    for (const std::string key : {"noise_per_m", "missed_rate", "false_rate"})
      expected.insert("sensor.ir-" + detector + "." + key);
  EXPECT_EQ(changed, expected);
  EXPECT_EQ(faulty.robot.driven->drive.turn_slip, 0.25);
  EXPECT_EQ(faulty.robot.driven->drive.turn_slip_noise, 0.1);
  EXPECT_EQ(plain.robot.driven->drive.turn_slip, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Maps, OfficeScenario, testing::Values("cubicles", "cubicles_changed", "two_loops"),
                         [](const auto& scenario) { return std::string(scenario.param); });

}  // namespace
}  // namespace hallway::sim
