// SPDX-License-Identifier: MIT
#include "watch/log_moments.hpp"

#include <gtest/gtest.h>
#include <hallway/range_scan.h>

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/file.hpp"
#include "host/pipeline.hpp"
#include "host/samples/frame_bytes.hpp"
#include "log/run_log.hpp"
#include "run/feed/drive_record.hpp"
#include "run/feed/manifest.hpp"
#include "run/feed/plugin_log.hpp"
#include "run/feed/run.hpp"
#include "run/pictures/record.hpp"
#include "run/sources/simulated_source.hpp"
#include "sim/simulator.hpp"
#include "support/data.hpp"
#include "support/errors.hpp"
#include "support/process.hpp"
#include "support/temp_folder.hpp"
#include "watch/live_moments.hpp"
#include "watch/make_scene.hpp"

namespace hallway::watch {
namespace {

namespace fs = std::filesystem;

/// A run of a scenario of maps/, as it was watched.
struct WatchedRun {
  std::vector<Moment> moments;
  Scene scene;
};

WatchedRun run_watched(const std::string& name, const std::vector<Override>& overrides,
                       const fs::path& folder) {
  const sim::Scenario scenario =
      sim::load_scenario(test::source_folder() / "maps" / (name + ".toml"), overrides);
  const sim::Simulator simulator(scenario, 1, trace::Backend::kEmbree);
  run::SimulatedSource source(simulator);
  const auto log = std::make_shared<run::PluginLog>();
  run::PluginLog watched_log;
  host::Pipeline pipeline(scenario.pipeline, {test::binary_folder() / "lib" / "hallway" / "plugins"},
                          source.activation(), log->sink(watched_log.sink({})));
  nlohmann::ordered_json manifest = run::make_manifest(
      {.command = "run", .name = name, .period_ns = scenario.period_ns, .threads = 1}, pipeline);
  if (scenario.robot.driven) {
    manifest["robot"] = run::print_driven(scenario);
    pipeline.drive_by(run::driving_plugin(pipeline, scenario));
  }
  WatchedRun watched{.moments = {}, .scene = scene_of(simulator, source, manifest)};
  run::RunPlan plan;
  plan.folder = folder;
  plan.manifest = std::move(manifest);
  plan.foxglove = log;  // so that the log has the plugins' lines
  plan.attachments = {{run::files::kMap, read_file(scenario.map_file)}};
  for (const fs::path& model : simulator.models().files)
    plan.attachments.push_back(
        {model.lexically_relative(scenario.map_file.parent_path()).generic_string(), read_file(model)});
  run::RunHooks hooks;
  LiveMoments live(source, watched_log);
  live.add_to(hooks, [&](const Moment& moment) { watched.moments.push_back(moment); });
  run::execute(source, pipeline, plan, hooks);
  return watched;
}

void expect_same(const Pose& a, const Pose& b) {
  EXPECT_EQ(a.t, b.t);
  EXPECT_EQ(a.q.coeffs(), b.q.coeffs());
}

/// Of what a log has: all but counters.
void expect_same(const Moment& live, const Moment& logged) {
  EXPECT_EQ(live.iteration, logged.iteration);
  EXPECT_EQ(live.t_ns, logged.t_ns);
  ASSERT_EQ(live.T_world_body.has_value(), logged.T_world_body.has_value());
  if (live.T_world_body) expect_same(*live.T_world_body, *logged.T_world_body);
  EXPECT_EQ(live.orientation_known, logged.orientation_known);
  ASSERT_EQ(live.rays.size(), logged.rays.size());
  for (std::size_t i = 0; i < live.rays.size(); ++i) {
    EXPECT_EQ(live.rays[i].from, logged.rays[i].from);
    EXPECT_EQ(live.rays[i].to, logged.rays[i].to);
    EXPECT_EQ(live.rays[i].has_return, logged.rays[i].has_return);
  }
  EXPECT_EQ(live.points, logged.points);
  EXPECT_EQ(live.outlines, logged.outlines);
  EXPECT_EQ(live.pressed, logged.pressed);
  EXPECT_EQ(live.readings, logged.readings);
  ASSERT_EQ(live.pose.has_value(), logged.pose.has_value());
  if (live.pose) {
    EXPECT_EQ(live.pose->valid, logged.pose->valid);
    EXPECT_EQ(live.pose->position_m, logged.pose->position_m);
    EXPECT_EQ(live.pose->orientation, logged.pose->orientation);
    EXPECT_EQ(live.pose->map_epoch, logged.pose->map_epoch);
  }
  ASSERT_EQ(live.topology != nullptr, logged.topology != nullptr);
  if (live.topology) {
    EXPECT_EQ(*live.topology, *logged.topology);
  }
  EXPECT_EQ(live.drawing, logged.drawing);
  EXPECT_EQ(live.command, logged.command);
  EXPECT_EQ(live.obeyed, logged.obeyed);
  EXPECT_EQ(live.contacts, logged.contacts);
  EXPECT_EQ(live.events, logged.events);
  ASSERT_EQ(live.lines.size(), logged.lines.size()) << "of frame " << live.iteration;
  for (std::size_t i = 0; i < live.lines.size(); ++i) {
    EXPECT_EQ(live.lines[i].text, logged.lines[i].text);
    EXPECT_EQ(live.lines[i].name, logged.lines[i].name);
    EXPECT_EQ(live.lines[i].level, logged.lines[i].level);
  }
}

std::vector<Moment> read_all(LogMoments& moments) {
  std::vector<Moment> all;
  while (auto moment = moments.next()) all.push_back(std::move(*moment));
  return all;
}

void expect_log_is_as_watched(const std::string& name, const std::vector<Override>& overrides) {
  const test::TempFolder folder;
  const WatchedRun watched = run_watched(name, overrides, folder.path() / "run");
  LogMoments log(folder.path() / "run" / run::files::kLog);
  const std::vector<Moment> logged = read_all(log);
  EXPECT_FALSE(log.damage());
  ASSERT_EQ(watched.moments.size(), logged.size());
  for (std::size_t i = 0; i < logged.size(); ++i) expect_same(watched.moments[i], logged[i]);
  log.restart();
  EXPECT_EQ(read_all(log).size(), logged.size());

  const Scene scene = scene_of(run::read_record(folder.path() / "run"));
  EXPECT_FALSE(scene.plan.empty());
  EXPECT_EQ(scene.plan, watched.scene.plan);
  EXPECT_EQ(scene.outline, watched.scene.outline);
  EXPECT_EQ(scene.landmarks.size(), watched.scene.landmarks.size());
  EXPECT_EQ(scene.iterations, watched.scene.iterations);
}

TEST(LogMoments, AreThoseOfADriveThatIsWatched) {
  expect_log_is_as_watched("office_events", {{"steps", "600"}, {"seed", "4"}});
}

TEST(LogMoments, AreThoseOfARigThatIsWatched) {
  expect_log_is_as_watched("office_rig", {{"steps", "15"}});
}

TEST(LogMoments, AreThoseOfAMapperThatIsWatched) {
  expect_log_is_as_watched("office", {{"steps", "60"}});
}

TEST(LogMoments, AreThoseOfARobotThatChartsAndIsWatched) {
  expect_log_is_as_watched("cubicles_faults", {{"steps", "400"}});
}

TEST(LogMoments, TopologyHoldsUntilTheNextOneAndADrawingForItsFrame) {
  const test::TempFolder folder;
  const fs::path file = folder.path() / "run.mcap";
  log::FileOutput output(file);
  log::RunLogWriter writer(output, "test", "{}");
  log::Topology topology;
  const auto add_node = [&] {
    topology.nodes.push_back({.id = std::uint32_t(topology.nodes.size()), .kind = log::PlaceKind::kSweep});
  };
  host::FrameWriter frames;
  for (std::uint32_t i = 0; i < 5; ++i) {
    hw_frame_t frame{};
    frame.size = sizeof frame;
    frame.sequence = i;
    frame.t_ns = i;
    std::vector<std::byte> bytes;
    frames.write_over(bytes, frame);
    const log::FrameStamp stamp{i, i};
    writer.add_frame(stamp, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    if (i == 1 || i == 3) {
      add_node();
      writer.add_topology(stamp, topology);
      writer.add_drawing(stamp, {{.kind = log::DrawingKind::kText, .points_m = {{0, 0}}, .text = "seek"}});
    }
  }
  writer.add_map({4, 4}, {});
  add_node();
  writer.add_topology({4, 4}, topology);  // of report(), which a run that goes on does not show
  writer.finish();
  LogMoments log(file);
  for (int time = 0; time < 2; ++time, log.restart()) {
    const std::vector<Moment> moments = read_all(log);
    ASSERT_EQ(moments.size(), 5u);
    EXPECT_EQ(moments[0].topology, nullptr);
    for (const auto& [moment, nodes] :
         {std::pair(1, 1u), std::pair(2, 1u), std::pair(3, 2u), std::pair(4, 2u)}) {
      ASSERT_NE(moments[std::size_t(moment)].topology, nullptr) << moment;
      EXPECT_EQ(moments[std::size_t(moment)].topology->nodes.size(), nodes) << moment;
    }
    EXPECT_EQ(moments[1].topology, moments[2].topology) << "in memory once";
    for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(moments[i].drawing.size(), i % 2) << i;
  }
}

TEST(LogMoments, EndAtTheFirstDamage) {
  const test::TempFolder folder;
  run_watched("office", {{"steps", "60"}}, folder.path() / "run");
  const std::string bytes = read_file(folder.path() / "run" / run::files::kLog);
  const fs::path cut = folder.write("cut.mcap", bytes.substr(0, bytes.size() / 2));
  LogMoments moments(cut);
  const std::vector<Moment> some = read_all(moments);
  EXPECT_LT(some.size(), 60u);
  EXPECT_TRUE(moments.damage());
}

TEST(LogMoments, RefuseWhatIsNoLog) {
  const test::TempFolder folder;
  EXPECT_THROW(LogMoments(folder.write("no.mcap", "iteration,x,y,z\n")), Error);
  EXPECT_THROW(LogMoments(folder.path() / "missing.mcap"), Error);
}

TEST(MomentMaker, EndsRaysThatMeetNothingAtTheGreatestRange) {
  const hw_ray_t rays[3]{{0.0, 0.0, 2.0}, {1.0, 0.0, HUGE_VAL}, {2.0, 0.0, NAN}};
  hw_range_scan_t scan{};
  scan.size = sizeof scan;
  scan.stride = sizeof rays[0];
  scan.count = 3;
  scan.layers = 1;
  scan.rays = rays;
  hw_sample_t sample{};
  sample.size = sizeof sample;
  sample.kind = HW_SAMPLE_RANGE_SCAN;
  sample.sensor_id = 5;
  sample.payload = &scan;
  const hw_sample_t* samples[]{&sample};
  hw_frame_t frame{};
  frame.size = sizeof frame;
  frame.n_samples = 1;
  frame.samples = samples;
  host::SensorInfo sensor;
  sensor.id = 5;
  sensor.kind = HW_SAMPLE_RANGE_SCAN;
  sensor.name = "sonar";
  sensor.max_range_m = 7.0;
  sensor.T_body_sensor.position[0] = 1.0;
  MomentMaker maker;
  maker.set_sensors({&sensor, 1});
  maker.begin(frame);
  const Moment& moment = maker.moment();
  ASSERT_EQ(moment.rays.size(), 2u) << "one gave no answer";
  EXPECT_TRUE(moment.rays[0].has_return);
  EXPECT_TRUE(moment.rays[0].to.isApprox(Vec3(3.0, 0.0, 0.0)));
  EXPECT_FALSE(moment.rays[1].has_return);
  EXPECT_NEAR((moment.rays[1].to - moment.rays[1].from).norm(), 7.0, 1e-12);
  EXPECT_EQ(moment.readings, std::vector<std::string>{"sonar: 1 of 3 rays, 2.00 m"});

  // Two readings of one sensor in a frame: the later one is the state.
  hw_range_scan_t single = scan;
  single.count = 1;
  hw_sample_t later = sample;
  later.payload = &single;
  const hw_sample_t* both[]{&sample, &later};
  frame.n_samples = 2;
  frame.samples = both;
  maker.begin(frame);
  EXPECT_EQ(maker.moment().rays.size(), 3u);
  EXPECT_EQ(maker.moment().readings, std::vector<std::string>{"sonar: 2.00 m"});
}

}  // namespace
}  // namespace hallway::watch
