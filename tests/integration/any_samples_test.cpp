// SPDX-License-Identifier: MIT
// A kind of sample that Hallway does not have (support/made_up_kind.cpp) goes from a source to a plugin and back by its row alone: in this process and isolated,
// through the log, its replay, and the link to a robot.
#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "base/error.hpp"
#include "base/file.hpp"
#include "host/pipeline.hpp"
#include "host/samples/frame_bytes.hpp"
#include "host/samples/point_kind.hpp"
#include "host/samples/sample_json.hpp"
#include "link/host_end.hpp"
#include "link/robot_end.hpp"
#include "log/byte_io.hpp"
#include "run/feed/run.hpp"
#include "run/serving/serve.hpp"
#include "run/sources/log_source.hpp"
#include "run/sources/recorded_run.hpp"
#include "run/sources/tracked_source.hpp"
#include "support/made_up_kind.hpp"
#include "support/temp_folder.hpp"
#include "unit/link/memory_wire.hpp"

namespace hallway::run {
namespace {

using std::chrono::milliseconds;

constexpr std::int64_t kPeriod_ns = 100'000'000;
constexpr std::uint32_t kFrames = 20;

/// Points in every frame, and made-up samples: none in every third frame, else one, or two with marks in the second.
class MadeUpSource : public Source {
 public:
  MadeUpSource() {
    facts_.sensors = {host::point_sensor("eyes"), {.id = 1, .kind = test::kMadeUpSample, .name = "nose"}};
    facts_.has_identities = true;
  }
  std::uint32_t iterations() const override { return kFrames; }

 private:
  void fill(std::uint32_t iteration, SourceFrame& frame) override {
    const double x = 0.1 * iteration;
    host::FrameBuilder& builder = frame.begin(iteration, kPeriod_ns * iteration);
    add_points(builder, 0) = {{1 + x, 2, 3}, {4, 5 + x, 6}};
    frame.identities = {7, 8};
    std::uint64_t sequence = 4 * iteration;
    for (std::uint32_t i = 0; i < iteration % 3; ++i) {
      const test::MadeUpRay rays[] = {{0, 1 + x}, {0.5, 2}, {1, 3 - x}};
      const std::uint32_t marks[] = {1};
      test::MadeUp made_up{.n_rays = 3, .rays = rays, .temperature = 20 + x};
      if (i == 1) {
        made_up.n_marks = 1;
        made_up.marks = marks;
      }
      const std::int64_t t_ns = kPeriod_ns * iteration - 30'000'000 * (2 - i);
      builder.add({sizeof(hw_sample_t), test::kMadeUpSample, 0, 1, sequence++, t_ns, t_ns + 1000, &made_up});
      frame.identities.insert(frame.identities.end(), 3, log::kNoLandmark);
    }
    frame.T_world_body = Pose();
  }
};

struct Ran {
  std::string log;
  std::string trajectory;
  std::string timing;
  RunResult result;
};

Ran run(Source& source, bool isolated, const std::string& plugin = TAKES_MADE_UP ":takes_made_up") {
  const test::TempFolder folder;
  std::optional<host::Isolation> isolation;
  if (isolated) isolation.emplace();
  auto pipeline = host::Pipeline::unstarted({{plugin, {}}}, {}, source.sensors(), {}, isolation);
  RunPlan plan;
  plan.folder = folder.path() / "run";
  plan.manifest = {{"name", "made up"}, {"period_ns", kPeriod_ns}};
  plan.start_failures = record::start_plugins(pipeline, plan.on_failure);
  Ran ran;
  ran.result = execute(source, pipeline, plan, {});
  ran.log = read_file(plan.folder / "run.mcap");
  ran.trajectory = read_file(plan.folder / "trajectory.tum");
  ran.timing = read_file(plan.folder / "timing.csv");
  return ran;
}

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

std::string bytes_of(const hw_frame_t& frame) {
  std::string bytes;
  host::FrameWriter().write_over(bytes, frame);
  return bytes;
}

TEST(AnySamples, ReachThePluginInThisProcessAndInItsOwn) {
  MadeUpSource source;
  const Ran here = run(source, false);
  ASSERT_EQ(here.result.failures.count, 0u);
  // In every third frame there is nothing that the plugin takes.
  EXPECT_EQ(lines_of(here.trajectory), 13u);
  EXPECT_EQ(lines_of(here.timing), 1u + 13u);
  EXPECT_EQ(here.result.metrics.lost_iterations, 0u);
  const Ran isolated = run(source, true);
  ASSERT_EQ(isolated.result.failures.count, 0u);
  EXPECT_EQ(isolated.trajectory, here.trajectory);
  EXPECT_EQ(isolated.log, here.log);
}

/// The positions of a trajectory.
std::vector<std::array<double, 2>> positions_of(const std::string& trajectory) {
  std::vector<std::array<double, 2>> positions;
  std::istringstream lines(trajectory);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream numbers(line);
    double t = 0, x = 0, y = 0;
    numbers >> t >> x >> y;
    positions.push_back({x, y});
  }
  return positions;
}

TEST(AnySamples, ThatAreOptionalAreGivenWhereThereAreAny) {
  const std::string plugin = TAKES_MADE_UP ":may_take_made_up";
  MadeUpSource source;
  for (const bool isolated : {false, true}) {
    const Ran both = run(source, isolated, plugin);
    ASSERT_EQ(both.result.failures.count, 0u);
    const auto counts = positions_of(both.trajectory);
    ASSERT_EQ(counts.size(), kFrames);
    for (std::uint32_t i = 0; i < kFrames; ++i)
      EXPECT_EQ(counts[i], (std::array<double, 2>{1.0, static_cast<double>(i % 3)})) << "frame " << i;
  }
  // Nobody gives them, and nobody asks for them.
  log::ObservationLog observations;
  const log::Observation seen{.point = {1, 2, 3}};
  observations.add_frame(0, {&seen, 1});
  LogSource points(std::move(observations), {}, {}, kPeriod_ns, 0);
  EXPECT_EQ(positions_of(run(points, false, plugin).trajectory),
            (std::vector<std::array<double, 2>>{{1.0, 0.0}}));
  EXPECT_THROW(run(points, false), Error) << "a plugin that needs them";
}

/// Three frames: of 10 000 made-up samples, of nothing, and of one sample.
class ManySamples : public Source {
 public:
  static constexpr std::uint32_t kMany = 10'000;

