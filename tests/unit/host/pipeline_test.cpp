// SPDX-License-Identifier: MIT
#include "host/pipeline.hpp"

#include <gtest/gtest.h>

#include "fixtures.hpp"
#include "support/errors.hpp"

namespace hallway::host {
namespace {

using test_fixtures::frame_of;
using test_fixtures::point_sensors;

std::optional<Error> problem_of(const std::vector<StageSpec>& stages,
                                const std::vector<SensorInfo>& sensors) {
  return test::error_of([&] { Pipeline pipeline(stages, {}, sensors); });
}

TEST(Pipeline, FeedsItsPluginAndGivesItsOutputs) {
  FrameBuilder builder;
  const std::vector<StageSpec> stages = {{EXAMPLE, {}}};
  Pipeline pipeline(stages, {}, point_sensors());
  EXPECT_TRUE(pipeline.process(frame_of(builder, 0, {{1, 2, 3}})).pose()->valid);
  EXPECT_GT(pipeline.last_call().wall_ns, 0);
  EXPECT_EQ(pipeline.report(false).landmarks().size(), 1u);
}

TEST(Pipeline, SetsParametersBeforeItActivates) {
  FrameBuilder builder;
  const std::vector<StageSpec> stages = {{EXAMPLE, {{"bound_m", "2", {}}}}};
  Pipeline pipeline(stages, {}, point_sensors());
  pipeline.process(frame_of(builder, 0, {{0, 0, 0}}));
  EXPECT_EQ((*pipeline.process(frame_of(builder, 1, {{1.5, 0, 0}})).associations(0))[0], 0u);
}

TEST(Pipeline, EveryStageIsFedAndTheLastOneAnswers) {
  FrameBuilder builder;
  const std::vector<StageSpec> stages = {{std::string(FIXTURES) + "/minimal.so", {}}, {EXAMPLE, {}}};
  Pipeline pipeline(stages, {}, point_sensors());
  ASSERT_EQ(pipeline.size(), 2u);
  EXPECT_TRUE(pipeline.process(frame_of(builder, 0, {{1, 2, 3}})).pose());
  EXPECT_GE(pipeline.last_call().wall_ns, pipeline.stage(1).last_call().wall_ns);
}

TEST(Pipeline, AMissingProducerIsAnErrorBeforeTheRun) {
  const auto error =
      problem_of({{std::string(FIXTURES) + "/misbehaves.so:needs_depth", {}}}, point_sensors());
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_NE(
      error->message().find("`needs_depth` needs depth, which no sensor gives; the sensors give: points"),
      std::string::npos)
      << error->message();
}

TEST(Pipeline, WithoutSensorsNothingIsProduced) {
  const auto error = problem_of({{EXAMPLE, {}}}, {});
  ASSERT_TRUE(error);
  EXPECT_NE(error->message().find("the sensors give: nothing"), std::string::npos) << error->message();
}

TEST(Pipeline, WithoutPluginsIsCalledForNoFrame) {
  FrameBuilder builder;
  Pipeline pipeline(std::vector<StageSpec>{}, {}, point_sensors());
  EXPECT_TRUE(pipeline.started());
  EXPECT_EQ(pipeline.capacity(), 1u);
  for (std::uint64_t i = 0; i < 3; ++i) {
    EXPECT_FALSE(pipeline.process(frame_of(builder, i, {{1, 2, 3}})).pose());
    EXPECT_FALSE(pipeline.was_called());
  }
  EXPECT_TRUE(pipeline.report(true).landmarks().empty());
  EXPECT_NO_THROW(pipeline.restart());
  EXPECT_NO_THROW(pipeline.close());
}

TEST(Pipeline, AnUnknownParameterIsNamedWhereItStands) {
  const auto error = problem_of({{EXAMPLE, {{"bund_m", "2", {"s.toml", 3, ""}}}}}, point_sensors());
  ASSERT_TRUE(error);
  EXPECT_EQ(error->where().file, "s.toml");
  EXPECT_EQ(error->where().line, 3);
}

TEST(Pipeline, AResetForgetsTheMap) {
  FrameBuilder builder;
  const std::vector<StageSpec> stages = {{EXAMPLE, {}}};
  Pipeline pipeline(stages, {}, point_sensors());
  pipeline.process(frame_of(builder, 0, {{1, 2, 3}}));
  pipeline.reset();
  EXPECT_TRUE(pipeline.report(false).landmarks().empty());
}

}  // namespace
}  // namespace hallway::host
