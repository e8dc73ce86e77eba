// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/random.hpp"
#include "cli/bag_contents.hpp"
#include "import/tum_folder.hpp"
#include "import/victoria_park.hpp"
#include "log/observations.hpp"
#include "log/poses.hpp"
#include "support/data.hpp"
#include "support/process.hpp"
#include "unit/import/cloud_bytes.hpp"
#include "unit/import/tum_scene.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Points that a mapper can follow: a cloud around a sensor that moves a little from frame to frame.
Points scene_points(std::uint32_t frame) {
  const Random random(4, stream_id("test.scene"));
  Points points;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const double x = std::round(160 * random.uniform(0, 3 * i)) / 8,
                 y = std::round(160 * random.uniform(0, 3 * i + 1)) / 8,
                 z = std::round(32 * random.uniform(0, 3 * i + 2)) / 8;
    points.push_back({x - 10 - 0.125 * frame, y - 10, z});
  }
  return points;
}

class LogImport : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_ / name; }

  Ended convert(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"log", "convert"});
    arguments.insert(arguments.end(), {"--out", path("log.mcap"), "--force"});
    return hallway(arguments);
  }
  /// The frames of an MCAP log, by way of the CSV files, whose numbers read back to the same bits.
  log::ObservationLog frames_of(const std::string& mcap) const {
    const Ended ended = hallway({"log", "convert", mcap, "--out", path("csv"), "--force"});
    EXPECT_EQ(ended.status, 0) << ended.err;
    return log::read_observations(fs::path(path("csv")) / "observations.csv").log;
  }
  std::vector<log::IterationPose> poses_of(const std::string& mcap) const {
    frames_of(mcap);
    const fs::path poses = fs::path(path("csv")) / "truth_poses.csv";
    return fs::exists(poses) ? log::read_poses(poses) : std::vector<log::IterationPose>();
  }
  Json frame_channel() const {
    const Json info = Json::parse(hallway({"log", "info", path("log.mcap"), "--json"}).out);
    for (const Json& channel : info.at("channels")) {
      if (channel.at("topic") == "/hallway/frame") return channel;
    }
    return {};
  }
  /// The log has just these points, and so has the log of its replay.
  void expect_frames(const std::vector<Points>& expected) const {
    for (const bool replayed : {false, true}) {
      if (replayed) {
        const Ended ended = hallway({"replay", path("log.mcap"), "--plugin", "slam_point", "--quiet",
                                     "--force", "--out", path("replay")});
        ASSERT_EQ(ended.status, 0) << ended.err;
      }
      const log::ObservationLog log = frames_of(replayed ? path("replay/run.mcap") : path("log.mcap"));
      ASSERT_LE(log.iterations(), expected.size());
      for (std::uint32_t i = 0; i < expected.size(); ++i) {
        Points points;
        for (const log::Observation& seen : log.frame(i)) points.push_back(seen.point);
        EXPECT_TRUE(same_bits(points, expected[i])) << "frame " << i << (replayed ? " replayed" : "");
      }
    }
  }
  static bool same_bits(const Points& a, const Points& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
  }
  void expect_failure(const Ended& ended, int status, const std::string& words) const {
    EXPECT_EQ(ended.status, status) << ended.err;
    EXPECT_NE(ended.err.find(words), std::string::npos) << ended.err;
    EXPECT_FALSE(fs::exists(path("log.mcap"))) << "nothing is left";
  }

  TempFolder folder_;
};

