// SPDX-License-Identifier: MIT
//
// Scenarios of sensors that cannot be, and of those that can but are extreme: what each is told, or how it behaves.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "sim/simulator.hpp"
#include "support/errors.hpp"
#include "support/temp_folder.hpp"
#include "unit/sim/small_world.hpp"

namespace hallway::sim {
namespace {

/// Of every kind that a robot on a path can have, what is needed beside `kind`.
const std::map<std::string, std::string>& kinds_on_a_path() {
  static const std::map<std::string, std::string> kKinds{
      {"points", ""},
      {"planes", ""},
      {"faces", ""},
      {"encoders", ""},
      {"lidar", "rings = 2\ncolumns = 36\nstep_deg = 10\n"},
      {"sonar", "resolution_deg = 5\n"},
      {"infrared", ""},
      {"gnss", ""},
      {"compass", ""},
      {"imu", ""},
      {"gyro", ""},
      {"odometry", ""},
      {"mouse", ""}};
  return kKinds;
}

class SensorFaults : public testing::Test {
 protected:
  /// A sensor `s`, whose keys begin at line 9 of the scenario.
  std::unique_ptr<Simulator> make(const std::string& keys,
                                  const std::string& brushes = hallway::test::pillars()) {
    folder_.write("small.map", hallway::test::map_text(brushes));
    const std::string text = hallway::test::scenario_text("[sensor.s]\n" + keys);
    return std::make_unique<Simulator>(load_scenario(folder_.write("s.toml", text)), 1,
                                       trace::Backend::kEmbree);
  }
  std::string of_kind(const std::string& kind) const {
    return "kind = '" + kind + "'\n" + kinds_on_a_path().at(kind);
  }

