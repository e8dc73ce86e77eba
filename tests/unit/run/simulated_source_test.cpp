// SPDX-License-Identifier: MIT
#include "run/simulated_source.hpp"

#include <gtest/gtest.h>

#include <string>

#include "base/error.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"
#include "unit/sim/small_world.hpp"

namespace hallway::run {
namespace {

const char* const kSensorInMap =
    "{\n\"classname\" \"hw_sensor\"\n\"name\" \"nose\"\n\"noise_m\" \"0.25\"\n}\n";

/// Writes scenario and map and calls `use` with the source that they give.
template <typename Use>
void with_source(const std::string& sensors, const std::string& entities, const Use& use) {
  const test::TempFolder folder;
  folder.write("small.map", test::map_text("", entities));
  const sim::Scenario scenario = sim::load_scenario(folder.write("s.toml", test::scenario_text(sensors)));
  const sim::Simulator simulator(scenario, 1, trace::Backend::kBruteForce);
  use(SimulatedSource(simulator));
}

TEST(SimulatedSource, HasTheSensorOfTheScenarioOrElseOfItsMap) {
  with_source("", kSensorInMap, [](const SimulatedSource& source) {
    EXPECT_EQ(source.sensor().name, "nose");
    EXPECT_EQ(source.sensor().noise_m[1], 0.25);
  });
  with_source("[sensor.eyes]\nkind = 'points'\n", kSensorInMap,
              [](const SimulatedSource& source) { EXPECT_EQ(source.sensor().name, "eyes"); });
}

TEST(SimulatedSource, SaysWhereSensorsComeFromWhereThereIsNoneOrAreTwo) {
  const std::string two =
      std::string(kSensorInMap) + "{\n\"classname\" \"hw_sensor\"\n\"name\" \"tail\"\n}\n";
  for (const std::string& entities : {std::string(), two}) {
    const auto error = test::error_of([&] { with_source("", entities, [](const SimulatedSource&) {}); });
    ASSERT_TRUE(error.has_value());
    EXPECT_EQ(error->code(), ErrorCode::kBadInput);
    EXPECT_TRUE(error->where().file.ends_with("s.toml"));
    for (const char* part : {"[sensor.NAME]", "hw_sensor", entities.empty() ? "there are 0" : "there are 2"})
      EXPECT_NE(error->message().find(part), std::string::npos) << error->what();
  }
}

}  // namespace
}  // namespace hallway::run