TEST_F(LogImport, CloudsOfEveryForm) {
  const std::vector<std::string (*)(const Points&)> forms{
      ascii_ply,
      ascii_pcd,
      binary_pcd<float>,
      compressed_pcd<double>,
      compressed_pcd<float>,
      [](const Points& p) { return binary_ply<float>(p, true); }};
  make_folder(path("clouds"));
  std::vector<Points> expected;
  for (std::uint32_t i = 0; i < forms.size(); ++i) {
    expected.push_back(scene_points(i));
    Points with_hole = expected.back();
    with_hole.insert(with_hole.begin() + 7, {0.0, std::numeric_limits<double>::quiet_NaN(), 0.0});
    folder_.write(fmt::format("clouds/c{}.{}", i + 8, i == 0 || i == 5 ? "ply" : "pcd"), forms[i](with_hole));
  }
  const Ended ended = convert({path("clouds"), "--period", "0.2", "--json"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(Json::parse(ended.out).at("frames"), 6);
  EXPECT_EQ(Json::parse(ended.out).at("warnings"),
            Json::array({"6 points that are not finite were left out, in 6 of 6 frames"}));
  expect_frames(expected);
  EXPECT_EQ(frame_channel().at("last_ns"), 1'000'000'000);
}

TEST_F(LogImport, ARealCloudKeepsItsBits) {
  HALLWAY_DATA_OR_SKIP(cloud, "clouds/room_scan1.pcd");
  ASSERT_EQ(convert({cloud}).status, 0);
  EXPECT_EQ(frames_of(path("log.mcap")).observations().size(), 112586u);
  ASSERT_EQ(convert({cloud, "--from", "clouds", "--stride", "1000"}).status, 0);
  EXPECT_EQ(frames_of(path("log.mcap")).observations().size(), 113u);
}

TEST_F(LogImport, TumFolder) {
  TumScene::write(path("tum"));
  const auto& c = TumScene::kCamera;
  ASSERT_EQ(convert({path("tum"), "--camera", fmt::format("{},{},{},{}", c.fx_px, c.fy_px, c.cx_px, c.cy_px),
                     "--stride", "4", "--truth-within", "0.06"})
                .status,
            0);
  import::TumOptions options;
  options.camera = c;
  options.stride = 4;
  const auto recording = import::open_tum(path("tum"), options);
  std::vector<Points> expected;
  import::Frame frame;
  for (std::uint32_t i = 0; i < recording->frames(); ++i) {
    recording->read(i, frame);
    expected.push_back(frame.points);
  }
  expect_frames(expected);
  const auto poses = poses_of(path("log.mcap"));
  ASSERT_EQ(poses.size(), TumScene::kFrames);
  EXPECT_TRUE(poses[0].orientation_known);
  EXPECT_NEAR(poses[4].position_m[0], 0.4, 1e-9);
  const Ended far = convert({path("tum"), "--camera", "1,1,1,1"});
  EXPECT_EQ(far.status, 0);
  EXPECT_NE(far.err.find("5 of 5 frames have no true pose"), std::string::npos) << far.err;
}

TEST_F(LogImport, VictoriaPark) {
  HALLWAY_DATA_OR_SKIP(park, "victoria_park");
  ASSERT_EQ(convert({park}).status, 0);
  const auto recording = import::open_victoria_park(park, {});
  const log::ObservationLog log = frames_of(path("log.mcap"));
  ASSERT_EQ(log.observations().size(), 52974u);
  import::Frame frame;
  for (std::uint32_t i = 0; i < recording->frames(); ++i) {
    recording->read(i, frame);
    Points points;
    for (const log::Observation& seen : log.frame(i)) points.push_back(seen.point);
    ASSERT_TRUE(same_bits(points, frame.points)) << i;
  }
  const auto poses = poses_of(path("log.mcap"));
  ASSERT_FALSE(poses.empty());
  EXPECT_FALSE(poses[0].orientation_known);
  const Ended replayed = hallway({"replay", path("log.mcap"), "--plugin", "slam_point", "--steps", "100",
                                  "--quiet", "--out", path("run")});
  ASSERT_EQ(replayed.status, 0) << replayed.err;
  EXPECT_TRUE(read_file(fs::path(path("run")) / "truth.tum").starts_with("21.819 "))
      << "times are the data's own";
  const log::ObservationLog again = frames_of(path("run/run.mcap"));
  EXPECT_EQ(again.iterations(), 100u);
  for (std::uint32_t i = 0; i < again.iterations(); ++i)
    EXPECT_EQ(again.frame(i).size(), log.frame(i).size());
}

/// A table of points that a camera followed, and the same points in our own axes.
std::string stereo_table(std::uint32_t frames, std::vector<Points>& points) {
  std::string text = "frame,t_s,id,x_right_m,y_down_m,z_fwd_m\n";
  for (std::uint32_t f = 0; f < frames; ++f) {
    points.push_back(scene_points(f));
    for (std::size_t i = 0; i < points.back().size(); ++i) {
      const auto& p = points.back()[i];
      text += fmt::format("{},{},{},{},{},{}\n", f, 0.1 * f, 10 * i, -p[1], -p[2], p[0]);
    }
  }
  return text;
}

TEST_F(LogImport, StereoTracksKeepTheirTracks) {
  std::vector<Points> points;
  folder_.write("s_obs3d.csv", stereo_table(8, points));
  ASSERT_EQ(convert({path("s_obs3d.csv")}).status, 0);
  const log::ObservationLog log = frames_of(path("log.mcap"));
  ASSERT_TRUE(log.has_tracks());
  EXPECT_EQ(log.frame(3)[4].track, 40u);
  expect_frames(points);
  // Directly, and by way of the log: the same answers.
  const std::vector<std::string> ways{path("s_obs3d.csv"), path("log.mcap")};
  std::vector<std::string> poses;
  for (const std::string& way : ways) {
    const Ended ended = hallway({"replay", way, "--plugin", "slam_point", "--set", "association=sensor",
                                 "--quiet", "--force", "--out", path("sensor")});
    ASSERT_EQ(ended.status, 0) << ended.err;
    poses.push_back(read_file(fs::path(path("sensor")) / "trajectory.tum"));
  }
  EXPECT_EQ(poses[0], poses[1]);
  EXPECT_FALSE(poses[0].empty());
}

TEST_F(LogImport, IdsAreTracksOnDemandAlone) {
  folder_.write(
      "named.csv",
      "iteration,landmark_id,x,y,z\n0,1,5,0,0\n0,2,5,3,0\n0,3,5,0,2\n1,3,5,0,2\n1,1,5,0,0\n1,2,5,3,0\n");
  const auto replay = [&](const std::string& log, bool as_tracks) {
    std::vector<std::string> arguments{"replay",  path(log), "--plugin", "slam_point",
                                       "--quiet", "--force", "--out",    path("run")};
    if (as_tracks) arguments.push_back("--ids-as-tracks");
    return hallway(arguments);
  };
  ASSERT_EQ(replay("named.csv", false).status, 0);
  EXPECT_FALSE(frames_of(path("run/run.mcap")).has_tracks());
  const Ended told = replay("named.csv", true);
  ASSERT_EQ(told.status, 0) << told.err;
  EXPECT_NE(told.err.find("the plugins were told which landmark each point is"), std::string::npos)
      << told.err;
  EXPECT_EQ(frames_of(path("run/run.mcap")).frame(1)[0].track, 3u);
  folder_.write("nameless.csv", "iteration,x,y,z\n0,5,0,0\n");
  expect_failure(replay("nameless.csv", true), 2, "does not name the landmarks");
}

TEST_F(LogImport, RangeAndBearingBringTheirTruth) {
  folder_.write("r_obs.csv",
                "frame,t_s,id,range_m,yaw_rad,pitch_rad\n0,1,4,2,0,0\n0,1,5,2,1,0\n0,1,6,2,0,1\n");
  folder_.write("r_ground_truth.txt", "2 0 0 5 0 0 4\n");
  folder_.write("r_ground_truth_robot_path.txt", "0 0 0 0 0 0\n");
  ASSERT_EQ(convert({path("r_obs.csv")}).status, 0);
  EXPECT_EQ(poses_of(path("log.mcap")).size(), 1u);
  EXPECT_EQ(frames_of(path("log.mcap")).frame(0)[1].landmark, 5u);
  EXPECT_TRUE(fs::exists(fs::path(path("csv")) / "truth_landmarks.csv"));
  fs::remove(path("log.mcap"));
  expect_failure(convert({path("r_obs.csv"), "--stride", "2"}), 2,
                 "--stride does not belong to a log of kind range-bearing");
}

TEST_F(LogImport, TheKindCanBeSaid) {
  folder_.write("cloud.csv", ascii_ply(scene_points(0)));
  EXPECT_EQ(convert({path("cloud.csv")}).status, 0) << "content tells";
  fs::remove(path("log.mcap"));
  expect_failure(convert({path("cloud.csv"), "--from", "csv"}), 3, "cloud.csv:1: the header has no column");
  expect_failure(convert({path("cloud.csv"), "--from", "tum"}), 3, "cloud.csv: has neither depth.txt");
  expect_failure(convert({path("cloud.csv"), "--from", "mcap"}), 3, "cloud.csv");
  expect_failure(convert({path("cloud.csv"), "--from", "pictures"}), 2, "--from");
}

TEST_F(LogImport, OptionsOfOtherKindsAreRefused) {
  folder_.write("cloud.ply", ascii_ply(scene_points(0)));
  folder_.write("obs.csv", "iteration,x,y,z\n0,1,2,3\n");
  expect_failure(convert({path("cloud.ply"), "--camera", "1,1,1,1"}), 2,
                 "--camera does not belong to a log of kind clouds");
  expect_failure(convert({path("cloud.ply"), "--topic", "/a"}), 2, "--topic");
  expect_failure(convert({path("cloud.ply"), "--truth-poses", path("obs.csv")}), 2, "--truth-poses");
  expect_failure(convert({path("obs.csv"), "--stride", "2"}), 2,
                 "--stride does not belong to a log of kind csv or mcap");
  expect_failure(convert({path("cloud.ply"), "--stride", "0"}), 2, "--stride");
  TumScene::write(path("tum"));
  for (const char* camera : {"1,1,1", "0,1,1,1", "nan,1,1,1", "1,-1,1,1", "a,b,c,d"}) {
    expect_failure(convert({path("tum"), "--camera", camera}), 2, "--camera");
  }
}

TEST_F(LogImport, WhatIsNoRecordingIsAnErrorWithItsName) {
  make_folder(path("folder"));
  expect_failure(convert({path("folder")}), 3, "folder: holds no log");
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  folder_.write("empty", "");
  for (const char* kind : {"clouds", "tum", "victoria-park", "stereo-tracks", "range-bearing", "bag"}) {
    expect_failure(convert({path("empty"), "--from", kind}), 3, "empty");
    expect_failure(convert({path("missing"), "--from", kind}), 3, "missing");
    expect_failure(convert({path("pipe"), "--from", kind}), 3, "pipe");
    expect_failure(convert({path("folder"), "--from", kind}), 3, "folder");
    expect_failure(convert({"/dev/zero", "--from", kind}), 3, "/dev/zero");
  }
  expect_failure(convert({path("pipe")}), 3, "pipe");
  expect_failure(convert({"/dev/zero"}), 3, "/dev/zero");
  TumScene::write(path("tum"));
  const std::string image = folder_ / "tum/depth/100.500000.png";
  write_file_atomically(image, read_file(image).substr(0, 200));
  expect_failure(convert({path("tum"), "--camera", "1,1,1,1"}), 3,
                 "100.500000.png: cannot be read as PNG: the file is cut off");
}

TEST_F(LogImport, WithoutTheBagReaderThereIsAMessage) {
  make_folder(path("bin"));
  fs::copy_file(hallway_program(), path("bin/hallway"));
  const std::string bag = folder_.write("a.bag", "#ROSBAG V2.0\n");
  const Ended ended = Process({path("bin/hallway"), "log", "convert", bag, "--out", path("log.mcap")}).wait();
  expect_failure(ended, 3, "built without ROS 1 and reads no bags; install librosbag-storage-dev");
}

/// Tests that need the packages of ROS 1, to read bags and to make them.
class BagImport : public LogImport {
 protected:
  void SetUp() override {
    const fs::path maker = binary_folder() / "tests" / "make_bag";
    if (!fs::exists(maker))
      GTEST_SKIP() << "built without ROS 1 (librosbag-storage-dev): bags are not tested";
    // ROS's library keeps a list of its packages there.
    ASSERT_EQ(Process({maker, path("a.bag")}, {}, {"HOME=" + path("home"), "ROS_HOME=" + path("home")})
                  .wait()
                  .status,
              0);
  }
  static std::vector<Points> clouds(bool with_hole) {
    std::vector<Points> frames(bag::kMessages);
    for (std::uint32_t m = 0; m < bag::kMessages; ++m) {
      for (std::uint32_t i = 0; i < bag::kPoints; ++i) {
        if (with_hole && m == bag::kNotFiniteMessage && i == bag::kNotFinitePoint) continue;
        const auto [x, y, z] = bag::point(m, i);
        frames[m].push_back({x, y, z});
      }
    }
    return frames;
  }
};

TEST_F(BagImport, CloudsOfEitherFloatAndByteOrder) {
  const Ended ended = convert({path("a.bag"), "--topic", "/cloud"});
  ASSERT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.err.find("1 points that are not finite were left out, in 1 of 6 frames"), std::string::npos)
      << ended.err;
  expect_frames(clouds(true));
  ASSERT_EQ(convert({path("a.bag"), "--topic", "/cloud_big"}).status, 0);
  expect_frames(clouds(false));
  EXPECT_EQ(frame_channel().at("first_ns"), 1'500'000'000'050'000'000);
}

TEST_F(BagImport, ScansArePointsOfTheirPlane) {
  ASSERT_EQ(convert({path("a.bag"), "--topic", "/scan"}).status, 0);
  std::vector<Points> expected(bag::kMessages);
  for (std::uint32_t m = 0; m < bag::kMessages; ++m) {
    for (std::uint32_t i = 0; i < bag::kBeams; ++i) {
      if (!bag::hits(i)) continue;
      const double angle = double{bag::kAngleMin} + i * double{bag::kAngleIncrement};
      const double range = bag::range(m, i);
      expected[m].push_back({range * std::cos(angle), range * std::sin(angle), 0.0});
    }
  }
  expect_frames(expected);
}

TEST_F(BagImport, PosesOfATopicAreTheTruth) {
  for (const char* topic : {"/odom", "/mocap"}) {
    ASSERT_EQ(convert({path("a.bag"), "--topic", "/cloud", "--truth-topic", topic}).status, 0);
    const auto poses = poses_of(path("log.mcap"));
    ASSERT_EQ(poses.size(), bag::kMessages);
    for (std::uint32_t i = 0; i < poses.size(); ++i) {
      const double middle = i + 0.4999999995;  // half a period of 100 000 001 ns, less half a nanosecond
      EXPECT_NEAR(poses[i].position_m[1], middle, 1e-8);
      EXPECT_NEAR(poses[i].orientation[3], std::sin(0.05 * middle), 1e-8);
    }
  }
  const Ended far =
      convert({path("a.bag"), "--topic", "/cloud", "--truth-topic", "/odom", "--truth-within", "0.04"});
  EXPECT_EQ(far.status, 0);
  EXPECT_NE(far.err.find("6 of 6 frames have no true pose"), std::string::npos) << far.err;
}

TEST_F(BagImport, AnUnclearTopicIsAnsweredByTheList) {
  expect_failure(
      convert({path("a.bag")}), 2,
      "several topics of points: --topic is needed; its topics: /backwards (sensor_msgs/LaserScan, 2)");
  expect_failure(convert({path("a.bag"), "--topic", "/clouds"}), 2, "has no topic /clouds; its topics:");
  expect_failure(convert({path("a.bag"), "--topic", "/clicked"}), 2, "is not of sensor_msgs/PointCloud2");
  expect_failure(convert({path("a.bag"), "--topic", "/scan", "--truth-topic", "/cloud"}), 2,
                 "is not of nav_msgs/Odometry");
  expect_failure(convert({path("a.bag"), "--topic", "/backwards"}), 3,
                 "a.bag: message 1 of /backwards: its stamp lies before");
}

TEST_F(BagImport, CutAndDamagedBagsAreErrors) {
  const std::string whole = read_file(path("a.bag"));
  for (const double share : {0.0005, 0.3, 0.7, 0.9999}) {
    folder_.write("cut.bag",
                  whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
    expect_failure(convert({path("cut.bag"), "--topic", "/cloud"}), 3, "cut.bag: ");
  }
  const Random random(6, stream_id("test.bag"));
  for (std::uint32_t i = 0; i < 12; ++i) {
    std::string damaged = whole;
    const auto bits = random.bits(0, i);
    damaged[bits[0] % damaged.size()] = static_cast<char>(bits[1] & 0xFFu);
    folder_.write("damaged.bag", damaged);
    const Ended ended = convert({path("damaged.bag"), "--topic", "/cloud"});
    EXPECT_TRUE(ended.status == 0 || ended.status == 2 || ended.status == 3) << ended.status << ended.err;
  }
}

}  // namespace
}  // namespace hallway::test
