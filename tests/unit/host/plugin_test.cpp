// SPDX-License-Identifier: MIT
#include "host/plugin.hpp"

#include <gtest/gtest.h>

#include "fixtures.hpp"
#include "support/errors.hpp"

namespace hallway::host {
namespace {

using test_fixtures::find_fixture;
using test_fixtures::frame_of;
using test_fixtures::point_sensors;

TEST(Plugin, DeclaresItsParameters) {
  Plugin plugin(find_plugin(EXAMPLE, {}));
  ASSERT_EQ(plugin.parameters().size(), 1u);
  EXPECT_EQ(plugin.parameters()[0].name, "bound_m");
  EXPECT_EQ(plugin.parameter_text(0), "0.25");
}

TEST(Plugin, WithoutTheExtensionItHasNoParameters) {
  Plugin plugin(find_fixture("minimal.so"));
  EXPECT_TRUE(plugin.parameters().empty());
}

TEST(Plugin, AParameterKeepsWhatWasSet) {
  Plugin plugin(find_plugin(EXAMPLE, {}));
  plugin.set_parameter("bound_m", "0.5");
  EXPECT_EQ(plugin.parameter_text(0), "0.5");
}

TEST(Plugin, AnUnknownParameterIsRefusedWhereItStands) {
  Plugin plugin(find_plugin(EXAMPLE, {}));
  const auto error = test::error_of([&] { plugin.set_parameter("bound", "1", {"a.toml", 12, ""}); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_EQ(error->where().file, "a.toml");
  EXPECT_EQ(error->where().line, 12);
  EXPECT_NE(error->message().find("`bound` (did you mean \"bound_m\"?); it has: bound_m"), std::string::npos)
      << error->message();
}

TEST(Plugin, AValueOutsideOfTheRangeIsRefusedWhereItStands) {
  Plugin plugin(find_plugin(EXAMPLE, {}));
  const auto error = test::error_of([&] { plugin.set_parameter("bound_m", "-1", {"a.toml", 12, ""}); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_EQ(error->where().line, 12);
  EXPECT_NE(error->message().find("from 0 to 100 m"), std::string::npos) << error->message();
  EXPECT_EQ(plugin.parameter_text(0), "0.25");
}

TEST(Plugin, SensorsThatItCannotUseAreBadInput) {
  Plugin plugin(find_plugin(EXAMPLE, {}));
  const auto error = test::error_of([&] { plugin.activate({}); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_NE(error->message().find("no sensor gives points"), std::string::npos) << error->message();
}

TEST(Plugin, MayBeDestroyedAtAnyPointOfItsLife) {
  { Plugin made(find_plugin(EXAMPLE, {})); }
  {
    Plugin active(find_plugin(EXAMPLE, {}));
    active.activate(point_sensors());
  }
  FrameBuilder builder;
  {
    Plugin fed(find_plugin(EXAMPLE, {}));
    fed.activate(point_sensors());
    fed.process(frame_of(builder, 0, {{1, 2, 3}}));
  }
  Plugin next(find_plugin(EXAMPLE, {}));
  next.activate(point_sensors());
  const Outputs& outputs = next.process(frame_of(builder, 0, {{1, 2, 3}}));
  EXPECT_TRUE(outputs.pose()) << "those before it must not have taken anything away";
}

TEST(Plugin, ACallIsTimedByBothClocks) {
  FrameBuilder builder;
  Plugin plugin(find_plugin(EXAMPLE, {}));
  plugin.activate(point_sensors());
  const std::vector<hw_point3_t> many(2000, {1, 2, 3});
  plugin.process(frame_of(builder, 0, many));
  EXPECT_GT(plugin.last_call().wall_ns, 0);
  EXPECT_GT(plugin.last_call().cpu_ns, 0);
}

TEST(Plugin, SamplesOfKindsThatItDoesNotTakeAreLeftOut) {
  hw_sample_t depth{};
  depth.size = sizeof depth;
  depth.kind = HW_SAMPLE_DEPTH;
  depth.payload = &depth;
  FrameBuilder builder;
  const hw_frame_t& points = frame_of(builder, 0, {{1, 2, 3}});
  const hw_sample_t* const samples[] = {&depth, points.samples[0]};
  hw_frame_t frame = points;
  frame.n_samples = 2;
  frame.samples = samples;

  Plugin plugin(find_plugin(EXAMPLE, {}));
  plugin.activate(point_sensors());
  const Outputs& outputs = plugin.process(frame);
  EXPECT_FALSE(outputs.associations(0));
  ASSERT_TRUE(outputs.associations(1));
  EXPECT_EQ(outputs.associations(1)->size(), 1u);
}

TEST(Plugin, TwoInstancesOfOneLibraryKnowNothingOfEachOther) {
  FrameBuilder builder;
  Plugin first(find_plugin(EXAMPLE, {})), second(find_plugin(EXAMPLE, {}));
  first.activate(point_sensors());
  second.activate(point_sensors());
  first.process(frame_of(builder, 0, {{1, 2, 3}}));
  EXPECT_EQ(first.report(false).landmarks().size(), 1u);
  EXPECT_EQ(second.report(false).landmarks().size(), 0u);
}

TEST(Plugin, ItsLogReachesTheSinkWithItsId) {
  std::vector<std::string> lines;
  const LogSink sink = [&](const std::string& plugin, std::uint32_t level, const std::string& message) {
    lines.push_back(plugin + "/" + std::to_string(level) + "/" + message);
  };
  FrameBuilder builder;
  Plugin plugin(find_plugin(EXAMPLE, {}), sink);
  plugin.activate(point_sensors());
  plugin.process(frame_of(builder, 0, {{1, 2, 3}}));
  EXPECT_EQ(lines, std::vector<std::string>{"example_c/1/the map is made"});
}

}  // namespace
}  // namespace hallway::host
