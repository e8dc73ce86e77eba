// SPDX-License-Identifier: MIT
#include "sim/rig.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "sim/sensor_presets.hpp"
#include "sim/sensors.hpp"
#include "sim/simulator.hpp"
#include "support/errors.hpp"
#include "unit/sim/drive_world.hpp"

namespace hallway::sim::test {
namespace {

/// A sensor of each kind that works on a path, with noise, rates and delays of its own.
const std::map<std::string, std::string> kSensors{
    {"eyes", "kind = 'points'\nnoise_m = 0.01\nrate_hz = 7.3\n"},
    {"walls", "kind = 'planes'\nnoise_m = 0.01\n"},
    {"faces", "kind = 'faces'\nnoise_m = 0.01\nrate_hz = 3\nlatency_s = 0.05\n"},
    {"scanner",
     "kind = 'lidar'\nrings = 3\ncolumns = 90\nstep_deg = 4\nnoise_m = 0.02\ndropout = 0.1\nrate_hz = "
     "9\nclock_jitter_s = 0.001\n"},
    {"sonar",
     "kind = 'sonar'\npreset = 'sonar_polaroid'\npings = 6\nping_step_deg = 60\nsweep_s = 0.3\nrate_hz = "
     "3\nresolution_deg = "
     "5\necho"
     "es = 2\nfalse_rate = 0.1\n"},
    {"infrared", "kind = 'infrared'\npreset = 'ir_sharp'\nmax_range_m = 3\nyaw_deg = 40\n"},
    {"gnss", "kind = 'gnss'\npreset = 'gnss_meter'\nposition_m = [0, 0, 0.5]\n"},
    {"compass", "kind = 'compass'\npreset = 'compass'\n"},
    {"imu", "kind = 'imu'\npreset = 'imu_mems'\nposition_m = [0.1, 0, 0]\nclock_drift_ppm = 100\n"},
    {"gyro", "kind = 'gyro'\ngyro_noise = 0.01\nrate_hz = 33\nphase_s = 0.01\n"},
    {"wheels", "kind = 'encoders'\nrate_hz = 50\n"},
    {"odometer", "kind = 'odometry'\nrate_hz = 20\nradius_error_sigma = 0.01\n"},
    {"mouse", "kind = 'mouse'\nrate_hz = 25\napart_m = 0.1\nnoise_per_root_m = 0.001\n"}};

std::string tables(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += "[sensor." + name + "]\n" + kSensors.at(name);
  return text;
}

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const auto& [name, keys] : kSensors) names.push_back(name);
  return names;
}

struct RigWorld {
  explicit RigWorld(const std::string& sensors, unsigned threads = 1, const std::string& robot = "") {
    folder.write("small.map", map_text(pillars()));
    std::string text = scenario_text(sensors);
    text.replace(text.find("[robot]\n"), 8, "[robot]\n" + robot);
    simulator = std::make_unique<Simulator>(load_scenario(folder.write("s.toml", text)), threads,
                                            trace::Backend::kBruteForce);
  }

  /// The readings of a sensor up to a frame.
  std::vector<Reading> readings_of(const std::string& name, std::uint32_t frames = 40) const {
    std::vector<Reading> found;
    for (std::uint32_t i = 0; i < frames; ++i) {
      for (Reading& reading : simulator->step(i).readings) {
        const std::string& of = std::visit([](const auto& spec) -> const std::string& { return spec.name; },
                                           simulator->scenario().sensors[reading.sensor]);
        if (of == name) found.push_back(std::move(reading));
      }
    }
    return found;
  }

  TempFolder folder;
  std::unique_ptr<Simulator> simulator;
};

void add(double value, std::vector<std::uint64_t>& bits) {
  bits.push_back(std::bit_cast<std::uint64_t>(value));
}

template <typename Values>
void add_all(const Values& values, std::vector<std::uint64_t>& bits) {
  for (const auto value : values) add(static_cast<double>(value), bits);
}