  hallway::test::TempFolder folder_;
};

struct Refused {
  const char* name;
  std::string keys;
  int line;  ///< of the scenario; 0: the message has none
  std::string cause;
};

class RefusedSensor : public SensorFaults, public testing::WithParamInterface<Refused> {};

TEST_P(RefusedSensor, SaysFileLineAndCause) {
  const auto error = hallway::test::error_of([&] { make(GetParam().keys); });
  ASSERT_TRUE(error) << "it was made";
  EXPECT_EQ(error->code(), ErrorCode::kBadInput);
  EXPECT_TRUE(error->where().file.ends_with("s.toml")) << error->what();
  EXPECT_EQ(error->where().line, GetParam().line) << error->what();
  EXPECT_NE(std::string(error->what()).find("s"), std::string::npos);
  EXPECT_NE(std::string(error->what()).find(GetParam().cause), std::string::npos) << error->what();
}

Refused bad(const char* name, const std::string& kind, const std::string& key, const std::string& cause) {
  return {name, "kind = '" + kind + "'\n" + key + "\n", 10, cause};
}

/// Of a beam: on a circle.
std::string corners(int n) {
  std::string text;
  for (int i = 0; i < n; ++i)
    text += (i == 0 ? "" : ", ") + std::to_string(3.0 + std::cos(6.28 * i / n)) + ", " +
            std::to_string(std::sin(6.28 * i / n));
  return text;
}

INSTANTIATE_TEST_SUITE_P(
    Values, RefusedSensor,
    testing::Values(
        // 0 Hz is a reading a frame; below it there is nothing, and 1 MHz is too much.
        bad("RateNegative", "lidar", "rate_hz = -1", "out of range"),
        bad("RateNan", "imu", "rate_hz = nan", "out of range"),
        bad("RateMegahertz", "imu", "rate_hz = 1e6", "out of range"),
        bad("RateMegahertzMouse", "mouse", "rate_hz = 1e6", "out of range"),
        bad("LatencyNegative", "lidar", "latency_s = -0.1", "out of range"),
        bad("LatencyNan", "odometry", "latency_s = nan", "out of range"),
        bad("PhaseInfinite", "gyro", "phase_s = inf", "out of range"),
        bad("ClockDriftStops", "imu", "clock_drift_ppm = -1e6", "out of range"),
        bad("ClockDriftNan", "imu", "clock_drift_ppm = nan", "out of range"),
        bad("ClockJitterNegative", "lidar", "clock_jitter_s = -1", "out of range"),
        bad("ClockOffsetHuge", "lidar", "clock_offset_s = 1e300", "out of range"),
        // Mounts.
        bad("MountNan", "lidar", "position_m = [0, nan, 0]", "out of range"),
        bad("MountInfinite", "imu", "position_m = [inf, 0, 0]", "out of range"),
        bad("MountHuge", "mouse", "position_m = [1e9, 0, 0]", "out of range"),
        bad("MountTurnNan", "lidar", "pitch_deg = nan", "out of range"),
        bad("MountErrorNan", "gyro", "mount_error_deg = [0, 0, nan]", "out of range"),
        bad("MountErrorHuge", "lidar", "mount_error_m = [5, 0, 0]", "out of range"),
        // Lidar.
        bad("LidarNoRing", "lidar", "rings = 0", "out of range"),
        bad("LidarNoColumn", "lidar", "columns = 0", "out of range"),
        bad("LidarHalfAColumn", "lidar", "columns = 0.5", "whole number"),
        bad("LidarTooManyRays", "lidar", "columns = 1048577", "out of range"),
        bad("LidarMoreThanATurn", "lidar", "columns = 1801", "more than a turn"),
        bad("LidarStepZero", "lidar", "step_deg = 0", "out of range"),
        bad("LidarStepNan", "lidar", "step_deg = nan", "out of range"),
        bad("LidarElevation", "lidar", "lowest_deg = -91", "out of range"),
        bad("LidarAzimuth", "lidar", "from_deg = 361", "out of range"),
        bad("LidarNoReach", "lidar", "max_range_m = 0", "above 0"),
        bad("LidarRangeNan", "lidar", "max_range_m = nan", "out of range"),
        bad("LidarNearestBehindFarthest", "lidar", "min_range_m = 200", "is above"),
        bad("LidarNoiseNegative", "lidar", "noise_m = -0.01", "out of range"),
        bad("LidarNoiseNan", "lidar", "noise_per_m = nan", "out of range"),
        bad("LidarDropout", "lidar", "dropout = 1.01", "out of range"),
        bad("LidarDropoutNan", "lidar", "dropout_at_max = nan", "out of range"),
        bad("LidarReturns", "lidar", "returns = 3", "out of range"),
        bad("LidarBeam", "lidar", "beam_deg = 10", "out of range"),
        bad("LidarPulseNan", "lidar", "pulse_m = nan", "out of range"),
        bad("LidarPreset", "lidar", "preset = 'imu_mems'", "preset"),
        bad("LidarNeedsRateForPattern", "lidar", "pattern = 'beams.csv'", "needs `rate_hz`"),
        // Sonar and infrared.
        bad("BeamOfTwoPoints", "sonar", "beam_m = [0, 0, 1, 0]", "at least 3"),
        bad("BeamOddNumber", "sonar", "beam_m = [0, 0, 1, 0, 1]", "odd number"),
        bad("BeamCrosses", "sonar", "beam_m = [0, 0, 2, 2, 2, 0, 0, 2]", "cross or touch"),
        bad("BeamNan", "sonar", "beam_m = [0, 0, nan, 0, 1, 1]", "out of range"),
        bad("BeamNoList", "sonar", "beam_m = 3", "list of numbers"),
        bad("BeamTooManyCorners", "sonar", "beam_m = [" + corners(10'000) + "]", "it may have"),
        bad("ConeZero", "sonar", "cone_deg = 0", "out of range"),
        bad("ConeNan", "sonar", "cone_deg = nan", "out of range"),
        bad("ResolutionZero", "sonar", "resolution_deg = 0", "out of range"),
        bad("ResolutionTooFine", "sonar", "resolution_deg = 0.001", "too fine"),
        bad("SweepOfYears", "sonar", "sweep_s = 1e9", "out of range"),
        bad("SweepNegative", "sonar", "sweep_s = -1", "out of range"),
        bad("NoPing", "sonar", "pings = 0", "out of range"),
        bad("NineEchoes", "sonar", "echoes = 9", "out of range"),
        bad("SonarNoReach", "sonar", "max_range_m = 0", "above 0"),
        bad("SonarMissedRate", "sonar", "missed_rate = 1.5", "out of range"),
        bad("SonarPreset", "sonar", "preset = 'ir_sharp'", "preset"),
        bad("InfraredFalseRateNan", "infrared", "false_rate = nan", "out of range"),
        bad("InfraredLight", "infrared", "least_light = 2", "out of range"),
        bad("InfraredNearBeyondReach", "infrared", "near_m = 200", "above max_range_m"),
        bad("InfraredNoise", "infrared", "noise_per_m2 = -1", "out of range"),
        Refused{"SweepLongerThanAFrame", "kind = 'sonar'\nsweep_s = 0.5\n", 0, "before the next"},
        Refused{"SweepLongerThanItsRate", "kind = 'sonar'\nsweep_s = 0.5\nrate_hz = 3\n", 0,
                "before the next"},
        // Positions and headings.
        bad("GnssNoiseNegative", "gnss", "noise_m = -1", "out of range"),
        bad("GnssCorrelationNan", "gnss", "correlation_s = nan", "out of range"),
        bad("CompassNoiseNan", "compass", "noise_deg = nan", "out of range"),
        bad("CompassBias", "compass", "bias_sigma_deg = 181", "out of range"),
        // Points, planes and faces.
        bad("PointsDropout", "points", "dropout = -0.5", "out of range"),
        bad("PointsDropoutNan", "points", "dropout = nan", "out of range"),
        bad("PlanesClutter", "planes", "clutter = -1", "out of range"),
        bad("FacesClutterHuge", "faces", "clutter = 1e9", "out of range"),
        bad("FacesAllRound", "faces", "horizontal_fov_deg = 180", "180"),
        // Inertial.
        bad("ImuNoiseNegative", "imu", "gyro_noise = -1", "out of range"),
        bad("ImuWalkNan", "imu", "force_walk = nan", "out of range"),
        bad("ImuLimitZero", "imu", "force_limit = 0", "out of range"),
        bad("ImuMisaligned", "imu", "misalignment_deg = 10", "out of range"),
        bad("ImuScale", "imu", "gyro_scale_sigma = 1", "out of range"),
        bad("ImuGravityNan", "imu", "gravity_m_s2 = nan", "out of range"),
        bad("GyroFeelsNoForce", "gyro", "force_noise = 0.1", "unknown key"),
        bad("GyroAxes", "gyro", "axes = 'x'", "axes"),
        // Wheels and mice.
        bad("EncoderNoTicks", "encoders", "ticks_per_revolution = 0", "out of range"),
        bad("EncoderTicksNan", "encoders", "ticks_per_revolution = nan", "out of range"),
        bad("OdometryNoBase", "odometry", "wheel_base_m = 0", "out of range"),
        bad("OdometryRadiusHuge", "odometry", "wheel_radius_m = 1e9", "out of range"),
        bad("OdometrySlipNegative", "odometry", "slip = -1", "out of range"),
        bad("MouseNoCounts", "mouse", "counts_per_m = 0", "out of range"),
        bad("MouseApartNan", "mouse", "apart_m = nan", "out of range"),
        Refused{"BumpWithoutDrive", "kind = 'bump'\n", 0, "needs a [robot.drive]"},
        Refused{"KindUnknown", "kind = 'radar'\n", 9, "none of"}),
    [](const auto& refused) { return std::string(refused.param.name); });

TEST_F(SensorFaults, MoreReadingsInAFrameThanAreTakenAreRefused) {
  folder_.write("small.map", hallway::test::map_text(hallway::test::pillars()));
  for (const auto& [kind, more] : kinds_on_a_path()) {
    std::string text = hallway::test::scenario_text("[sensor.s]\nrate_hz = 10000\n" + of_kind(kind));
    text.replace(text.find("period_s = 0.1"), 14, "period_s = 1.5");
    const std::string file = folder_.write("s.toml", text);
    const auto error =
        hallway::test::error_of([&] { Simulator(load_scenario(file), 1, trace::Backend::kEmbree); });
    ASSERT_TRUE(error) << kind;
    EXPECT_NE(std::string(error->what()).find("15000 readings"), std::string::npos) << error->what();
    EXPECT_EQ(error->where().element, "sensor `s`");
  }
}

TEST_F(SensorFaults, ZeroHertzIsAReadingAFrameOfEveryKind) {
  for (const auto& [kind, more] : kinds_on_a_path()) {
    const auto simulator = make(of_kind(kind) + "rate_hz = 0\n");
    const bool takes_time =
        kind == "lidar" || kind == "imu" || kind == "gyro";  // the first one ends in frame 1
    EXPECT_EQ(simulator->step(0).readings.size(), takes_time ? 0u : 1u) << kind;
    EXPECT_EQ(simulator->step(1).readings.size(), 1u) << kind;
    EXPECT_TRUE(simulator->problems().empty()) << kind;
  }
}

TEST_F(SensorFaults, TenKilohertzOfEveryKindAreGiven) {
  for (const auto& [kind, more] : kinds_on_a_path()) {
    const auto simulator = make(of_kind(kind) + "rate_hz = 10000\n");
    EXPECT_EQ(simulator->step(1).readings.size(), 1000u) << kind;
  }
}

TEST_F(SensorFaults, AReadingThatIsTooLateIsSaidToBe) {
  for (const auto& [kind, more] : kinds_on_a_path()) {
    for (const char* late : {"latency_s = 3600\n", "phase_s = 3600\n"}) {
      const auto simulator = make(of_kind(kind) + late);
      for (std::uint32_t i = 0; i < 40; ++i) EXPECT_TRUE(simulator->step(i).readings.empty());
      ASSERT_EQ(simulator->problems().size(), 1u) << kind;
      EXPECT_NE(std::string(simulator->problems()[0].what()).find("no reading arrives"), std::string::npos);
    }
  }
}

TEST_F(SensorFaults, StampsOfAWildClockNeverDecrease) {
  for (const auto& [kind, more] : kinds_on_a_path()) {
    for (const char* rate : {"rate_hz = 0\n", "rate_hz = 800\n"}) {
      const auto simulator =
          make(of_kind(kind) + rate + "clock_drift_ppm = -1e5\nclock_jitter_s = 1\nclock_offset_s = -3600\n");
      std::int64_t before_ns = INT64_MIN;
      for (std::uint32_t i = 0; i < 20; ++i) {
        for (const Reading& reading : simulator->step(i).readings) {
          EXPECT_LE(before_ns, reading.stamp_ns) << kind;
          EXPECT_LE(reading.stamp_begin_ns, reading.stamp_ns) << kind;
          before_ns = reading.stamp_ns;
        }
      }
    }
  }
}

TEST_F(SensorFaults, AMillionRaysAreMeasured) {
  const auto simulator = make(
      "kind = 'lidar'\nrings = 1024\ncolumns = 1024\nstep_deg = 0.35\nlowest_deg = -80\nhighest_deg = 80\n");
  const Frame frame = simulator->step(1);
  const auto& [scan, truth] = std::get<LidarSensed>(frame.readings.at(0).sensed);
  ASSERT_EQ(scan.range_m.size(), 1u << 20);
  EXPECT_EQ(truth.range_m, scan.range_m) << "without noise";
}

TEST_F(SensorFaults, InAWallNothingFailsAndTheLidarSeesItsInside) {
  // In frame 1 it is in the block ahead, which is 0.2 by 1 by 2 m large.
  const std::string inside = "position_m = [3.47, 1, 0]\n";
  for (const char* kind :
       {"points", "planes", "faces", "sonar", "infrared", "gnss", "compass", "imu", "gyro", "mouse"}) {
    const auto simulator = make(of_kind(kind) + inside);
    EXPECT_EQ(simulator->step(1).readings.size(), 1u) << kind;
  }
  const auto lidar = make(of_kind("lidar") + "skew = false\n" + inside);
  const Vec3 place = lidar->pose_at(1) * Vec3(3.47, 1, 0);
  ASSERT_GT(place.x(), 3.0);
  ASSERT_LT(place.x(), 3.2);
  const Frame frame = lidar->step(1);
  for (const double range_m : std::get<LidarSensed>(frame.readings.at(0).sensed).reading.range_m)
    EXPECT_LT(range_m, 2.5) << "no beam leaves the block";
}

TEST_F(SensorFaults, ASensorInAWallAndASonarThatHearsItsRobotAreReported) {
  const auto problems = [](const Simulator& simulator) {
    std::string texts;
    for (const Error& problem : simulator.problems()) texts += std::string(problem.what()) + "\n";
    return texts;
  };
  const auto inside = make("kind = 'sonar'\nposition_m = [3.85, 1, 0]\n");  // of the block ahead
  EXPECT_NE(problems(*inside).find("within a wall or outside"), std::string::npos) << problems(*inside);
  EXPECT_EQ(problems(*make("kind = 'sonar'\n")), "");
  // A robot of half a metre, with a head behind that looks over it and one that looks away.
  folder_.write("small.map", hallway::test::map_text(hallway::test::pillars()));
  for (const bool away : {false, true}) {
    std::string text =
        hallway::test::scenario_text("[sensor.s]\nkind = 'sonar'\nposition_m = [-0.6, 0, 0]\n" +
                                     std::string(away ? "yaw_deg = 180\n" : ""));
    text.replace(text.find("[robot]\n"), 8, "[robot]\nradius_m = 0.3\nbottom_m = -0.2\ntop_m = 0.2\n");
    const Simulator simulator(load_scenario(folder_.write("s.toml", text)), 1, trace::Backend::kEmbree);
    EXPECT_EQ(problems(simulator).find("own body is in its beam") == std::string::npos, away)
        << problems(simulator);
  }
}

TEST_F(SensorFaults, AnEmptyWorldIsFreeEverywhere) {
  const auto lidar = make(of_kind("lidar"), "");
  const Frame frame = lidar->step(1);
  for (const double range_m : std::get<LidarSensed>(frame.readings.at(0).sensed).reading.range_m)
    EXPECT_EQ(range_m, HUGE_VAL);
  for (const char* kind : {"planes", "faces"}) {
    const auto simulator = make(of_kind(kind), "");
    EXPECT_TRUE(simulator->step(0).readings.at(0).planes().empty()) << kind;
  }
}

TEST_F(SensorFaults, HugeNoiseStaysWithinWhatASensorCanSay) {
  const auto lidar = make(of_kind("lidar") + "noise_m = 1000\nmin_range_m = 0.5\nmax_range_m = 20\n");
  const auto imu =
      make("kind = 'imu'\ngyro_noise = 100\nforce_noise = 1000\ngyro_limit = 5\nforce_limit = 50\n");
  const auto eyes = make("kind = 'points'\nnoise_m = 1000\nclutter = 500\ndropout = 0.5\n");
  int limits = 0;
  for (std::uint32_t i = 1; i < 20; ++i) {
    const Frame scan = lidar->step(i), felt = imu->step(i), seen = eyes->step(i);
    for (const double range_m : std::get<LidarSensed>(scan.readings.at(0).sensed).reading.range_m) {
      const bool is_sound = std::isnan(range_m) || range_m == HUGE_VAL || (range_m >= 0.5 && range_m <= 20.0);
      EXPECT_TRUE(is_sound) << range_m;
    }
    const sense::ImuReading& reading = std::get<ImuSensed>(felt.readings.at(0).sensed).reading;
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_LE(std::abs(reading.angular_rad_s[axis]), 5.0);
      EXPECT_LE(std::abs(reading.force_m_s2[axis]), 50.0);
      limits += std::abs(reading.angular_rad_s[axis]) == 5.0 ? 1 : 0;
    }
    EXPECT_GT(seen.readings.at(0).observations().size(), 300u);
    for (const sense::PointObservation& point : seen.readings.at(0).observations())
      EXPECT_TRUE(point.point.allFinite());
  }
  EXPECT_GT(limits, 20) << "saturated";
}

}  // namespace
}  // namespace hallway::sim
