// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/se3.hpp"
#include "import/imu_table.hpp"

namespace hallway::import {

// The ASL layout of the EuRoC MAV data:
//   mav0/body.yaml                                           comment
//   mav0/imu0/{sensor.yaml,data.csv}                         mount, rate and noise; samples
//   mav0/state_groundtruth_estimate0/{sensor.yaml,data.csv}  true states; need not be there
// Cameras and other folders are passed over. The world has z up; the body is that of T_BS.

/// What imu0/sensor.yaml has. NaN: the file does not have it.
struct EurocImuSensor {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  std::string comment{};
  Pose T_body_imu{};
  double rate_hz = kUnknown;
  double gyroscope_noise_density = kUnknown;      ///< rad/s/sqrt(Hz)
  double gyroscope_random_walk = kUnknown;        ///< rad/s^2/sqrt(Hz)
  double accelerometer_noise_density = kUnknown;  ///< m/s^2/sqrt(Hz)
  double accelerometer_random_walk = kUnknown;    ///< m/s^3/sqrt(Hz)
};

/// How the body moves, and the biases of the IMU.
struct EurocMotion {
  std::array<double, 3> velocity_m_s{};          ///< world
  std::array<double, 3> gyroscope_bias_rad_s{};  ///< IMU's frame
  std::array<double, 3> accelerometer_bias_m_s2{};
};

/// A true state.
struct EurocState {
  std::int64_t t_ns = 0;
  Pose T_world_body;
  std::optional<EurocMotion> motion;
};

/// A sequence, all of it: 56 bytes for each sample and 160 for each state. Its tables may have 2 GiB, which are about 15 million samples.
struct EurocSequence {
  std::string body_comment{};
  EurocImuSensor sensor;
  std::vector<ImuSample> imu;       ///< at least one; times increase
  std::vector<EurocState> truth{};  ///< times increase; empty where the folder is not there
};

/// Reads a sequence. Throws Error{kBadInput, kIo} naming file and line.
/// @param folder  that which has mav0, or mav0
EurocSequence read_euroc(const std::filesystem::path& folder);

/// Reads imu0/sensor.yaml; T_BS is required. Throws Error{kBadInput} with the line, also for YAML that FlatYaml does not read.
EurocImuSensor parse_euroc_sensor(std::string_view text, const std::string& file);

/// Reads imu0/data.csv. Throws as parse_imu_table().
std::vector<ImuSample> parse_euroc_imu(std::string_view text, const std::string& file);

/// Reads data.csv of the true states, with or without velocity and biases. Throws Error{kBadInput} with the line, also where times do not increase and for a
/// quaternion whose length is not 1 within 0.01.
/// @param T_body_sensor  of what the table has the poses of
std::vector<EurocState> parse_euroc_truth(std::string_view text, const std::string& file,
                                          const Pose& T_body_sensor = {});

/// The content of imu0/sensor.yaml; unknown numbers are left out.
std::string print_euroc_sensor(const EurocImuSensor& sensor);

/// Writes a sequence as it goes on. Numbers are written so that they read back the same.
class EurocWriter {
 public:
  /// Makes FOLDER/mav0 with its YAML files. Throws Error{kIo}, also where it is there already and not empty; Error{kBadInput} for a comment with quotes,
  /// backslashes or control characters, a mount that is no pose, and a negative or infinite number.
  EurocWriter(const std::filesystem::path& folder, const EurocImuSensor& sensor,
              const std::string& body_comment);
  ~EurocWriter();

  /// Throw Error{kBadInput} for a time that is not after the last one, for what is not finite, and for states of which some only have a motion; Error{kIo}.
  void add(const ImuSample& sample);
  void add(const EurocState& state);
  /// What was written is safe. Throws Error{kIo}; Error{kBadInput} without samples.
  void close();

 private:
  struct Files;
  std::unique_ptr<Files> files_;
};

}  // namespace hallway::import