/// Everything that a reading says, as bits.
std::vector<std::uint64_t> bits_of(const Reading& reading) {
  std::vector<std::uint64_t> bits{reading.sequence, static_cast<std::uint64_t>(reading.t_begin_ns),
                                  static_cast<std::uint64_t>(reading.t_ns),
                                  static_cast<std::uint64_t>(reading.stamp_begin_ns),
                                  static_cast<std::uint64_t>(reading.stamp_ns)};
  if (const auto* points = std::get_if<std::vector<sense::PointObservation>>(&reading.sensed)) {
    for (const auto& seen : *points) add_all(seen.point, bits);
  } else if (const auto* planes = std::get_if<std::vector<PlaneObservation>>(&reading.sensed)) {
    for (const auto& seen : *planes) {
      add_all(seen.plane.normal, bits);
      add(seen.plane.offset, bits);
    }
  } else if (const auto* lidar = std::get_if<LidarSensed>(&reading.sensed)) {
    add_all(lidar->reading.range_m, bits);
    add_all(lidar->truth.range_m, bits);
  } else if (const auto* sonar = std::get_if<SonarSensed>(&reading.sensed)) {
    add_all(sonar->reading.range_m, bits);
    add_all(sonar->truth.range_m, bits);
  } else if (const auto* infrared = std::get_if<InfraredSensed>(&reading.sensed)) {
    add_all(infrared->reading.range_m, bits);
    add_all(infrared->truth.range_m, bits);
  } else if (const auto* gnss = std::get_if<GnssSensed>(&reading.sensed)) {
    add_all(gnss->reading.position, bits);
    add_all(gnss->truth.correlated, bits);
  } else if (const auto* compass = std::get_if<CompassSensed>(&reading.sensed)) {
    add(compass->reading.heading_rad, bits);
  } else if (const auto* imu = std::get_if<ImuSensed>(&reading.sensed)) {
    add_all(imu->reading.angular_rad_s, bits);
    add_all(imu->reading.force_m_s2, bits);
    add_all(imu->truth.force_bias, bits);
  } else if (const auto* encoders = std::get_if<EncoderSensed>(&reading.sensed)) {
    add_all(encoders->reading.ticks, bits);
  } else {
    const auto& odometry = std::get<OdometrySensed>(reading.sensed).reading;
    add_all(odometry.T_odom_sensor.t, bits);
    add_all(odometry.T_odom_sensor.q.coeffs(), bits);
    add_all(odometry.covariance, bits);
  }
  return bits;
}

std::vector<std::vector<std::uint64_t>> bits_of(const std::vector<Reading>& readings) {
  std::vector<std::vector<std::uint64_t>> all;
  for (const Reading& reading : readings) all.push_back(bits_of(reading));
  return all;
}

TEST(Rig, ASensorReadsTheSameWhateverElseIsMounted) {
  const RigWorld all(tables(all_names()));
  std::vector<std::string> names = all_names();
  std::ranges::reverse(names);
  const RigWorld reversed(tables(names));
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    const RigWorld alone(tables({name}));
    const auto readings = bits_of(alone.readings_of(name));
    EXPECT_GE(readings.size(), 8u);
    EXPECT_EQ(bits_of(all.readings_of(name)), readings);
    EXPECT_EQ(bits_of(reversed.readings_of(name)), readings);
  }
}

TEST(Rig, FramesAreTheSameInAnyOrderAndForAnyThreads) {
  const RigWorld one(tables(all_names())), four(tables(all_names()), 4);
  std::vector<std::vector<std::vector<std::uint64_t>>> frames;
  for (std::uint32_t i = 0; i < 40; ++i) frames.push_back(bits_of(one.simulator->step(i).readings));
  for (const std::uint32_t i : {39u, 3u, 20u, 21u, 0u, 38u, 7u, 6u})
    EXPECT_EQ(bits_of(four.simulator->step(i).readings), frames[i]) << "frame " << i;
}

TEST(Rig, ReadingsComeWhenTheyHaveEnded) {
  const RigWorld world(tables(all_names()));
  std::map<std::size_t, std::uint64_t> next;
  for (std::uint32_t i = 0; i < 40; ++i) {
    const Frame frame = world.simulator->step(i);
    for (const Reading& reading : frame.readings) {
      const auto timing = std::visit([](const auto& spec) { return spec.timing; },
                                     world.simulator->scenario().sensors[reading.sensor]);
      const std::int64_t arrival_ns = reading.t_ns + std::llround(timing.latency_s * 1e9);
      EXPECT_LE(arrival_ns, frame.t_ns);
      EXPECT_EQ(reading.sequence, next[reading.sensor]++) << "none is left out";
      EXPECT_LE(reading.t_begin_ns, reading.t_ns);
    }
  }
}

TEST(Rig, InertialReadingsFollowEachOtherWithoutAGap) {
  const RigWorld world(tables({"imu"}));
  const std::vector<Reading> readings = world.readings_of("imu");
  ASSERT_EQ(readings.size(), 780u) << "200 Hz, 3.9 s";
  EXPECT_EQ(readings.front().t_begin_ns, 0);
  for (std::size_t i = 1; i < readings.size(); ++i) EXPECT_EQ(readings[i].t_begin_ns, readings[i - 1].t_ns);
}

