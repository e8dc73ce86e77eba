// SPDX-License-Identifier: MIT
// The conformance suite makes samples of a kind that is made up by its row alone.
#include <string>

#include "unit/conformance/samples.hpp"

namespace hallway::conformance::test {
namespace {

TEST(AnySamples, AreMadeForPluginsThatAreValidated) {
  const DefectivePlugin none("defective_samples", "defective_samples");
  const auto skipped = expect_good(setup_of_samples(none, "made_up"));
  EXPECT_FALSE(skipped.contains("stride") || skipped.contains("input-not-overrun"));
  SuiteSetup setup = none.setup();
  setup.subject.file = TAKES_MADE_UP;
  for (const std::string plugin : {"takes_made_up", "may_take_made_up"}) {
    setup.subject.plugin = plugin;
    EXPECT_EQ(expect_good(setup).contains("frame-tracks"), plugin == "takes_made_up");
  }
}

TEST(AnySamples, DefectsOfPluginsThatTakeThemAreFound) {
  expect_defects_found("made_up", 2);
}

}  // namespace
}  // namespace hallway::conformance::test