  ManySamples() { facts_.sensors = {{.id = 1, .kind = test::kMadeUpSample, .name = "nose"}}; }
  std::uint32_t iterations() const override { return 3; }

 private:
  void fill(std::uint32_t iteration, SourceFrame& frame) override {
    host::FrameBuilder& builder = frame.begin(iteration, kPeriod_ns * (iteration + 1));
    const test::MadeUpRay ray{0, 1};
    const std::uint32_t n_samples[] = {kMany, 0, 1};
    for (std::uint32_t i = 0; i < n_samples[iteration]; ++i) {
      const test::MadeUp made_up{.n_rays = 1, .rays = &ray};
      const std::int64_t t_ns = i;
      builder.add(
          {sizeof(hw_sample_t), test::kMadeUpSample, 0, 1, kMany * iteration + i, t_ns, t_ns, &made_up});
      frame.identities.push_back(log::kNoLandmark);
    }
    frame.T_world_body = Pose();
  }
};

TEST(AnySamples, NoneAndTenThousandInAFrame) {
  ManySamples source;
  const Ran here = run(source, false);
  ASSERT_EQ(here.result.failures.count, 0u);
  EXPECT_EQ(positions_of(here.trajectory),
            (std::vector<std::array<double, 2>>{{10'000.0, 0.0}, {10'001.0, 0.0}}));
  const Ran isolated = run(source, true);
  ASSERT_EQ(isolated.result.failures.count, 0u);
  EXPECT_EQ(isolated.log, here.log);
  const log::MemoryInput input(here.log);
  RecordedSource replayed(read_recorded_run(input), 0);
  ASSERT_EQ(replayed.iterations(), 3u);
  EXPECT_EQ(run(replayed, false).log, here.log);
}

TEST(AnySamples, AreReplayedFromTheLogAsTheyWere) {
  MadeUpSource source;
  const Ran first = run(source, false);
  const log::MemoryInput input(first.log);
  RecordedRun recorded = read_recorded_run(input);
  ASSERT_FALSE(recorded.damage) << recorded.damage->cause;
  ASSERT_EQ(recorded.facts.sensors.size(), 2u);
  EXPECT_EQ(recorded.facts.sensors[1].kind, test::kMadeUpSample);
  EXPECT_EQ(recorded.facts.sensors[1].id, 1u);
  RecordedSource replayed(std::move(recorded), 0);
  ASSERT_EQ(replayed.iterations(), kFrames);
  SourceFrame a, b;
  for (std::uint32_t i = 0; i < kFrames; ++i) {
    source.read(i, a);
    replayed.read(i, b);
    EXPECT_EQ(bytes_of(a.samples()), bytes_of(b.samples())) << "frame " << i;
    EXPECT_EQ(a.identities, b.identities);
  }
  EXPECT_EQ(run(replayed, false).log, first.log);
}

/// A sensor of made-up samples alone: three rays in every frame, of which the second is of nothing that is known.
class RaySource : public Source {
 public:
  explicit RaySource(bool has_identities) {
    facts_.sensors.push_back({.id = 1, .kind = test::kMadeUpSample, .name = "nose"});
    facts_.has_identities = has_identities;
  }
  std::uint32_t iterations() const override { return 2; }