TEST(Rig, StampsAreTheSensorsAndTheTruthIsKept) {
  const RigWorld exact("[sensor.imu]\nkind = 'imu'\nrate_hz = 100\n");
  const RigWorld off(
      "[sensor.imu]\nkind = 'imu'\nrate_hz = 100\nclock_offset_s = 0.25\nclock_drift_ppm = 1000\n");
  const auto true_times = exact.readings_of("imu"), shifted = off.readings_of("imu");
  ASSERT_EQ(true_times.size(), shifted.size());
  for (std::size_t i = 0; i < shifted.size(); ++i) {
    EXPECT_EQ(true_times[i].stamp_ns, true_times[i].t_ns);
    EXPECT_EQ(shifted[i].t_ns, true_times[i].t_ns) << "the clock moves stamps alone";
    EXPECT_NEAR(static_cast<double>(shifted[i].stamp_ns),
                1.001 * static_cast<double>(shifted[i].t_ns) + 0.25e9, 1.0);
  }
}

TEST(Rig, AMountErrorIsInWhatIsMeasuredAndNotInWhatIsTold) {
  const std::string lidar = "[sensor.scanner]\nkind = 'lidar'\nrings = 1\ncolumns = 36\nstep_deg = 10\n";
  const RigWorld told(
      lidar +
      "position_m = [0.1, 0, 0]\nyaw_deg = 30\nmount_error_m = [0, 0.05, 0]\nmount_error_deg = [2, 0, 0]\n");
  // The same place: 0.05 m to the left of a mount that is turned by 30 degrees.
  const RigWorld there(lidar + "position_m = [0.075, 0.04330127018922194, 0]\nyaw_deg = 32\n");
  const auto& spec = std::get<sense::LidarSpec>(told.simulator->scenario().sensors[0]);
  EXPECT_NEAR(spec.T_body_sensor.t.x(), 0.1, 1e-15);
  const auto a = told.readings_of("scanner"), b = there.readings_of("scanner");
  ASSERT_EQ(a.size(), b.size());
  int compared = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto &x = std::get<LidarSensed>(a[i].sensed).reading.range_m,
               &y = std::get<LidarSensed>(b[i].sensed).reading.range_m;
    for (std::size_t k = 0; k < x.size(); ++k) {
      if (std::isinf(x[k]) || std::isinf(y[k])) continue;
      EXPECT_NEAR(x[k], y[k], 1e-9);
      ++compared;
    }
  }
  EXPECT_GT(compared, 100);
}

TEST(Rig, WheelsOnAPathRollItsWay) {
  const RigWorld world(
      "[sensor.wheels]\nkind = 'encoders'\nrate_hz = 20\nwheel_base_m = 0.4\nwheel_radius_m = "
      "0.1\nticks_per_revolution = 1000\n"
      "[sensor.odometer]\nkind = 'odometry'\nrate_hz = 200\nwheel_base_m = 0.4\nticks_per_revolution = "
      "1000000\n");
  const double tick_m = 2.0 * M_PI * 0.1 / 1000.0;
  const auto wheels = world.readings_of("wheels");
  const Reading& last = wheels.back();
  const double way_m = world.simulator->step_length_m() * static_cast<double>(last.t_ns) * 1e-8;
  const auto& ticks = std::get<EncoderSensed>(last.sensed).reading.ticks;
  EXPECT_NEAR(0.5 * static_cast<double>(ticks[0] + ticks[1]) * tick_m, way_m, tick_m);
  // Round to the left: a right wheel rolls farther by the base times the turn.
  const Pose start = world.simulator->pose_at_time(0), now = world.simulator->pose_at_time(last.t_ns);
  const double turns = std::floor(way_m / world.simulator->path().length_m());
  double turn = rotation_vector(start.q.conjugate() * now.q).z();
  if (turn < -1e-9) turn += 2.0 * M_PI;
  turn += 2.0 * M_PI * turns;
  EXPECT_NEAR(static_cast<double>(ticks[1] - ticks[0]) * tick_m, 0.4 * turn, 2.0 * tick_m);

  const auto odometry = world.readings_of("odometer");
  const Pose reckoned = std::get<OdometrySensed>(odometry.back().sensed).reading.T_odom_sensor;
  const Pose moved = start.inverse() * world.simulator->pose_at_time(odometry.back().t_ns);
  EXPECT_LT((reckoned.t - moved.t).norm(), 2e-3);
  EXPECT_LT(angle_between(reckoned.q, moved.q), 2e-3);
}

