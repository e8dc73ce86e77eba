// SPDX-License-Identifier: MIT
#include "sim/simulator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"
#include "unit/sim/small_world.hpp"

namespace hallway::sim {
namespace {

const char* const kEyes = "[sensor.eyes]\nkind = 'points'\nmax_range_m = 8\nnoise_m = 0.02\n";
const char* const kTwoEyes =
    "[sensor.eyes]\nkind = 'points'\nmax_range_m = 8\nnoise_m = 0.02\n"
    "[sensor.back]\nkind = 'points'\nmax_range_m = 8\nyaw_deg = 180\nposition_m = [-0.2, 0, 0.5]\n";

/// A scenario with its map in a folder of its own.
class World {
 public:
  World(const std::string& scenario, const std::string& map) {
    folder_.write("small.map", map);
    scenario_ = load_scenario(folder_.write("s.toml", scenario));
  }
  explicit World(const std::string& scenario) : World(scenario, test::map_text(test::pillars())) {}

  Scenario& scenario() { return scenario_; }

 private:
  test::TempFolder folder_;
  Scenario scenario_;
};

/// Everything in a frame, bit by bit, as text.
std::string bytes_of(const Frame& frame) {
  std::string bytes;
  const auto add = [&](const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  };
  add(&frame.step, sizeof(frame.step));
  add(&frame.t_ns, sizeof(frame.t_ns));
  add(frame.T_world_body.t.data(), 3 * sizeof(double));
  add(frame.T_world_body.q.coeffs().data(), 4 * sizeof(double));
  for (const Reading& reading : frame.readings) {
    add(&reading.sensor, sizeof(reading.sensor));
    for (const sense::PointObservation& seen : reading.observations()) {
      add(&seen.landmark, sizeof(seen.landmark));
      add(seen.point.data(), 3 * sizeof(double));
    }
  }
  return bytes;
}

std::string bytes_of_run(const Scenario& scenario, unsigned threads, trace::Backend backend) {
  const Simulator simulator(scenario, threads, backend);
  std::string bytes;
  for (std::uint32_t i = 0; i < scenario.steps; ++i) bytes += bytes_of(simulator.step(i));
  return bytes;
}

TEST(Simulator, SeesMovingLandmarksWhereTheyAre) {
  World world(
      test::scenario_text("[sensor.eyes]\nkind = 'points'\nhorizontal_fov_deg = 360\nvertical_fov_deg = 360\n"
                          "[cloud.cloud]\nmoving_share = 0.5\nspeed = 0.5\n"),
      test::map_text(""));
  const Simulator simulator(world.scenario(), 1, trace::Backend::kBruteForce);
  std::size_t moved = 0;
  for (const std::uint32_t step : {0u, 30u}) {
    const Frame frame = simulator.step(step);
    std::vector<sense::LandmarkPlace> places;
    simulator.moving_landmarks().places_at(static_cast<double>(frame.t_ns) / 1e9, places);
    ASSERT_FALSE(places.empty());
    std::set<std::uint32_t> seen;
    for (const auto& observation : frame.readings.front().observations()) {
      EXPECT_TRUE(seen.insert(observation.landmark).second) << observation.landmark;
      Vec3 place = simulator.landmarks()[observation.landmark];
      for (const auto& at : places) {
        if (at.landmark == observation.landmark) place = at.place;
      }
      EXPECT_LT((frame.T_world_body * observation.point - place).norm(), 1e-9);
      if ((place - simulator.landmarks()[observation.landmark]).norm() > 0.1) ++moved;
    }
    EXPECT_EQ(seen.size(), simulator.landmarks().size());  // nothing hides them
  }
  EXPECT_GT(moved, 2u);
}

TEST(Simulator, ACloudThatTheMapDoesNotHaveIsNamed) {
  World world(test::scenario_text(std::string(kEyes) + "[cloud.crowd]\nmoving_share = 0.5\n"));
  const auto error =
      test::error_of([&] { Simulator simulator(world.scenario(), 1, trace::Backend::kBruteForce); });
  ASSERT_TRUE(error);
  EXPECT_NE(error->message().find("no hw_landmark_cloud `crowd`"), std::string::npos) << error->what();
  EXPECT_EQ(error->where().line, 12);
}

TEST(Simulator, StartsAtTheBeginningOfThePath) {
  World world(test::scenario_text());
  const Simulator simulator(world.scenario(), 1, trace::Backend::kBruteForce);
  const Frame frame = simulator.step(0);
  EXPECT_EQ(frame.step, 0u);
  EXPECT_EQ(frame.t_ns, 0);
  EXPECT_EQ(frame.T_world_body.t, simulator.path().at(0.0).t);
}

TEST(Simulator, CountsTimeInWholeNanoseconds) {
  World world(test::scenario_text());
  world.scenario().steps = 10'000'000;
  world.scenario().period_ns = 33'333'333;
  const Simulator simulator(world.scenario(), 1, trace::Backend::kBruteForce);
  EXPECT_EQ(simulator.step(9'999'999).t_ns, std::int64_t{9'999'999} * 33'333'333);
}

TEST(Simulator, MovesAtTheGivenSpeed) {
  World world(test::scenario_text(), test::map_text(""));
  world.scenario().robot = {.path = "ahead", .speed_m_s = 0.5};
  const Simulator simulator(world.scenario(), 1, trace::Backend::kBruteForce);
  EXPECT_DOUBLE_EQ(simulator.step_length_m(), 0.05);
  EXPECT_LT((simulator.step(30).T_world_body.t - Vec3(1.5, 3, 0)).norm(), 1e-12);
}

TEST(Simulator, StandsAtTheEndOfAnOpenPath) {
  World world(test::scenario_text(), test::map_text(""));
  world.scenario().robot = {.path = "ahead", .speed_m_s = 100.0};
  const Simulator simulator(world.scenario(), 1, trace::Backend::kBruteForce);
  EXPECT_LT((simulator.step(39).T_world_body.t - Vec3(4, 3, 0)).norm(), 1e-12);
}

TEST(Simulator, GoesOnceRoundInLoopSteps) {
  World world(test::scenario_text());  // loop_steps = 20, steps = 40
  const Simulator simulator(world.scenario(), 1, trace::Backend::kBruteForce);
  for (std::uint32_t i = 0; i < 20; ++i) {
    const Pose first = simulator.step(i).T_world_body;
    const Pose second = simulator.step(i + 20).T_world_body;
    EXPECT_LT((first.t - second.t).norm(), 1e-9);
    EXPECT_LT(angle_between(first.q, second.q), 1e-9);
  }
  EXPECT_GT((simulator.step(10).T_world_body.t - simulator.step(0).T_world_body.t).norm(), 1.0);
}

TEST(Simulator, AStandingRobotStands) {
  World world(test::scenario_text());
  world.scenario().robot = {.path = "round", .speed_m_s = 0.0};
  const Simulator simulator(world.scenario(), 1, trace::Backend::kBruteForce);
  EXPECT_EQ(simulator.step(39).T_world_body.t, simulator.step(0).T_world_body.t);
  EXPECT_TRUE(simulator.problems().empty());
}

TEST(Simulator, SeesLandmarksWhereTheyAre) {
  World world(test::scenario_text(kEyes));
  const Simulator simulator(world.scenario(), 1, trace::Backend::kBruteForce);
  std::size_t seen = 0;
  for (std::uint32_t i = 0; i < 40; ++i) {
    const Frame frame = simulator.step(i);
    ASSERT_EQ(frame.readings.size(), 1u);
    for (const sense::PointObservation& observation : frame.readings[0].observations()) {
      ASSERT_LT(observation.landmark, simulator.landmarks().size());
      const Vec3 truth = simulator.landmarks()[observation.landmark];
      EXPECT_LT((frame.T_world_body * observation.point - truth).norm(), 6 * std::sqrt(3.0) * 0.02);
      ++seen;
    }
  }
  EXPECT_GT(seen, 40u);
}

TEST(Simulator, MountsEachSensorOnTheRobot) {
  World world(test::scenario_text(kTwoEyes));
  const Simulator simulator(world.scenario(), 1, trace::Backend::kBruteForce);
  std::set<std::size_t> with_observations;
  for (std::uint32_t i = 0; i < 20; ++i) {
    const Frame frame = simulator.step(i);
    ASSERT_EQ(frame.readings.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_EQ(frame.readings[k].sensor, k);
      const Pose T_world_sensor =
          frame.T_world_body * std::get<sense::PointSensorSpec>(world.scenario().sensors[k]).T_body_sensor;
      for (const sense::PointObservation& observation : frame.readings[k].observations()) {
        const Vec3 truth = simulator.landmarks()[observation.landmark];
        EXPECT_LT((T_world_sensor * observation.point - truth).norm(), 0.25);
        EXPECT_GT((T_world_sensor.inverse() * truth).x(), 0.0);
        with_observations.insert(k);
      }
    }
  }
  EXPECT_EQ(with_observations.size(), 2u);
}

TEST(Simulator, GivesTheSameBytesOnAnyNumberOfThreads) {
  World world(test::scenario_text(kTwoEyes));
  const std::string alone = bytes_of_run(world.scenario(), 1, trace::Backend::kBruteForce);
  for (const unsigned threads : {2u, 4u, 8u}) {
    EXPECT_EQ(bytes_of_run(world.scenario(), threads, trace::Backend::kBruteForce), alone) << threads;
  }
}

TEST(Simulator, GivesAFrameAskedForAloneAsInOrder) {
  World world(test::scenario_text(kTwoEyes));
  const Simulator in_order(world.scenario(), 1, trace::Backend::kBruteForce);
  const Simulator backwards(world.scenario(), 1, trace::Backend::kBruteForce);
  std::vector<std::string> frames;
  for (std::uint32_t i = 0; i < 40; ++i) frames.push_back(bytes_of(in_order.step(i)));
  for (std::uint32_t i = 40; i-- > 0;) EXPECT_EQ(bytes_of(backwards.step(i)), frames[i]) << i;
}

/// The entity of a map that is a sensor.
std::string sensor_entity(const std::string& name, const std::string& keys) {
  return "{\n\"classname\" \"hw_sensor\"\n\"name\" \"" + name + "\"\n" + keys + "}\n";
}

void expect_equal(const sense::PointSensorSpec& a, const sense::PointSensorSpec& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.T_body_sensor.t, b.T_body_sensor.t);
  EXPECT_EQ(a.T_body_sensor.q.coeffs(), b.T_body_sensor.q.coeffs());
  EXPECT_EQ(a.horizontal_fov, b.horizontal_fov);
  EXPECT_EQ(a.vertical_fov, b.vertical_fov);
  EXPECT_EQ(a.min_range_m, b.min_range_m);
  EXPECT_EQ(a.max_range_m, b.max_range_m);
  EXPECT_EQ(a.noise_m, b.noise_m);
  EXPECT_EQ(a.noise_per_m, b.noise_per_m);
}

TEST(Simulator, TakesTheSensorsOfTheMapWhereTheScenarioHasNone) {
  const std::string in_map =
      sensor_entity("eyes", "\"max_range_m\" \"8\"\n\"noise_m\" \"0.02\"\n\"origin\" \"310 0 0\"\n") +
      sensor_entity("back",
                    "\"kind\" \"points\"\n\"max_range_m\" \"8\"\n\"yaw_deg\" \"180\"\n\"position_m\" "
                    "\"-0.2 0 0.5\"\n");
  World mapped(test::scenario_text(), test::map_text(test::pillars(), in_map));
  World written(test::scenario_text(kTwoEyes));
  EXPECT_TRUE(mapped.scenario().sensors.empty());
  const Simulator simulator(mapped.scenario(), 1, trace::Backend::kBruteForce);
  ASSERT_EQ(simulator.scenario().sensors.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k)
    expect_equal(std::get<sense::PointSensorSpec>(simulator.scenario().sensors[k]),
                 std::get<sense::PointSensorSpec>(written.scenario().sensors[k]));
  // All the same, noise included.
  EXPECT_EQ(bytes_of_run(mapped.scenario(), 1, trace::Backend::kBruteForce),
            bytes_of_run(written.scenario(), 1, trace::Backend::kBruteForce));
}

TEST(Simulator, AllKeysOfAMapsSensorMeanWhatAScenariosDo) {
  const std::string in_map = sensor_entity(
      "a",
      "\"kind\" \"points\"\n\"horizontal_fov_deg\" \"120\"\n\"vertical_fov_deg\" \"30\"\n\"min_range_m\" "
      "\"0.5\"\n\"max_range_m\" \"7\"\n\"noise_m\" \"0.1 0.2 0.3\"\n\"noise_per_m\" \"0.01\"\n\"position_m\" "
      "\"1 2 3\"\n\"yaw_deg\" "
      "\"10\"\n\"pitch_deg\" \"20\"\n\"roll_deg\" \"30\"\n");
  World mapped(test::scenario_text(), test::map_text("", in_map + sensor_entity("b", "")));
  World written(
      test::scenario_text("[sensor.a]\nkind = 'points'\nhorizontal_fov_deg = 120\nvertical_fov_deg = 30\n"
                          "min_range_m = 0.5\nmax_range_m = 7\nnoise_m = [0.1, 0.2, 0.3]\nnoise_per_m = "
                          "0.01\nposition_m = [1, 2, 3]\n"
                          "yaw_deg = 10\npitch_deg = 20\nroll_deg = 30\n[sensor.b]\nkind = 'points'\n"));
  const Simulator simulator(mapped.scenario(), 1, trace::Backend::kBruteForce);
  ASSERT_EQ(simulator.scenario().sensors.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k)
    expect_equal(std::get<sense::PointSensorSpec>(simulator.scenario().sensors[k]),
                 std::get<sense::PointSensorSpec>(written.scenario().sensors[k]));
  // The record of the settings is the same but for where they were said.
  const auto values_of = [](const Scenario& scenario) {
    std::set<std::string> values;
    for (const Setting& setting : scenario.settings) values.insert(setting.key + " = " + setting.value);
    return values;
  };
  EXPECT_EQ(values_of(simulator.scenario()), values_of(written.scenario()));
  std::set<std::string> origins;
  for (const Setting& setting : simulator.scenario().settings) {
    if (setting.key.starts_with("sensor.a"))
      origins.insert(setting.origin.substr(0, setting.origin.find(':')));
    if (setting.key.starts_with("sensor.b")) {
      EXPECT_EQ(setting.origin, "default") << setting.key;
    }
  }
  EXPECT_EQ(origins, std::set<std::string>{"small.map"});
}

TEST(Simulator, IgnoresTheSensorsOfTheMapWhereTheScenarioHasItsOwn) {
  // One that could not be read does not matter either.
  const std::string in_map = sensor_entity("back", "") + sensor_entity("bad", "\"noise_m\" \"-1\"\n");
  World world(test::scenario_text(kEyes), test::map_text(test::pillars(), in_map));
  const Simulator simulator(world.scenario(), 1, trace::Backend::kBruteForce);
  ASSERT_EQ(simulator.scenario().sensors.size(), 1u);
  EXPECT_EQ(std::get<sense::PointSensorSpec>(simulator.scenario().sensors[0]).name, "eyes");
  for (const Setting& setting : simulator.scenario().settings)
    EXPECT_FALSE(setting.key.starts_with("sensor.b")) << setting.key;
}

TEST(Simulator, ABadSensorOfTheMapIsRefusedWithTheMapsLine) {
  const std::string map = test::map_text("", sensor_entity("eyes", "\"horizontal_fov_deg\" \"0\"\n"));
  World world(test::scenario_text(), map);
  const auto error = test::error_of([&] { Simulator(world.scenario(), 1, trace::Backend::kBruteForce); });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_TRUE(error->where().file.ends_with("small.map")) << error->where().file;
  EXPECT_EQ(error->where().line, std::count(map.begin(), map.end(), '\n') - 1);
  EXPECT_NE(error->message().find("horizontal_fov_deg"), std::string::npos) << error->what();
}

TEST(Simulator, HasNoSensorWhereNeitherScenarioNorMapHasOne) {
  World world(test::scenario_text());
  const Simulator simulator(world.scenario(), 1, trace::Backend::kBruteForce);
  EXPECT_TRUE(simulator.scenario().sensors.empty());
  EXPECT_TRUE(simulator.step(0).readings.empty());
}

TEST(Simulator, DrawsOtherNoiseForAnotherSeed) {
  World world(test::scenario_text(kEyes));
  const std::string before = bytes_of_run(world.scenario(), 1, trace::Backend::kBruteForce);
  ++world.scenario().seed;
  EXPECT_NE(bytes_of_run(world.scenario(), 1, trace::Backend::kBruteForce), before);
}

TEST(Simulator, RefusesAFrameBeyondTheLast) {
  World world(test::scenario_text());
  const Simulator simulator(world.scenario(), 1, trace::Backend::kBruteForce);
  EXPECT_TRUE(test::error_of([&] { simulator.step(40); }).has_value());
}

TEST(Simulator, NamesThePathsThatExist) {
  World world(test::scenario_text());
  world.scenario().robot.path = "rund";
  const auto error = test::error_of([&] { Simulator(world.scenario(), 1, trace::Backend::kBruteForce); });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_NE(std::string(error->what()).find("round"), std::string::npos);
}

TEST(Simulator, NamesAMapThatIsMissing) {
  World world(test::scenario_text());
  world.scenario().map_file = "nowhere/none.map";
  const auto error = test::error_of([&] { Simulator(world.scenario(), 1, trace::Backend::kBruteForce); });
  ASSERT_TRUE(error.has_value());
  EXPECT_EQ(error->code(), ErrorCode::kIo);
  EXPECT_EQ(error->where().file, "nowhere/none.map");
}

/// The one problem that a simulator of this world reports.
Error only_problem(World& world) {
  const Simulator simulator(world.scenario(), 1, trace::Backend::kBruteForce);
  if (simulator.problems().size() == 1) return simulator.problems()[0];
  ADD_FAILURE() << simulator.problems().size() << " problems";
  return Error(ErrorCode::kInternal, "");
}

TEST(Simulator, HasNoProblemsWithAGoodMap) {
  World world(test::scenario_text());
  EXPECT_TRUE(Simulator(world.scenario(), 1, trace::Backend::kBruteForce).problems().empty());
}

TEST(Simulator, LeavesOutABadBrushAndSaysSo) {
  std::string flat = test::block(500, 500, 0, 510, 510, 10);
  flat.resize(flat.rfind("\n( ") + 1);  // one face less: the block is open
  World world(test::scenario_text(), test::map_text(test::pillars() + flat + "}\n"));
  const Error problem = only_problem(world);
  EXPECT_GT(problem.where().line, 0);
  EXPECT_NE(problem.where().element.find("brush 4"), std::string::npos) << problem.what();
  EXPECT_EQ(Simulator(world.scenario(), 1, trace::Backend::kBruteForce).world().solids.size(), 4u);
}

TEST(Simulator, SaysWhereThePathRunsIntoASolid) {
  World world(test::scenario_text(), test::map_text(test::block(200, 250, -50, 201, 350, 50)));
  world.scenario().robot = {.path = "ahead", .speed_m_s = 1.0};
  const Error problem = only_problem(world);
  EXPECT_NE(problem.message().find("entity 0, brush 0 after 2 m"), std::string::npos) << problem.what();
  EXPECT_NE(problem.where().element.find("ahead"), std::string::npos);
}

TEST(Simulator, DoesNotMindASolidBeyondTheWayThatIsTaken) {
  World world(test::scenario_text(), test::map_text(test::block(200, 250, -50, 201, 350, 50)));
  world.scenario().robot = {.path = "ahead", .speed_m_s = 0.1};
  EXPECT_TRUE(Simulator(world.scenario(), 1, trace::Backend::kBruteForce).problems().empty());
}

TEST(Simulator, StandsWhereThePathRunsIntoASolid) {
  World world(test::scenario_text(), test::map_text(test::block(200, 250, -50, 201, 350, 50)));
  world.scenario().robot = {.path = "ahead", .speed_m_s = 1.0};
  const Simulator simulator(world.scenario(), 1, trace::Backend::kBruteForce);
  const Vec3 start = simulator.pose_at(0).t;
  const double step_m = simulator.step_length_m();
  for (std::uint32_t i = 0; i < world.scenario().steps; ++i) {
    const double wanted_m = step_m * i;
    EXPECT_NEAR((simulator.pose_at(i).t - start).norm(), std::min(wanted_m, 2.0), 0.0011) << i;
    EXPECT_LT((simulator.pose_at(i).t - start).norm(), 2.0) << i;
  }
  EXPECT_GT(step_m * (world.scenario().steps - 1), 2.5) << "it never came to the wall";
}

TEST(Simulator, ASmoothRobotComesToRestBeforeASolid) {
  World world(test::scenario_text(), test::map_text(test::block(200, 250, -50, 201, 350, 50)));
  world.scenario().robot = {.path = "ahead", .speed_m_s = 1.0, .smooth = true};
  world.scenario().steps = 80;
  const Simulator simulator(world.scenario(), 1, trace::Backend::kBruteForce);
  ASSERT_EQ(simulator.problems().size(), 1u);
  const Vec3 start = simulator.pose_at(0).t;
  double fastest_m = 0.0;
  for (std::uint32_t i = 1; i < 80; ++i) {
    EXPECT_EQ(simulator.pose_at(i).t, simulator.pose_at_time(std::int64_t{i} * 100'000'000).t);
    fastest_m = std::max(fastest_m, (simulator.pose_at(i).t - simulator.pose_at(i - 1).t).norm());
  }
  EXPECT_NEAR((simulator.pose_at(79).t - start).norm(), 1.999, 1e-9);
  EXPECT_NEAR(fastest_m, 0.1, 0.001);
  EXPECT_LT((simulator.pose_at(1).t - start).norm(), 1e-4) << "it begins at rest";
}

TEST(Simulator, ASmoothRobotDoesNotMindASolidThatItDoesNotReach) {
  World world(test::scenario_text(), test::map_text(test::block(200, 250, -50, 201, 350, 50)));
  world.scenario().robot = {.path = "ahead", .speed_m_s = 1.0, .smooth = true};
  world.scenario().steps = 25;
  EXPECT_TRUE(Simulator(world.scenario(), 1, trace::Backend::kBruteForce).problems().empty());
}

TEST(Simulator, ABodyStopsAtItsRadius) {
  World world(test::scenario_text(), test::map_text(test::block(200, 250, -50, 201, 350, 50)));
  world.scenario().robot = {.path = "ahead", .speed_m_s = 1.0, .body = bsp::Cylinder{0.3, -0.2, 0.2}};
  const Simulator simulator(world.scenario(), 1, trace::Backend::kBruteForce);
  const Vec3 end = simulator.pose_at(world.scenario().steps - 1).t;
  EXPECT_NEAR((end - simulator.pose_at(0).t).norm(), 1.7, 0.002);
  ASSERT_EQ(simulator.problems().size(), 1u);
  EXPECT_NE(simulator.problems()[0].message().find("after 1.7 m"), std::string::npos)
      << simulator.problems()[0].what();
}

TEST(Simulator, ABodyMeetsWhatAPointPassesBy) {
  // Beside the path, 10 cm away.
  const std::string beside = test::map_text(test::block(200, 310, -50, 201, 350, 50));
  World world(test::scenario_text(), beside);
  world.scenario().robot = {.path = "ahead", .speed_m_s = 1.0};
  EXPECT_TRUE(Simulator(world.scenario(), 1, trace::Backend::kBruteForce).problems().empty());
  world.scenario().robot.body = bsp::UprightBox{0.2, 0.3, 0.0, -0.1, 0.1};
  EXPECT_NE(only_problem(world).message().find("runs into"), std::string::npos);
}

/// The error of a simulator of this world.
Error only_error(World& world) {
  const auto error = test::error_of([&] { Simulator(world.scenario(), 1, trace::Backend::kBruteForce); });
  if (error) return *error;
  ADD_FAILURE() << "no error";
  return Error(ErrorCode::kInternal, "");
}

TEST(Simulator, RefusesAPathThatBeginsInsideASolid) {
  World world(test::scenario_text(), test::map_text(test::block(-50, 250, -50, 50, 350, 50)));
  world.scenario().robot = {.path = "ahead", .speed_m_s = 0.1};
  const Error error = only_error(world);
  EXPECT_EQ(error.code(), ErrorCode::kBadInput);
  EXPECT_NE(error.message().find("begins inside entity 0, brush 0"), std::string::npos) << error.what();
}

TEST(Simulator, RefusesARobotStartInsideASolid) {
  const std::string start = "{\n\"classname\" \"hw_robot_start\"\n\"origin\" \"310 0 0\"\n}\n";
  World world(test::scenario_text(), test::map_text(test::pillars(), start));
  const Error error = only_error(world);
  EXPECT_EQ(error.code(), ErrorCode::kBadInput);
  EXPECT_GT(error.where().line, 0);
  EXPECT_NE(error.message().find("is in solid"), std::string::npos) << error.what();
}

TEST(Simulator, RefusesTwoRobotStarts) {
  const std::string start = "{\n\"classname\" \"hw_robot_start\"\n\"origin\" \"0 0 0\"\n}\n";
  World world(test::scenario_text(), test::map_text(test::pillars(), start + start));
  EXPECT_TRUE(
      test::error_of([&] { Simulator(world.scenario(), 1, trace::Backend::kBruteForce); }).has_value());
}

TEST(Simulator, RunsInAnEmptyWorld) {
  World world(test::scenario_text(kEyes), test::map_text(""));
  const Simulator simulator(world.scenario(), 1, trace::Backend::kBruteForce);
  EXPECT_EQ(simulator.landmarks().size(), 16u);  // 400 on 100 m of a path of 4 m
  EXPECT_EQ(simulator.step(3).readings.size(), 1u);
}

/// A sensor of its own rate: what it saw at the time of a frame is what one that is read with every frame saw of the world then.
TEST(Simulator, AReadingIsTakenAtItsOwnTime) {
  World every(test::scenario_text(kEyes)), twice(test::scenario_text(std::string(kEyes) + "rate_hz = 20\n"));
  const Simulator a(every.scenario(), 1, trace::Backend::kBruteForce);
  const Simulator b(twice.scenario(), 1, trace::Backend::kBruteForce);
  const Frame first = b.step(0);
  ASSERT_EQ(first.readings.size(), 1u);
  const Frame second = b.step(1);
  ASSERT_EQ(second.readings.size(), 2u);
  EXPECT_EQ(second.readings[0].t_ns, 50'000'000);
  EXPECT_EQ(second.readings[1].t_ns, 100'000'000);
  EXPECT_EQ(second.readings[1].sequence, 2u);
  const auto seen = [](const Reading& reading) {
    std::set<std::uint32_t> landmarks;
    for (const auto& observation : reading.observations()) landmarks.insert(observation.landmark);
    return landmarks;
  };
  EXPECT_EQ(seen(second.readings[1]), seen(a.step(1).readings.at(0)));
  // Half way between two frames the robot is half way between two poses.
  const Vec3 half = b.pose_at_time(50'000'000).t;
  EXPECT_NEAR((half - b.pose_at(0).t).norm(), (b.pose_at(1).t - half).norm(), 1e-3);
  EXPECT_EQ(b.pose_at_time(100'000'000).t, b.pose_at(1).t);
}

TEST(Simulator, ASensorWhoseReadingsComeTooLateIsReported) {
  World world(test::scenario_text(std::string(kEyes) + "latency_s = 3.91\n"));
  const Simulator simulator(world.scenario(), 1, trace::Backend::kBruteForce);
  const auto is_told = [](const Error& problem) {
    return problem.message() == "no reading arrives by the last frame" &&
           problem.where().element == "sensor `eyes`";
  };
  EXPECT_EQ(std::ranges::count_if(simulator.problems(), is_told), 1);
  World in_time(test::scenario_text(std::string(kEyes) + "latency_s = 3.9\n"));
  EXPECT_EQ(std::ranges::count_if(Simulator(in_time.scenario(), 1, trace::Backend::kBruteForce).problems(),
                                  is_told),
            0);
}

TEST(Simulator, AFrameThatWouldHoldTooManyReadingsIsRefused) {
  World world(test::scenario_text(std::string(kEyes) + "rate_hz = 10000\n"));
  world.scenario().period_ns = 2'000'000'000;
  const auto error = test::error_of([&] { Simulator(world.scenario(), 1, trace::Backend::kBruteForce); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_NE(error->message().find("20000 readings"), std::string::npos) << error->what();
}

}  // namespace
}  // namespace hallway::sim