 private:
  void fill(std::uint32_t iteration, SourceFrame& frame) override {
    host::FrameBuilder& builder = frame.begin(iteration, kPeriod_ns * iteration);
    builder.add(test::kMadeUpKind, 1).list<test::MadeUpRay>(offsetof(test::MadeUp, rays)) = {
        {0, 1}, {0.5, 2}, {1, 3}};
    if (has_identities()) frame.identities = {5 + iteration, log::kNoLandmark, 9};
  }
};

TEST(AnySamples, AreTrackedWhereTheirRowHasATrack) {
  TrackedSource tracked(std::make_unique<RaySource>(true));
  SourceFrame frame;
  for (std::uint32_t i = 0; i < 2; ++i) {
    tracked.read(i, frame);
    ASSERT_TRUE(host::is_tracked(frame.sample(0)));
    const auto& made_up = *static_cast<const test::MadeUp*>(frame.sample(0).payload);
    EXPECT_EQ(made_up.tracks[0], 5u + i);
    EXPECT_EQ(made_up.tracks[1], log::kNoTrack);
    EXPECT_EQ(made_up.tracks[2], 9u);
  }
  const Ran recorded = run(tracked, false);
  EXPECT_TRUE(read_recorded_run(log::MemoryInput(recorded.log)).facts.has_tracks);
  RaySource untracked(true);
  const Ran without = run(untracked, false);
  EXPECT_FALSE(read_recorded_run(log::MemoryInput(without.log)).facts.has_tracks);
  EXPECT_THROW(TrackedSource(std::make_unique<RaySource>(false)), Error) << "there is nothing to track by";
}

TEST(AnySamples, OfALogHaveTheirJson) {
  MadeUpSource source;
  const Ran ran = run(source, false);
  const log::MemoryInput input(ran.log);
  RecordedSource replayed(read_recorded_run(input), 0);
  SourceFrame frame;
  replayed.read(2, frame);
  EXPECT_EQ(
      host::frame_json(frame.samples()),
      R"({"sequence":2,"t_ns":200000000,"samples":[)"
      R"({"sensor":0,"kind":"points","sequence":2,"t_begin_ns":200000000,"t_end_ns":200000000,"flags":[],)"
      R"("payload":{"points":[[1.2,2,3],[4,5.2,6]]}},)"
      R"({"sensor":1,"kind":"made_up","sequence":8,"t_begin_ns":140000000,"t_end_ns":140001000,"flags":[],)"
      R"("payload":{"temperature":20.2,"rays":[{"azimuth":0,"range":1.2},{"azimuth":0.5,"range":2},)"
      R"({"azimuth":1,"range":2.8}]}},)"
      R"({"sensor":1,"kind":"made_up","sequence":9,"t_begin_ns":170000000,"t_end_ns":170001000,"flags":[],)"
      R"("payload":{"temperature":20.2,"rays":[{"azimuth":0,"range":1.2},{"azimuth":0.5,"range":2},)"
      R"({"azimuth":1,"range":2.8}],"marks":[1]}}]})");
}

TEST(AnySamples, GoOverTheLinkAsTheyAre) {
  MadeUpSource source;
  link::MemoryNet net;
  link::MemoryWire robot_wire(net, 1), host_wire(net, 2);
  const ServePlan plan{.lock_step = true, .manifest = {{"period_ns", kPeriod_ns}}};
  link::RobotEnd robot(robot_wire, describe_robot(source, plan, "nose"), 7, milliseconds{60'000});
  std::vector<std::string> given;
  std::vector<host::SensorInfo> sensors;
  std::thread program([&] {
    link::HostEnd host(host_wire, robot_wire.address(), 42, milliseconds{60'000});
    sensors = host.describe().sensors;
    for (;;) {
      const link::HostEnd::Reading reading = host.read(milliseconds{100});
      if (reading.found == link::HostEnd::Found::kEnd) return;
      if (reading.found != link::HostEnd::Found::kFrame) continue;
      given.push_back(bytes_of(*reading.frame));
      host.answer({.sequence = reading.frame->sequence, .t_ns = reading.frame->t_ns});
    }
  });
  const ServeResult result = serve(source, robot, plan, {});
  program.join();
  EXPECT_EQ(result.frames, kFrames);
  ASSERT_EQ(sensors.size(), 2u);
  EXPECT_EQ(sensors[1].kind, test::kMadeUpSample);
  ASSERT_EQ(given.size(), kFrames);
  SourceFrame frame;
  for (std::uint32_t i = 0; i < kFrames; ++i) {
    source.read(i, frame);
    EXPECT_EQ(given[i], bytes_of(frame.samples())) << "frame " << i;
  }
}

}  // namespace
}  // namespace hallway::run
