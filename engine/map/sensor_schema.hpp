// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string_view>

#include "map/entity_schema.hpp"
#include "map/key_specs.hpp"

namespace hallway::map {

/// A kind of sensor.
struct SensorKind {
  std::string_view name{};
  std::string_view about{};       ///< what it measures
  std::string_view leaves_out{};  ///< what real ones have and it does not model
};

inline constexpr std::array kSensorKinds{
    SensorKind{"points", "landmarks that nothing hides, as points",
               "wrong identities of what it follows, rolling shutter"},
    SensorKind{"planes", "walls that nothing hides, as planes with corners, of a level robot",
               "slopes and floors"},
    SensorKind{"faces", "faces that nothing hides, as planes with corners, from any pose",
               "models, edges that are not straight"},
    SensorKind{"bump", "what touches zones of the robot's body", "springs, force, wear"},
    SensorKind{"encoders", "how far the wheels turn, in ticks", "missed ticks, backlash, worn tyres"},
    SensorKind{
        "lidar", "ranges of a 2-D or 3-D laser scanner, each at its own time",
        "light, weather, mirrors, beams that glass splits, crosstalk, quantisation of ranges, what moves"},
    SensorKind{"sonar", "how far the nearest thing in a beam of sound is, of each ping of a sweep",
               "the sound's time of flight, several reflections, temperature, loudness by distance and size, "
               "side lobes"},
    SensorKind{
        "infrared", "how far a thing straight ahead is that throws back enough infrared light",
        "the beam's width, light of the sun, detectors that see each other's light, the robot's own body"},
    SensorKind{"imu", "angular velocity and specific force, as means of its intervals",
               "temperature, vibration, flicker noise apart from the walk, the Earth's rotation, bandwidth "
               "beyond the mean"},
    SensorKind{"gyro", "angular velocity, as means of its intervals",
               "temperature, vibration, flicker noise apart from the walk, the Earth's rotation, bandwidth "
               "beyond the mean"},
    SensorKind{
        "gnss", "where its antenna is, by satellites",
        "satellites and their places, walls and roofs other than by zones, the time to the first fix, speed"},
    SensorKind{"compass", "which way it points, from magnetic north",
               "tilt, iron that the robot carries, currents of motors"},
    SensorKind{"odometry", "pose and twist, summed up from ticks of the wheels",
               "slopes, steps, wheels off the floor, slip with a mean"},
    SensorKind{"mouse", "way over the floor, summed up from the counts of optical mice",
               "floors that a mouse does not see well, lifting off the floor"},
};

namespace sensor_keys {

using namespace key_specs;

inline constexpr double kFarthest_m = 1e6;
inline constexpr double kLargestNoise_m = 1e3;
inline constexpr double kMount_m = 1e3;
inline constexpr double kTurn_deg = 360.0;
inline constexpr double kDelay_s = 3600.0;

inline constexpr std::string_view kSeeing = "points planes faces";
inline constexpr std::string_view kRanging = "points planes faces lidar sonar infrared";
inline constexpr std::string_view kBeams = "lidar sonar infrared";
inline constexpr std::string_view kMounted =
    "points planes faces lidar sonar infrared imu gyro mouse gnss compass";
inline constexpr std::string_view kTurned = "points faces lidar sonar infrared imu gyro compass";
inline constexpr std::string_view kInertial = "imu gyro";
inline constexpr std::string_view kWheels = "encoders odometry";
inline constexpr std::string_view kOdometers = "odometry mouse";
inline constexpr std::string_view kPlanar = "planes faces";

}  // namespace sensor_keys

/// The keys of an `hw_sensor`, which are those of a scenario's [sensor.NAME] too: by kind, with ranges and defaults.
inline constexpr std::array kSensorKeys = [] {
  using namespace sensor_keys;
  return std::array{
      required("name", KeyKind::kName),
      choice("kind",
             "points planes faces bump encoders lidar sonar infrared imu gyro gnss compass odometry mouse",
             "points"),
      of_variant("lidar", choice("preset", "none lidar16 lidar64 lidar2d_270", "none"),
                 "a class of hardware, whose values count where the sensor says nothing"),
      of_variant("imu", choice("preset", "none imu_mems imu_tactical", "none"),
                 "a class of hardware, whose values count where the sensor says nothing"),
      of_variant("sonar", choice("preset", "none sonar_polaroid", "none"),
                 "a class of hardware, whose values count where the sensor says nothing"),
      of_variant("infrared", choice("preset", "none ir_sharp", "none"),
                 "a class of hardware, whose values count where the sensor says nothing"),
      of_variant("gnss", choice("preset", "none gnss_meter", "none"),
                 "a class of hardware, whose values count where the sensor says nothing"),
      of_variant("compass", choice("preset", "none compass", "none"),
                 "a class of hardware, whose values count where the sensor says nothing"),
      of_variant(kSeeing, number_above("horizontal_fov_deg", 0.0, kTurn_deg, "90"), "full angle"),
      of_variant(kSeeing, number_above("vertical_fov_deg", 0.0, kTurn_deg, "60"), "full angle"),
      of_variant(kRanging, number("min_range_m", 0.0, kFarthest_m, "0"), "nearest distance"),
      of_variant("points planes faces lidar", number("max_range_m", 0.0, kFarthest_m, "100"),
                 "farthest distance"),
      of_variant("sonar", number("max_range_m", 0.0, kFarthest_m, "10"), "farthest distance"),
      of_variant("infrared", number("max_range_m", 0.0, kFarthest_m, "0.8"), "farthest distance"),
      of_variant(kSeeing, numbers("noise_m", KeyKind::kNumbers, 0.0, kLargestNoise_m, "0"),
                 "standard deviation; of points along x, y, z, of planes of the distance"),
      of_variant(kBeams, number("noise_m", 0.0, kLargestNoise_m, "0"), "standard deviation of a range"),
      of_variant("points", numbers("noise_per_m", KeyKind::kNumbers, 0.0, 1.0, "0"),
                 "standard deviation of a second part of the noise, per metre of distance"),
      of_variant("infrared", number("noise_per_m2", 0.0, 100.0, "0"),
                 "standard deviation of a second part of the noise, per square metre of distance squared"),
      of_variant("lidar sonar infrared", number("noise_per_m", 0.0, 1.0, "0"),
                 "standard deviation of a second part of the noise, per metre of distance"),
      of_variant("lidar", number("noise_incidence_deg", 0.0, 10.0, "0"),
                 "a third part on slanted surfaces: this angle times distance times tangent of the slant"),
      of_variant(kMounted, numbers("position_m", KeyKind::kVector, -kMount_m, kMount_m, "0 0 0"),
                 "mount on the robot: forward, left, up"),
      of_variant(kMounted, number("yaw_deg", -kTurn_deg, kTurn_deg, "0"),
                 "turn of the mount about z, to the left"),
      number("rate_hz", 0.0, 1e4, "0"),
      number("phase_s", 0.0, kDelay_s, "0"),
      number("latency_s", 0.0, kDelay_s, "0"),
      about(number("clock_offset_s", -kDelay_s, kDelay_s, "0"),
            "what the sensor's clock is ahead of the robot's at time 0"),
      about(number("clock_drift_ppm", -1e5, 1e5, "0"), "how much faster it runs, parts per million"),
      about(number("clock_jitter_s", 0.0, 1.0, "0"), "standard deviation of each stamp"),
      of_variant(kMounted, numbers("mount_error_m", KeyKind::kVector, -1.0, 1.0, "0 0 0"),
                 "where the sensor is in truth, in the frame of the mount that plugins get"),
      of_variant(kMounted, numbers("mount_error_deg", KeyKind::kVector, -45.0, 45.0, "0 0 0"),
                 "how it is turned in truth: yaw, pitch, roll"),
      of_variant(kTurned, number("pitch_deg", -kTurn_deg, kTurn_deg, "0"), "then about its y, down"),
      of_variant(kTurned, number("roll_deg", -kTurn_deg, kTurn_deg, "0"), "then about its x"),
      of_variant("planes", flag("bounded_sides", "0"),
                 "whether ranges are distances from the sensor, not depths"),
      of_variant(kPlanar, flag("occlusion", "1"), "whether what is nearer hides what is farther"),
      of_variant(kPlanar, number("min_length_m", 0.0, kFarthest_m, "0.05"), "shorter parts are not seen"),
      of_variant(kPlanar, number("noise_angle_deg", 0.0, 90.0, "0"), "standard deviation of the direction"),
      of_variant(kSeeing, number("dropout", 0.0, 1.0, "0"),
                 "share of what is in view that is not in a reading, at random"),
      of_variant(kSeeing, number("clutter", 0.0, 500.0, "0"),
                 "mean number of false points or planes in a reading"),
      of_variant(kPlanar, number("noise_end_m", 0.0, kLargestNoise_m, "0"),
                 "standard deviation of the ends, along the plane"),
      of_variant("bump", whole("zones", 1.0, 64.0, ""),
                 "equal sectors; none: those of the robot file, else four"),
      of_variant("bump", flag("depth", "0"), "whether it measures how deep its skin is pressed"),
      of_variant("bump", number("skin_m", 1e-4, 1.0, "0.005"), "what is nearer presses it"),
      of_variant("bump", number("missed_rate", 0.0, 1.0, "0"), "share of presses that are missed"),
      of_variant("bump", number("false_rate", 0.0, 1.0, "0"),
                 "share of readings without a press that have one"),
      of_variant("encoders", number("ticks_per_revolution", 1.0, 1e9, "1024"),
                 "ticks of a turn of the wheel"),
      of_variant("encoders", number("radius_error_sigma", 0.0, 0.1, "0"),
                 "standard deviation, as a share of the radius"),
      of_variant(kWheels, number("wheel_base_m", 0.001, 100.0, "0.3"),
                 "of a robot that a path moves; else the drive's"),
      of_variant(kWheels, number("wheel_radius_m", 0.001, 100.0, "0.05"),
                 "of a robot that a path moves; else the drive's"),
      of_variant("odometry", number("ticks_per_revolution", 1.0, 1e9, "1024"),
                 "ticks of a turn of the wheel"),
      of_variant("odometry", number("radius_error_sigma", 0.0, 0.1, "0"),
                 "standard deviation in truth, as a share of the radius; declared too"),
      of_variant("odometry", number("slip", 0.0, 10.0, "0"),
                 "declared: way of a wheel that the body does not follow, m per root of a metre"),
      of_variant("odometry", number("side_slip", 0.0, 10.0, "0"),
                 "declared: sideways motion, m per root of a metre"),
      of_variant(kOdometers, number("off_plane_m", 0.0, 10.0, "0"),
                 "declared: motion along z, m per root of a metre"),
      of_variant(kOdometers, number("off_plane_deg", 0.0, 90.0, "0"),
                 "declared: tilt, degrees per root of a metre"),
      of_variant("mouse", number("counts_per_m", 1.0, 1e9, "31496.06299"), "800 an inch"),
      of_variant("mouse", number("scale_sigma", 0.0, 0.1, "0"),
                 "of the share by which a mouse's scale is off"),
      of_variant("mouse", number("noise_per_root_m", 0.0, 10.0, "0"),
                 "of each axis of a mouse, m per root of a metre of its way"),
      of_variant("mouse", number("apart_m", 0.0, 10.0, "0"),
                 "two mice, so far apart along y; 0: one, which feels no rotation"),
      of_variant(kInertial, number("gyro_noise", 0.0, 100.0, "0"),
                 "density of the white noise, rad/s/sqrt(Hz)"),
      of_variant(kInertial, number("gyro_walk", 0.0, 100.0, "0"), "of the bias, rad/s^2/sqrt(Hz)"),
      of_variant(kInertial, number("gyro_bias_sigma", 0.0, 100.0, "0"), "of the bias at the start, rad/s"),
      of_variant(kInertial, number("gyro_scale_sigma", 0.0, 0.1, "0"),
                 "of the scale factor's error, a share"),
      of_variant(kInertial, number_above("gyro_limit", 0.0, 1e6, "1e6"), "greatest reading, rad/s"),
      of_variant(kInertial, number("misalignment_deg", 0.0, 5.0, "0"), "of each axis against the others"),
      of_variant("gyro", choice("axes", "xyz z", "z"), "which there are"),
      of_variant("imu", number("force_noise", 0.0, 1e3, "0"), "density of the white noise, m/s^2/sqrt(Hz)"),
      of_variant("imu", number("force_walk", 0.0, 1e3, "0"), "of the bias, m/s^3/sqrt(Hz)"),
      of_variant("imu", number("force_bias_sigma", 0.0, 1e3, "0"), "of the bias at the start, m/s^2"),
      of_variant("imu", number("force_scale_sigma", 0.0, 0.1, "0"), "of the scale factor's error, a share"),
      of_variant("imu", number_above("force_limit", 0.0, 1e9, "1e9"), "greatest reading, m/s^2"),
      of_variant("imu", number("gravity_m_s2", 0.0, 100.0, "9.80665"), "down is -z of the world"),
      of_variant("sonar", numbers("beam_m", KeyKind::kList, -kFarthest_m, kFarthest_m, ""),
                 "corners of the beam in its plane, x y x y ...; none: a cone"),
      of_variant("sonar", number_above("cone_deg", 0.0, 180.0, "30"), "full angle of a beam that is a cone"),
      of_variant("sonar", number("height_deg", 0.0, 179.0, "0"),
                 "full angle through which a beam with corners reaches up and down"),
      of_variant("sonar", number_above("resolution_deg", 0.0, 11.0, "1"), "between the rays of a beam"),
      of_variant("sonar", whole("pings", 1.0, 4096.0, "1"), "of a sweep"),
      of_variant("sonar", number("first_deg", -kTurn_deg, kTurn_deg, "0"), "azimuth of the first ping"),
      of_variant("sonar", number("ping_step_deg", -kTurn_deg, kTurn_deg, "0"),
                 "from ping to ping; below 0: to the right"),
      of_variant("sonar", number("sweep_s", 0.0, kDelay_s, "0"),
                 "from the first ping of a sweep to where the next one could begin; 0: all at once"),
      of_variant("sonar", number("head_radius_m", 0.0, kMount_m, "0"),
                 "how far in front of the axis a head stands"),
      of_variant("sonar", whole("echoes", 1.0, 8.0, "1"), "of a ping, at most"),
      of_variant("sonar", number("echo_apart_m", 0.0, 100.0, "0.1"),
                 "echoes nearer to each other than this are one"),
      of_variant("sonar", flag("crosstalk", "0"), "whether heads that ping at one moment hear each other"),
      of_variant("sonar", flag("own_body", "1"), "whether the robot's own body is met by the beams"),
      of_variant("sonar infrared", number("missed_rate", 0.0, 1.0, "0"),
                 "share of readings that see nothing where something is"),
      of_variant("sonar infrared", number("false_rate", 0.0, 1.0, "0"),
                 "share of readings of something where nothing is, uniform in range"),
      of_variant("infrared", number("least_light", 0.0, 1.0, "0.1"),
                 "of a surface's `infrared` times the cosine of its slant: what gives less is not seen"),
      of_variant("infrared", number("near_m", 0.0, kFarthest_m, "0"),
                 "0: ranges; above: it only says whether something is nearer than this"),
      of_variant("gnss", number("noise_m", 0.0, kLargestNoise_m, "0"),
                 "standard deviation of what is new in each fix, along east and along north"),
      of_variant("gnss", number("correlated_m", 0.0, kLargestNoise_m, "0"), "of what stays for a while"),
      of_variant("gnss", number("noise_up_m", 0.0, kLargestNoise_m, "0"), "likewise of the height"),
      of_variant("gnss", number("correlated_up_m", 0.0, kLargestNoise_m, "0"), "likewise of the height"),
      of_variant("gnss", number("correlation_s", 0.0, 1e6, "60"),
                 "after which what stays has faded to a share of 1 / e"),
      of_variant("compass", number("noise_deg", 0.0, 180.0, "0"), "standard deviation"),
      of_variant("compass", number("bias_sigma_deg", 0.0, 180.0, "0"),
                 "standard deviation of an error that is the same in all readings"),
      of_variant("lidar", KeySpec{.name = "pattern", .kind = KeyKind::kText},
                 "a table of beams, in place of rings and columns"),
      of_variant("lidar", whole("rings", 1.0, 4096.0, "16"), "rows of beams"),
      of_variant("lidar", number("lowest_deg", -90.0, 90.0, "-15"), "elevation of the first ring"),
      of_variant("lidar", number("highest_deg", -90.0, 90.0, "15"), "elevation of the last ring"),
      of_variant("lidar", whole("columns", 1.0, 1048576.0, "1800"),
                 "beams of a ring; rings times columns up to 1048576"),
      of_variant("lidar", number("from_deg", -kTurn_deg, kTurn_deg, "-180"), "azimuth of the first column"),
      of_variant("lidar", number_above("step_deg", 0.0, 180.0, "0.2"), "from column to column"),
      of_variant("lidar", flag("clockwise", "0"), "whether it turns to the right"),
      of_variant("lidar", flag("skew", "1"),
                 "whether each beam is measured at its own time; else all at the end of the scan"),
      of_variant("lidar", number("dropout", 0.0, 1.0, "0"), "share of beams without an answer"),
      of_variant("lidar", number("dropout_at_max", 0.0, 1.0, "0"),
                 "a further share, at max_range_m; it grows with the square of the distance"),
      of_variant("lidar", number("dropout_incidence", 0.0, 1.0, "0"),
                 "a further share along a surface; it grows with (1 - cosine of the slant) squared"),
      of_variant("lidar", number("intensity_noise", 0.0, 1.0, "0"),
                 "standard deviation, as a share of the intensity"),
      of_variant("lidar", number("beam_deg", 0.0, 5.7, "0"), "full divergence of a beam; 0: a line"),
      of_variant("lidar", number("pulse_m", 0.0, 100.0, "0.5"),
                 "surfaces in one beam nearer to each other than this give one mixed return"),
      of_variant("lidar", whole("returns", 1.0, 2.0, "1"), "of a beam: 1, or the first and a second"),
      of_variant("lidar", flag("own_body", "1"), "whether the robot's own body is met by the beams"),
      of_variant("lidar", flag("true_ranges", "0"), "whether the log has the true range of each beam"),
      of_variant("lidar", flag("labels", "0"), "whether the truth has what each return is of"),
  };
}();

}  // namespace hallway::map
