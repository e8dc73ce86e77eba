// SPDX-License-Identifier: MIT
// What a plugin finds reaches the plugins behind it, in this process and in processes of their own alike.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "fixtures.hpp"
#include "support/errors.hpp"

namespace hallway::host {
namespace {

using test_fixtures::frame_of;
using test_fixtures::point_sensors;

const std::string kFixtures = FIXTURES;
const std::string kEm = std::string(PLUGINS) + "/em.so:em";
const std::string kLevels = kFixtures + "/levels.so";
const std::string kReadsPlanes = kFixtures + "/reads_planes.so:reads_planes";
const std::string kReadsBoth = kFixtures + "/reads_planes.so:reads_both";

/// A floor and two walls, a little rough, seen from a place that moves with the step.
std::vector<hw_point3_t> corner_of_a_room(std::uint64_t step) {
  std::vector<hw_point3_t> points;
  const double away = 3.0 + 0.05 * static_cast<double>(step);
  for (int i = 0; i < 30; ++i) {
    for (int k = 0; k < 30; ++k) {
      const double rough = 0.004 * std::sin(1.0 + 12.9898 * i + 78.233 * k + static_cast<double>(step));
      const double a = 0.1 * i + 0.03 * std::sin(3.0 * k);
      const double b = 0.1 * k + 0.03 * std::sin(5.0 * i);
      points.push_back({away - a, 1.5 - b, -1.0 + rough});
      points.push_back({away + rough, 1.5 - a, -1.0 + b});
      points.push_back({away - a, 1.5 + rough, -1.0 + b});
    }
  }
  return points;
}

std::map<std::string, double> counters_of(const Outputs& outputs) {
  std::map<std::string, double> counters;
  for (const Counter& counter : outputs.counters()) counters[counter.name] = counter.value;
  return counters;
}

/// What the last plugin answers to a few frames.
std::vector<std::map<std::string, double>> answers(const std::vector<StageSpec>& stages,
                                                   const std::optional<Isolation>& isolation) {
  Pipeline pipeline(stages, {}, point_sensors(), {}, isolation);
  std::vector<std::map<std::string, double>> all;
  FrameBuilder builder;
  for (std::uint64_t step = 0; step < 4; ++step) {
    all.push_back(counters_of(pipeline.process(frame_of(builder, step, corner_of_a_room(step)))));
  }
  pipeline.close();
  return all;
}

TEST(PipelinePlanes, ReachThePluginBehindWithThePointsThatTheyWereFoundIn) {
  const auto found = answers({{kEm, {}}, {kReadsBoth, {}}}, {});
  for (const auto& counters : found) {
    EXPECT_EQ(counters.at("planes"), 3);
    EXPECT_GT(counters.at("members"), 2000);
    EXPECT_GE(counters.at("hull_points"), 12);
    EXPECT_EQ(counters.at("found_in_points"), 1);
  }
  EXPECT_NE(found[0].at("digest"), found[1].at("digest"));
}

TEST(PipelinePlanes, AreTheSameBytesInProcessesOfTheirOwn) {
  for (const std::string& reader : {kReadsBoth, kReadsPlanes}) {
    const std::vector<StageSpec> stages = {{kEm, {}}, {reader, {}}};
    EXPECT_EQ(answers(stages, {}), answers(stages, Isolation{})) << reader;
  }
}

TEST(PipelinePlanes, OfASampleThatIsNotTakenHaveNoMembers) {
  const auto with_points = answers({{kEm, {}}, {kReadsBoth, {}}}, {});
  const auto without = answers({{kEm, {}}, {kReadsPlanes, {}}}, {});
  for (std::size_t step = 0; step < without.size(); ++step) {
    EXPECT_EQ(without[step].at("planes"), with_points[step].at("planes"));
    EXPECT_EQ(without[step].at("hull_points"), with_points[step].at("hull_points"));
    EXPECT_EQ(without[step].at("members"), 0);
    EXPECT_EQ(without[step].at("found_in_points"), 0);
  }
}

TEST(PipelinePlanes, OfSeveralPluginsStandBesideEachOther) {
  const std::vector<StageSpec> levels = {{kLevels, {{"step_m", "1", {}}}}, {kReadsBoth, {}}};
  const std::vector<StageSpec> both = {{kEm, {}}, {kLevels, {{"step_m", "1", {}}}}, {kReadsBoth, {}}};
  const auto of_levels = answers(levels, {});
  const auto of_both = answers(both, {});
  ASSERT_GE(of_levels[0].at("planes"), 1);
  EXPECT_EQ(of_both[0].at("planes"), of_levels[0].at("planes") + 3);
  EXPECT_EQ(of_both[0].at("found_in_points"), 2);
  EXPECT_EQ(of_both, answers(both, Isolation{}));
}

TEST(PipelinePlanes, TakeTheirTurnOnlyWhereAPluginReadsThem) {
  const Pipeline apart({{kEm, {}}, {kEm.substr(0, kEm.size() - 2) + "em2", {}}}, {}, point_sensors(), {},
                       Isolation{});
  EXPECT_GT(apart.capacity(), 1u);
  Pipeline in_turn({{kEm, {}}, {kReadsPlanes, {}}}, {}, point_sensors(), {}, Isolation{});
  EXPECT_EQ(in_turn.capacity(), 1u);
  FrameBuilder builder;
  const hw_frame_t& frame = frame_of(builder, 0, corner_of_a_room(0));
  in_turn.submit(frame);
  EXPECT_TRUE(test::error_of([&] { in_turn.submit(frame); }));
  EXPECT_EQ(counters_of(in_turn.collect()).at("planes"), 3);
  EXPECT_TRUE(test::error_of([&] { in_turn.collect(); }));
}

TEST(PipelinePlanes, OfAFrameWithoutSamplesAreNoneAndNobodyIsCalled) {
  for (const bool isolated : {false, true}) {
    Pipeline pipeline({{kEm, {}}, {kReadsPlanes, {}}}, {}, point_sensors(), {},
                      isolated ? std::optional(Isolation{}) : std::nullopt);
    FrameBuilder builder;
    builder.begin(0, 0);
    EXPECT_TRUE(pipeline.process(builder.finish()).counters().empty());
    EXPECT_FALSE(pipeline.was_called());
    EXPECT_EQ(counters_of(pipeline.process(frame_of(builder, 1, corner_of_a_room(0)))).at("planes"), 3);
    EXPECT_TRUE(pipeline.was_called());
  }
}

}  // namespace
}  // namespace hallway::host
