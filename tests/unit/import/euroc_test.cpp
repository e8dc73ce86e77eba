// SPDX-License-Identifier: MIT
#include "import/euroc.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "base/file.hpp"
#include "support/temp_folder.hpp"
#include "unit/import/rig_scene.hpp"

namespace hallway::import {
namespace {

namespace fs = std::filesystem;
using test::expect_error;
using test::RigScene;

constexpr const char* kImuHeader =
    "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],a_RS_S_x [m s^-2],a_RS_S_y "
    "[m s^-2],a_RS_S_z [m "
    "s^-2]\r\n";
constexpr const char* kPoseHeader =
    "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z []";
constexpr const char* kMotionHeader =
    ", v_RS_R_x [m s^-1], v_RS_R_y [m s^-1], v_RS_R_z [m s^-1], b_w_RS_S_x [rad s^-1], b_w_RS_S_y [rad "
    "s^-1], b_w_RS_S_z [rad s^-1], "
    "b_a_RS_S_x [m s^-2], b_a_RS_S_y [m s^-2], b_a_RS_S_z [m s^-2]";
/// As the original files are.
constexpr const char* kSensor =
    "#Default imu sensor yaml file\nsensor_type: imu\ncomment: VI-Sensor IMU (ADIS16448)\n\n# Sensor "
    "extrinsics wrt. the body-frame.\n"
    "T_BS:\n  cols: 4\n  rows: 4\n  data: [0.0, -1.0, 0.0, 0.5,\n         1.0, 0.0, 0.0, 0.0,\n         0.0, "
    "0.0, 1.0, 0.25,\n"
    "         0.0, 0.0, 0.0, 1.0]\nrate_hz: 200\n\n"
    "gyroscope_noise_density: 1.6968e-04     # [ rad / s / sqrt(Hz) ]   ( gyro \"white noise\" )\n"
    "gyroscope_random_walk: 1.9393e-05       # [ rad / s^2 / sqrt(Hz) ] ( gyro bias diffusion )\n"
    "accelerometer_noise_density: 2.0000e-3  # [ m / s^2 / sqrt(Hz) ]   ( accel \"white noise\" )\n"
    "accelerometer_random_walk: 3.0000e-3    # [ m / s^3 / sqrt(Hz) ].  ( accel bias diffusion )\n";

EurocImuSensor scene_sensor() {
  return {"made up: #1", RigScene::mount(0.4), 200.0, 1.6968e-4, 1.9393e-5, 2e-3, 3e-3};
}

class Euroc : public testing::Test {
 protected:
  void write_scene(bool motion = true) const {
    EurocWriter writer(folder(), scene_sensor(), "a body");
    for (const ImuSample& sample : RigScene::imu()) writer.add(sample);
    for (const EurocState& state : RigScene::states(motion)) writer.add(state);
    writer.close();
  }
  fs::path folder() const { return folder_ / "euroc"; }
  fs::path mav0() const { return folder() / "mav0"; }
  test::TempFolder folder_;
};

TEST_F(Euroc, WhatIsWrittenReadsBack) {
  for (const bool motion : {true, false}) {
    fs::remove_all(folder());
    write_scene(motion);
    for (const fs::path& path : {folder(), mav0()}) {
      const EurocSequence read = read_euroc(path);
      EXPECT_EQ(read.body_comment, "a body");
      EXPECT_EQ(read.sensor.comment, "made up: #1");
      test::expect_near(read.sensor.T_body_imu, RigScene::mount(0.4));
      EXPECT_EQ(read.sensor.rate_hz, 200.0);
      EXPECT_EQ(read.sensor.gyroscope_noise_density, 1.6968e-4);
      EXPECT_EQ(read.sensor.gyroscope_random_walk, 1.9393e-5);
      EXPECT_EQ(read.sensor.accelerometer_noise_density, 2e-3);
      EXPECT_EQ(read.sensor.accelerometer_random_walk, 3e-3);
      const auto imu = RigScene::imu();
      ASSERT_EQ(read.imu.size(), imu.size());
      for (std::size_t i = 0; i < imu.size(); ++i) {
        EXPECT_EQ(read.imu[i].t_ns, imu[i].t_ns);
        EXPECT_EQ(read.imu[i].angular_rad_s, imu[i].angular_rad_s);
        EXPECT_EQ(read.imu[i].force_m_s2, imu[i].force_m_s2);
      }
      const auto states = RigScene::states(motion);
      ASSERT_EQ(read.truth.size(), states.size());
      for (std::size_t i = 0; i < states.size(); ++i) {
        EXPECT_EQ(read.truth[i].t_ns, states[i].t_ns);
        test::expect_near(read.truth[i].T_world_body, states[i].T_world_body);
        ASSERT_EQ(read.truth[i].motion.has_value(), motion);
        if (!motion) continue;
        EXPECT_EQ(read.truth[i].motion->velocity_m_s, states[i].motion->velocity_m_s);
        EXPECT_EQ(read.truth[i].motion->gyroscope_bias_rad_s, states[i].motion->gyroscope_bias_rad_s);
        EXPECT_EQ(read.truth[i].motion->accelerometer_bias_m_s2, states[i].motion->accelerometer_bias_m_s2);
      }
    }
  }
}

TEST_F(Euroc, TheOriginalFilesAreRead) {
  const EurocImuSensor sensor = parse_euroc_sensor(kSensor, "sensor.yaml");
  EXPECT_EQ(sensor.comment, "VI-Sensor IMU (ADIS16448)");
  EXPECT_EQ(sensor.T_body_imu.t, Vec3(0.5, 0, 0.25));
  EXPECT_LT((sensor.T_body_imu * Vec3(1, 0, 0) - Vec3(0.5, 1, 0.25)).norm(), 1e-12);
  EXPECT_EQ(sensor.gyroscope_random_walk, 1.9393e-5);
  const auto imu = parse_euroc_imu(std::string(kImuHeader) +
                                       "1403636579758555392,-0.099134701513277898,0.14730578886832138,0."
                                       "02722713633111154,8.1476917083333333,"
                                       "-0.37592158333333331,-2.4026292499999999\r\n",
                                   "data.csv");
  EXPECT_EQ(imu.at(0).t_ns, 1403636579758555392);
  EXPECT_EQ(imu.at(0).angular_rad_s[1], 0.14730578886832138);
  EXPECT_EQ(imu.at(0).force_m_s2[2], -2.4026292499999999);
  const auto truth = parse_euroc_truth(std::string(kPoseHeader) + kMotionHeader +
                                           "\r\n1403636580838555648,4.688319,-1.786938,0.783338,0.534108,-0."
                                           "153029,-0.827383,-0.082152,-0.027876,0.033207,0.800006,"
                                           "-0.003172,0.021267,0.078502,-0.025266,0.136696,0.075593\r\n",
                                       "data.csv");
  EXPECT_EQ(truth.at(0).T_world_body.t, Vec3(4.688319, -1.786938, 0.783338));
  EXPECT_NEAR(truth.at(0).T_world_body.q.w(), 0.534108, 1e-6);
  EXPECT_NEAR(truth.at(0).T_world_body.q.norm(), 1.0, 1e-15);
  EXPECT_EQ(truth.at(0).motion->accelerometer_bias_m_s2[1], 0.136696);
}

TEST_F(Euroc, NoiseThatIsNotKnownIsLeftOut) {
  const EurocImuSensor read = parse_euroc_sensor(print_euroc_sensor({}), "sensor.yaml");
  EXPECT_TRUE(std::isnan(read.rate_hz));
  EXPECT_TRUE(std::isnan(read.accelerometer_random_walk));
  EXPECT_EQ(read.T_body_imu.t, Vec3::Zero());
}

TEST_F(Euroc, TruthOfAnotherFrameBecomesTheBodys) {
  const Pose T_body_sensor = RigScene::mount(-0.8);
  const auto sensor_poses = parse_euroc_truth(std::string(kPoseHeader) + "\n7,1,2,3,1,0,0,0\n", "data.csv");
  const auto body_poses =
      parse_euroc_truth(std::string(kPoseHeader) + "\n7,1,2,3,1,0,0,0\n", "data.csv", T_body_sensor);
  test::expect_near(body_poses.at(0).T_world_body * T_body_sensor, sensor_poses.at(0).T_world_body);
}

TEST_F(Euroc, ASequenceNeedNoTruthAndNoBodyFile) {
  write_scene();
  fs::remove_all(mav0() / "state_groundtruth_estimate0");
  fs::remove(mav0() / "body.yaml");
  EXPECT_TRUE(read_euroc(folder()).truth.empty());
  EXPECT_EQ(read_euroc(folder()).body_comment, "");
}

TEST_F(Euroc, BadFilesAreNamedWithTheLine) {
  write_scene();
  const fs::path imu = mav0() / "imu0" / "data.csv", yaml = mav0() / "imu0" / "sensor.yaml",
                 body = mav0() / "body.yaml";
  const fs::path truth = mav0() / "state_groundtruth_estimate0" / "data.csv";
  const auto refused = [&](const fs::path& file, const std::string& content, const std::string& words,
                           ErrorCode code = ErrorCode::kBadInput) {
    const std::string before = read_file(file);
    write_file_atomically(file, content);
    expect_error([&] { read_euroc(folder()); }, code, words);
    write_file_atomically(file, before);
    EXPECT_NO_THROW(read_euroc(folder()));
  };
  const std::string header = kImuHeader, row = "5,1,2,3,4,5,6\n";
  refused(imu, "", "imu0/data.csv: the file is empty");
  refused(imu, header, "imu0/data.csv: has no samples");
  refused(imu, "5,1,2,3,4,5,6\n", "imu0/data.csv:1: the header has no column \"#timestamp\"");
  refused(imu, header + row + row,
          "imu0/data.csv:3: column #timestamp [ns]: a time after 5 is needed, \"5\" found");
  refused(imu, header + row + "4,1,2,3,4,5,6\n", "imu0/data.csv:3: column #timestamp [ns]: a time after 5");
  refused(imu, header + "-1,1,2,3,4,5,6\n", "imu0/data.csv:2: column #timestamp [ns]: a whole number");
  refused(imu, header + "1e3,1,2,3,4,5,6\n", "imu0/data.csv:2: column #timestamp [ns]: a whole number");
  refused(imu, header + "9223372036854775808,1,2,3,4,5,6\n",
          "imu0/data.csv:2: column #timestamp [ns]: a whole number");
  refused(imu, header + "5,1,2,nan,4,5,6\n",
          "imu0/data.csv:2: column w_RS_S_z [rad s^-1]: a finite number is needed, \"nan\" found");
  refused(imu, header + "5,1,2,3,4,five,6\n", "imu0/data.csv:2: column a_RS_S_y [m s^-2]: a finite number");
  refused(imu, header + "5,1,2,3,4,1e10,6\n",
          "imu0/data.csv:2: column a_RS_S_y [m s^-2]: a number within 1e+09");
  refused(imu, header + "5,1,2,3,4,5\n", "imu0/data.csv:2: 6 fields where the header has 7");
  refused(imu, header + "5,1,2,3,4,5,6", "imu0/data.csv:2: the last line has no line end");
  const std::string poses = std::string(kPoseHeader) + "\n";
  refused(truth, poses, "estimate0/data.csv: has no states");
  refused(truth, poses + "5,1,2,3,1,0,0,0\n5,1,2,3,1,0,0,0\n",
          "estimate0/data.csv:3: column #timestamp: a time after 5");
  refused(truth, poses + "5,1,2,3,1,1,0,0\n",
          "estimate0/data.csv:2: the quaternion does not have unit length");
  refused(truth, poses + "5,1,2,inf,1,0,0,0\n", "estimate0/data.csv:2: column p_RS_R_z [m]: a finite number");
  refused(truth, poses + "5,1,2,1e10,1,0,0,0\n",
          "estimate0/data.csv:2: column p_RS_R_z [m]: a number within 1e+09");
  refused(truth, std::string(kPoseHeader) + ", v_RS_R_x [m s^-1]\n",
          "estimate0/data.csv:1: the header has some columns of velocity");
  const std::string sensor = kSensor;
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = sensor;
    return changed.replace(changed.find(from), from.size(), to);
  };
  refused(yaml, with("imu\n", "camera\n"), "sensor.yaml:2: key sensor_type: imu is needed, \"camera\" found");
  refused(yaml, with("T_BS:", "T_SB:"), "sensor.yaml: has no key T_BS.cols");
  refused(yaml, with("rows: 4", "rows: 3"), "sensor.yaml:8: key T_BS.rows: a number from 4 to 4");
  refused(yaml, with("0.25,", ""), "sensor.yaml:9: key T_BS.data: 15 numbers where 16 are needed");
  refused(yaml, with("-1.0", "1.0"),
          "sensor.yaml:9: key T_BS.data: the first three columns are a mirror image");
  refused(yaml, with("-1.0", "-0.9"),
          "sensor.yaml:9: key T_BS.data: the first three columns are no rotation");
  refused(yaml, with("0.0, 1.0]", "0.0, 2.0]"),
          "sensor.yaml:9: key T_BS.data: the last row is not 0, 0, 0, 1");
  refused(yaml, with("1.6968e-04 ", "-1 "),
          "sensor.yaml:15: key gyroscope_noise_density: a number from 0 to 1e+09");
  refused(yaml, sensor.substr(0, 200), "sensor.yaml:10: the file ends within a list");
  refused(body, "- a\n", "body.yaml:1: \"key: value\" is needed");
  for (const fs::path& file : {imu, yaml, truth}) {
    const std::string before = read_file(file);
    fs::remove(file);
    expect_error([&] { read_euroc(folder()); }, ErrorCode::kIo, file.filename().string() + ": cannot open");
    make_folder(file);
    expect_error([&] { read_euroc(folder()); }, ErrorCode::kIo,
                 file.filename().string() + ": is a folder, not a file");
    fs::remove(file);
    write_file_atomically(file, before);
  }
  make_folder(folder_ / "empty");
  expect_error([&] { read_euroc(folder_ / "empty"); }, ErrorCode::kIo, "empty/imu0/sensor.yaml: cannot open");
}

TEST_F(Euroc, MarksAndBlanksAreNoMatter) {
  const std::string text = "\xEF\xBB\xBF" + std::string(kImuHeader) + " 5 ,1, 2,3,4,5,6 \t\r\n\r\n";
  EXPECT_EQ(parse_euroc_imu(text, "data.csv").at(0).force_m_s2[2], 6.0);
}

TEST_F(Euroc, TheWriterRefusesWhatIsNoSequence) {
  write_scene();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto cannot_make = [&](const fs::path& path, EurocImuSensor sensor, ErrorCode code,
                               const std::string& words) {
    expect_error([&] { EurocWriter(path, sensor, ""); }, code, words);
  };
  cannot_make(folder(), {}, ErrorCode::kIo, "mav0: the folder is not empty");
  cannot_make(folder_ / "b", {.comment = "a\nb"}, ErrorCode::kBadInput,
              "sensor.yaml: the comment has quotes");
  cannot_make(folder_ / "b", {.T_body_imu = {Quat(2, 0, 0, 0), Vec3::Zero()}}, ErrorCode::kBadInput,
              "the mount is not finite");
  cannot_make(folder_ / "b", {.rate_hz = -1}, ErrorCode::kBadInput, "sensor.yaml: -1 is no rate or noise");
  EXPECT_FALSE(fs::exists(folder_ / "b"));
  EurocWriter writer(folder_ / "b", {}, "");
  expect_error([&] { writer.close(); }, ErrorCode::kBadInput, "imu0/data.csv: there are no samples to write");
  const auto refuses = [&](const auto& what, const std::string& words) {
    expect_error([&] { writer.add(what); }, ErrorCode::kBadInput, words);
  };
  writer.add(ImuSample{5, {}, {}});
  refuses(ImuSample{5, {}, {}}, "imu0/data.csv: the time 5 ns is not after 5 ns");
  refuses(ImuSample{6, {nan, 0, 0}, {}}, "the sample at 6 ns has a number that is not finite");
  writer.add(EurocState{0, {}, {}});
  refuses(EurocState{0, {}, {}}, "estimate0/data.csv: the time 0 ns is not after 0 ns");
  refuses(EurocState{1, {}, EurocMotion{}}, "a table has the motion of all states, or of none");
  refuses(EurocState{1, {Quat::Identity(), Vec3(nan, 0, 0)}, {}}, "the state at 1 ns is not finite");
  writer.close();
  EXPECT_EQ(read_euroc(folder_ / "b").truth.size(), 1u);
}

}  // namespace
}  // namespace hallway::import