TEST(Rig, OdometryGoesOnWhileItIsOff) {
  const std::string sensor = "[sensor.odometer]\nkind = 'odometry'\nrate_hz = 20\n";
  const RigWorld on(sensor);
  const RigWorld off(sensor +
                     "[[event]]\nat_s = 1\nkind = 'sensor_off'\nsensor = 'odometer'\n[[event]]\nat_s = "
                     "3\nkind = 'sensor_on'\nsensor = 'odometer'\n");
  const auto all = bits_of(on.readings_of("odometer")), some = bits_of(off.readings_of("odometer"));
  EXPECT_EQ(some.size() + 40, all.size());
  EXPECT_EQ(some.back(), all.back()) << "what it sums up has gone on";
}

TEST(Rig, ASensorReachesAsFarAsItsKindDoes) {
  const RigWorld world(
      "[sensor.a]\nkind = 'sonar'\n[sensor.b]\nkind = 'infrared'\n[sensor.c]\nkind = 'lidar'\n");
  const auto& sensors = world.simulator->scenario().sensors;
  EXPECT_EQ(std::get<sense::SonarSpec>(sensors[0]).max_range_m, 10.0);
  EXPECT_EQ(std::get<sense::InfraredSpec>(sensors[1]).max_range_m, 0.8);
  EXPECT_EQ(std::get<sense::LidarSpec>(sensors[2]).max_range_m, 100.0);
}

TEST(Rig, APresetCountsWhereNothingElseIsSaid) {
  const RigWorld world("[sensor.a]\nkind = 'lidar'\npreset = 'lidar2d_270'\ncolumns = 541\nstep_deg = 0.5\n");
  const auto& spec = std::get<sense::LidarSpec>(world.simulator->scenario().sensors[0]);
  EXPECT_EQ(spec.timing.rate_hz, 40.0);
  EXPECT_EQ(spec.pattern.width, 541u);
  EXPECT_EQ(spec.pattern.height, 1u);
  EXPECT_NEAR(spec.pattern.rays.front().azimuth_rad, -0.75 * M_PI, 1e-12);
  EXPECT_NEAR(spec.pattern.rays.back().azimuth_rad, 0.75 * M_PI, 1e-9);
  EXPECT_EQ(spec.max_range_m, 30.0);
  for (const SensorPreset& preset : sensor_presets()) {
    SCOPED_TRACE(std::string(preset.name));
    const RigWorld made("[sensor.a]\nkind = '" + std::string(preset.kind) + "'\npreset = '" +
                        std::string(preset.name) + "'\n");
    EXPECT_EQ(
        std::visit([](const auto& s) { return s.timing.rate_hz; }, made.simulator->scenario().sensors[0]),
        parse_double(std::ranges::find(preset.values, "rate_hz", [](const auto& pair) {
                       return pair.first;
                     })->second));
  }
}

TEST(Rig, BadSensorsAreRefusedByName) {
  const std::pair<const char*, const char*> bad[] = {
      {"kind = 'lidar'\ncolumns = 1000\nstep_deg = 1\n", "columns"},
      {"kind = 'lidar'\nrings = 4096\ncolumns = 1000\nstep_deg = 0.1\n", "columns"},
      {"kind = 'lidar'\nmin_range_m = 5\nmax_range_m = 2\n", "min_range_m"},
      {"kind = 'lidar'\nmax_range_m = 0\n", "max_range_m"},
      {"kind = 'lidar'\npreset = 'imu_mems'\n", "preset"},
      {"kind = 'imu'\nrate_hz = 1000000\n", "rate_hz"},
      {"kind = 'imu'\nmount_error_deg = [0, nan, 0]\n", "mount_error_deg"},
      {"kind = 'odometry'\nposition_m = [0, 0, 0]\n", "position_m"},
      {"kind = 'bump'\n", "needs a [robot.drive]"}};
  for (const auto& [keys, cause] : bad) {
    const auto error =
        hallway::test::error_of([&keys = keys] { RigWorld(std::string("[sensor.s]\n") + keys); });
    ASSERT_TRUE(error) << keys;
    EXPECT_NE(std::string(error->what()).find(cause), std::string::npos) << error->what();
  }
}

}  // namespace
}  // namespace hallway::sim::test
