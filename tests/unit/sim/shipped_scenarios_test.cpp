// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include "sim/simulator.hpp"
#include "support/data.hpp"

namespace hallway::sim {
namespace {

class ShippedScenario : public testing::TestWithParam<const char*> {
 protected:
  Scenario load() const { return load_scenario(test::source_folder() / "maps" / GetParam()); }
};

TEST_P(ShippedScenario, HasAMapWithoutProblemsAndAFreeWay) {
  const Simulator simulator(load(), 1, trace::Backend::kEmbree);
  for (const Error& problem : simulator.problems()) ADD_FAILURE() << problem.what();
}

TEST_P(ShippedScenario, AlwaysSeesSomething) {
  const Simulator simulator(load(), 2, trace::Backend::kEmbree);
  const std::uint32_t stride = simulator.scenario().steps / 200 + 1;
  for (std::uint32_t i = 0; i < simulator.scenario().steps; i += stride) {
    EXPECT_GE(simulator.step(i).readings.at(0).observations().size(), 10u) << "step " << i;
  }
}

TEST_P(ShippedScenario, ClosesItsLoop) {
  const Simulator simulator(load(), 1, trace::Backend::kEmbree);
  ASSERT_TRUE(simulator.path().closed());
  EXPECT_GE(simulator.step_length_m() * simulator.scenario().steps,
            simulator.path().length_m() * (1 - 1e-12));
}

TEST_P(ShippedScenario, WantsATopAndAPerspectivePicture) {
  const Scenario scenario = load();
  ASSERT_EQ(scenario.pictures.size(), 2u);
  EXPECT_EQ(scenario.pictures[0].view, PictureView::kTop);
  EXPECT_EQ(scenario.pictures[1].view, PictureView::kPerspective);
}

TEST(Office, IsSealedAndUsesVisibleSets) {
  const Simulator simulator(load_scenario(test::source_folder() / "maps" / "office.toml"), 1,
                            trace::Backend::kEmbree);
  EXPECT_TRUE(simulator.compiled().sealed());
  ASSERT_TRUE(simulator.compiled().visible.has_value());
  EXPECT_LT(simulator.compiled().visible->mean_share(), 0.8);
}

TEST(Office, ItsRoundKeepsHalfAMetreFromEverything) {
  Scenario scenario = load_scenario(test::source_folder() / "maps" / "office.toml");
  scenario.robot.body = bsp::Cylinder{0.5, -0.7, 0.7};
  const Simulator simulator(scenario, 1, trace::Backend::kEmbree);
  EXPECT_TRUE(simulator.problems().empty()) << simulator.problems().front().what();
  scenario.robot.body = bsp::Cylinder{0.65, -0.7, 0.7};  // the corridor's wall is 0.6 m from the start
  EXPECT_THROW(Simulator(scenario, 1, trace::Backend::kEmbree), Error);
}

INSTANTIATE_TEST_SUITE_P(Maps, ShippedScenario, testing::Values("figure_eight.toml", "office.toml"),
                         [](const testing::TestParamInfo<const char*>& scenario) {
                           const std::string file = scenario.param;
                           return file.substr(0, file.find('.'));
                         });

}  // namespace
}  // namespace hallway::sim
