// SPDX-License-Identifier: MIT
// A plugin in a process of its own gives what it gives in this one: outputs, parameters, errors, log.
#include "host/isolate/isolated_plugin.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>

#include "fixtures.hpp"
#include "support/errors.hpp"

namespace hallway::host {
namespace {

using test_fixtures::find_fixture;
using test_fixtures::frame_of;
using test_fixtures::point_sensors;

const std::string kFixtures = FIXTURES;
const std::string kSlamPoint = std::string(PLUGINS) + "/slam_point.so";

std::unique_ptr<Stage> in_process(const std::string& wanted, const LogSink& log = {}) {
  return std::make_unique<Plugin>(find_plugin(wanted, {}), log);
}

std::unique_ptr<Stage> isolated(const std::string& wanted, const LogSink& log = {}) {
  return std::make_unique<IsolatedPlugin>(wanted, std::span<const std::filesystem::path>{}, Isolation{}, log);
}

/// Points around the robot, seen from a place that moves along a circle.
std::vector<hw_point3_t> seen_at(std::uint64_t step) {
  std::vector<hw_point3_t> points;
  const double angle = 0.02 * static_cast<double>(step);
  for (int i = 0; i < 40; ++i) {
    const double direction = 0.4 * i;
    const double x = 5 * std::cos(direction) - std::sin(angle);
    const double y = 5 * std::sin(direction) + 1 - std::cos(angle);
    points.push_back({std::cos(angle) * x + std::sin(angle) * y, std::cos(angle) * y - std::sin(angle) * x,
                      0.1 * (i % 7)});
  }
  return points;
}

/// Whether two lists hold the same bytes; empty ones may have no address.
template <typename T>
bool same_bytes(std::span<const T> a, std::span<const T> b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}

void expect_same(const Outputs& a, const Outputs& b) {
  ASSERT_EQ(a.pose().has_value(), b.pose().has_value());
  if (a.pose()) {
    EXPECT_EQ(a.pose()->valid, b.pose()->valid);
    EXPECT_EQ(std::memcmp(&a.pose()->T_map_body, &b.pose()->T_map_body, sizeof(hw_pose_t)), 0);
  }
  EXPECT_TRUE(same_bytes(a.landmarks(), b.landmarks()));
  const auto ids_a = a.associations(0);
  const auto ids_b = b.associations(0);
  ASSERT_EQ(ids_a.has_value(), ids_b.has_value());
  if (ids_a) {
    EXPECT_TRUE(std::ranges::equal(*ids_a, *ids_b));
  }
  EXPECT_TRUE(same_bytes(a.submaps(), b.submaps()));
  EXPECT_TRUE(std::ranges::equal(a.all_members(), b.all_members()));
  ASSERT_EQ(a.counters().size(), b.counters().size());
  for (std::size_t i = 0; i < a.counters().size(); ++i) {
    EXPECT_EQ(a.counters()[i].name, b.counters()[i].name);
    EXPECT_EQ(a.counters()[i].value, b.counters()[i].value);
  }
}

TEST(IsolatedPlugin, AReportMayTakeTenCallsAndAMinuteAtMost) {
  const auto report_s = [](int call_s) {
    return Isolation{.call_time = std::chrono::seconds(call_s)}.report_time().count() / 1000;
  };
  EXPECT_EQ(report_s(2), 20);
  EXPECT_EQ(report_s(10), 60);
  EXPECT_EQ(report_s(60), 60);
  EXPECT_EQ(report_s(600), 600);
}

TEST(IsolatedPlugin, GivesTheSameBitsAsInThisProcess) {
  const auto here = in_process(kSlamPoint);
  const auto there = isolated(kSlamPoint);
  FrameBuilder builder;
  for (Stage* stage : {here.get(), there.get()}) stage->activate(point_sensors());
  for (std::uint64_t step = 0; step < 200; ++step) {
    const hw_frame_t& frame = frame_of(builder, step, seen_at(step));
    expect_same(here->process(frame), there->process(frame));
    EXPECT_GT(there->last_call().wall_ns, 0);
  }
  EXPECT_FALSE(here->report(true).landmarks().empty()) << "nothing was compared";
  expect_same(here->report(true), there->report(true));
  for (Stage* stage : {here.get(), there.get()}) stage->reset();
  const hw_frame_t& frame = frame_of(builder, 0, seen_at(0));
  expect_same(here->process(frame), there->process(frame));
}

TEST(IsolatedPlugin, APoseMayBeOfAnEarlierTimeThanItsFrame) {
  const std::string looks_back = kFixtures + "/looks_back.so";
  const auto here = in_process(looks_back), there = isolated(looks_back);
  FrameBuilder builder;
  for (Stage* stage : {here.get(), there.get()}) stage->activate(point_sensors());
  for (const std::uint64_t step : {0u, 7u, 8u}) {
    const hw_frame_t& frame = frame_of(builder, step, seen_at(step));
    const std::int64_t expected_ns = step == 0 ? 0 : frame.t_ns - 1;
    for (Stage* stage : {here.get(), there.get()}) EXPECT_EQ(stage->process(frame).pose()->t_ns, expected_ns);
  }
}

TEST(IsolatedPlugin, TopologyAndDrawingAreTheSameAsInThisProcess) {
  const std::string charts = kFixtures + "/charts.so";
  const auto here = in_process(charts), there = isolated(charts);
  for (Stage* stage : {here.get(), there.get()}) stage->activate(point_sensors());
  const auto expect_same_places = [](const Outputs& a, const Outputs& b) {
    ASSERT_EQ(a.topology() != nullptr, b.topology() != nullptr);
    if (a.topology() == nullptr) return;
    EXPECT_TRUE(same_bytes(a.topology()->nodes(), b.topology()->nodes()));
    EXPECT_TRUE(same_bytes(a.topology()->edges(), b.topology()->edges()));
    EXPECT_EQ(a.topology()->loop(), b.topology()->loop());
    EXPECT_EQ(a.topology()->note(), b.topology()->note());
  };
  FrameBuilder builder;
  std::size_t topologies = 0;
  for (std::uint64_t step = 0; step < 25; ++step) {
    const hw_frame_t& frame = frame_of(builder, step, seen_at(step));
    const Outputs& a = here->process(frame);
    const Outputs& b = there->process(frame);
    expect_same_places(a, b);
    topologies += a.topology() != nullptr ? 1u : 0u;
    ASSERT_TRUE(a.drawing() && b.drawing());
    EXPECT_TRUE(same_bytes(a.drawing()->points(), b.drawing()->points()));
    ASSERT_EQ(b.drawing()->items().size(), 4u);
    EXPECT_EQ(b.drawing()->items()[3].text, "frame " + std::to_string(step));
    EXPECT_TRUE(b.drawing()->items()[1].closed);
  }
  EXPECT_EQ(topologies, 3u);
  const Outputs& a = here->report(true);
  const Outputs& b = there->report(true);
  expect_same_places(a, b);
  ASSERT_TRUE(b.topology());
  EXPECT_EQ(b.topology()->loop(), HW_LOOP_CLOSED);
  EXPECT_EQ(b.topology()->nodes().size(), 3u);
}

TEST(IsolatedPlugin, TakesManyFramesBeforeItAnswers) {
  const auto here = in_process(kSlamPoint);
  const auto there = isolated(kSlamPoint);
  ASSERT_GE(there->capacity(), 8u);
  FrameBuilder builder;
  FrameBuilder builder_here;
  for (Stage* stage : {here.get(), there.get()}) stage->activate(point_sensors());
  std::uint64_t submitted = 0;
  for (std::uint64_t step = 0; step < 100; ++step) {
    while (submitted < 100 && submitted - step < there->capacity()) {
      there->submit(frame_of(builder, submitted, seen_at(submitted)));
      ++submitted;
    }
    expect_same(here->process(frame_of(builder_here, step, seen_at(step))), there->collect());
  }
}

TEST(IsolatedPlugin, TakesFramesOfAnySize) {
  const auto here = in_process(EXAMPLE);
  const auto there = isolated(EXAMPLE);
  FrameBuilder builder;
  for (Stage* stage : {here.get(), there.get()}) stage->activate(point_sensors());
  for (const std::size_t n : {1u, 0u, 3u, 2'000u, 2u}) {
    std::vector<hw_point3_t> points(n);
    for (std::size_t i = 0; i < n; ++i) points[i] = {static_cast<double>(i), 0, 0};
    here->reset();
    there->reset();
    const hw_frame_t& frame = frame_of(builder, n, points);
    expect_same(here->process(frame), there->process(frame));
    expect_same(here->report(false), there->report(false));
  }
}

TEST(IsolatedPlugin, AFrameThatIsTooLargeIsRefused) {
  const auto plugin = isolated(kFixtures + "/minimal.so");
  plugin->activate(point_sensors());
  FrameBuilder builder;
  plugin->process(frame_of(builder, 0, std::vector<hw_point3_t>(1'000'000)));
  const auto error =
      test::error_of([&] { plugin->process(frame_of(builder, 1, std::vector<hw_point3_t>(6'000'000))); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_NE(error->message().find("than are taken"), std::string::npos) << error->message();
  plugin->process(frame_of(builder, 1, {{1, 2, 3}}));
}

TEST(IsolatedPlugin, SamplesThatItDoesNotTakeKeepTheirIndices) {
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
  const auto plugin = isolated(EXAMPLE);
  plugin->activate(point_sensors());
  const Outputs& outputs = plugin->process(frame);
  EXPECT_FALSE(outputs.associations(0));
  ASSERT_TRUE(outputs.associations(1));
  EXPECT_EQ(outputs.associations(1)->size(), 1u);
}

TEST(IsolatedPlugin, SaysTheSameOfItself) {
  const auto here = in_process(kSlamPoint);
  const auto there = isolated(kSlamPoint);
  EXPECT_EQ(there->file(), here->file());
  EXPECT_EQ(there->info().id, here->info().id);
  EXPECT_EQ(there->info().version, here->info().version);
  EXPECT_EQ(there->info().description, here->info().description);
  EXPECT_EQ(there->info().inputs, here->info().inputs);
  EXPECT_EQ(there->info().outputs, here->info().outputs);
  ASSERT_EQ(there->parameters().size(), here->parameters().size());
  ASSERT_FALSE(here->parameters().empty());
  for (std::size_t i = 0; i < here->parameters().size(); ++i) {
    const Parameter& a = here->parameters()[i];
    const Parameter& b = there->parameters()[i];
    EXPECT_EQ(b.name, a.name);
    EXPECT_EQ(b.unit, a.unit);
    EXPECT_EQ(b.help, a.help);
    EXPECT_EQ(b.type_name(), a.type_name());
    EXPECT_EQ(b.choices, a.choices);
    EXPECT_EQ(b.print(b.default_value), a.print(a.default_value));
    EXPECT_EQ(there->parameter_text(i), here->parameter_text(i));
  }
}

/// An error of a stage made by each of the two, the same in every word.
void expect_same_error(const std::function<void(const std::function<std::unique_ptr<Stage>()>&)>& work,
                       const std::string& wanted) {
  const auto here = test::error_of([&] { work([&] { return in_process(wanted); }); });
  const auto there = test::error_of([&] { work([&] { return isolated(wanted); }); });
  ASSERT_TRUE(here);
  ASSERT_TRUE(there) << here->what();
  EXPECT_EQ(there->code(), here->code()) << there->what();
  EXPECT_STREQ(there->what(), here->what());
}

TEST(IsolatedPlugin, RefusesAsInThisProcess) {
  const auto set = [](const char* name, const char* value) {
    return [=](const auto& make) { make()->set_parameter(name, value, {"a.toml", 12, ""}); };
  };
  expect_same_error(set("bound", "1"), EXAMPLE);
  expect_same_error(set("bound_m", "-1"), EXAMPLE);
  expect_same_error(set("bound_m", "much"), EXAMPLE);
  expect_same_error([](const auto& make) { make()->activate({}); }, EXAMPLE);
  for (const char* file : {"other_abi_major.so", "no_entry.so", "null_entry_functions.so", "init_fails.so",
                           "init_fails_silently.so", "duplicate_ids.so", "null_name.so", "not_there.so",
                           "misbehaves.so:nobody", "null_vtable_functions.so",
                           "misbehaves.so:throws_in_create", "lets_exceptions_escape.so:escapes_create"}) {
    expect_same_error([](const auto& make) { make(); }, kFixtures + "/" + file);
  }
}

TEST(IsolatedPlugin, FailsAsInThisProcess) {
  for (const char* fault :
       {"throws", "throws_int", "throws_bad_alloc", "fails_in_activate", "nan_position", "too_many_landmarks",
        "same_landmark_twice", "null_payload", "bad_counter_name", "ignores_refusal", "associations_twice"}) {
    expect_same_error(
        [&](const auto& make) {
          FrameBuilder builder;
          const auto plugin = make();
          plugin->set_parameter("fault", fault);
          plugin->activate(point_sensors());
          plugin->process(frame_of(builder, 0, {{1, 2, 3}, {4, 5, 6}}));
        },
        kFixtures + "/misbehaves.so:misbehaves");
  }
}

TEST(IsolatedPlugin, AfterAFaultItSaysSo) {
  FrameBuilder builder;
  const auto plugin = isolated(kFixtures + "/misbehaves.so:misbehaves");
  plugin->set_parameter("fault", "nan_position");
  plugin->activate(point_sensors());
  EXPECT_TRUE(test::error_of([&] { plugin->process(frame_of(builder, 0, {{1, 2, 3}})); }));
  const auto again = test::error_of([&] { plugin->report(false); });
  ASSERT_TRUE(again);
  EXPECT_NE(again->message().find("has failed before"), std::string::npos) << again->message();
  EXPECT_FALSE(test::error_of([&] { plugin->close(); }));
}

TEST(IsolatedPlugin, ItsLogReachesTheSinkWithItsId) {
  std::vector<std::string> lines;
  const LogSink sink = [&](const std::string& plugin, std::uint32_t level, const std::string& message) {
    lines.push_back(plugin + "/" + std::to_string(level) + "/" + message);
  };
  FrameBuilder builder;
  const auto plugin = isolated(EXAMPLE, sink);
  plugin->activate(point_sensors());
  plugin->process(frame_of(builder, 0, {{1, 2, 3}}));
  EXPECT_EQ(lines, std::vector<std::string>{"example_c/1/the map is made"});
}

TEST(IsolatedPlugin, NoCodeOfItRunsHere) {
  const auto plugin = isolated(kFixtures + "/minimal.so");
  std::ifstream maps("/proc/self/maps");
  const std::string text{std::istreambuf_iterator<char>(maps), {}};
  EXPECT_EQ(text.find("/minimal.so"), std::string::npos);
}

TEST(IsolatedPipeline, HasTheCapacityOfItsPlugins) {
  const std::vector<StageSpec> stages{{EXAMPLE, {}}, {kSlamPoint, {}}};
  Pipeline here(stages, {}, point_sensors());
  Pipeline there(stages, {}, point_sensors(), {}, Isolation{});
  EXPECT_EQ(here.capacity(), 1u);
  EXPECT_GE(there.capacity(), 8u);
  FrameBuilder builder;
  for (std::uint64_t step = 0; step < 10; ++step) {
    const hw_frame_t& frame = frame_of(builder, step, seen_at(step));
    expect_same(here.process(frame), there.process(frame));
  }
  here.restart();
  there.restart();
  expect_same(here.report(false), there.report(false));
  EXPECT_TRUE(there.report(false).landmarks().empty());
}

}  // namespace
}  // namespace hallway::host
