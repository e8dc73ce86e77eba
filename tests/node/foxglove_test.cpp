// SPDX-License-Identifier: MIT
// The view for Foxglove in a run's log, as the packages that Foxglove reads with see it: against the run's own files.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/small_world.hpp"
#include "log/landmarks.hpp"
#include "log/map_landmarks.hpp"
#include "log/observations.hpp"
#include "log/tum.hpp"
#include "node/packages.hpp"

namespace hallway::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::size_t kFrames = 60;

/// A run with a picture, and what the packages find in its log, made once for all tests.
class Foxglove : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    packages_ = node_folder("protobufjs", why_);
    if (packages_.empty()) return;
    world_ = std::make_unique<SmallWorld>();
    world_->folder().write("small.toml",
                           small_scenario() + "\n[[picture]]\nfile = \"top.png\"\nview = \"top\"\n");
    ASSERT_EQ(world_->run({"--quiet", "--foxglove"}).status, 0);
    const Ended ended = run_node(packages_, "read_foxglove.js", run_folder() / "run.mcap");
    ASSERT_EQ(ended.status, 0) << ended.err;
    topics_ = Json::parse(ended.out);
  }
  static void TearDownTestSuite() { world_.reset(); }
  void SetUp() override {
    if (packages_.empty()) GTEST_SKIP() << why_;
  }

  static fs::path run_folder() { return world_->out(); }
  static const Json& messages(const std::string& topic) { return topics_.at(topic).at("messages"); }

  static fs::path packages_;
  static std::string why_;
  static std::unique_ptr<SmallWorld> world_;
  static Json topics_;
};

fs::path Foxglove::packages_;
std::string Foxglove::why_;
std::unique_ptr<SmallWorld> Foxglove::world_;
Json Foxglove::topics_;

std::array<double, 3> xyz(const Json& json) {
  return {json.at("x").get<double>(), json.at("y").get<double>(), json.at("z").get<double>()};
}

std::array<double, 4> wxyz(const Json& json) {
  return {json.at("w").get<double>(), json.at("x").get<double>(), json.at("y").get<double>(),
          json.at("z").get<double>()};
}

double seconds(const Json& time) {
  const std::int64_t t_ns = std::stoll(time.at("seconds").get<std::string>()) * 1'000'000'000 +
                            time.at("nanos").get<std::int64_t>();
  return static_cast<double>(t_ns) / 1e9;
}

/// The middles of an entity's balls.
std::vector<std::array<double, 3>> ball_centres(const Json& entity) {
  std::vector<std::array<double, 3>> centres;
  for (const Json& sphere : entity.at("spheres")) centres.push_back(xyz(sphere.at("pose").at("position")));
  return centres;
}

/// All points of an entity's lines.
std::vector<std::array<double, 3>> line_points(const Json& entity) {
  std::vector<std::array<double, 3>> points;
  for (const Json& line : entity.at("lines")) {
    for (const Json& point : line.at("points")) points.push_back(xyz(point));
  }
  return points;
}

template <typename Rows>
std::vector<std::array<double, 3>> positions(const Rows& rows) {
  std::vector<std::array<double, 3>> places;
  for (const auto& row : rows) places.push_back(row.position_m);
  return places;
}

TEST_F(Foxglove, ChannelsHaveTheSchemasThatTheyAreFor) {
  std::map<std::string, std::string> found;
  for (const auto& [topic, channel] : topics_.items()) found[topic] = channel.at("schema").get<std::string>();
  const std::map<std::string, std::string> expected{
      {"/foxglove/points", "foxglove.PointCloud"},
      {"/foxglove/pose", "foxglove.PoseInFrame"},
      {"/foxglove/path", "foxglove.SceneUpdate"},
      {"/foxglove/path_poses", "foxglove.PosesInFrame"},
      {"/foxglove/landmark_cloud", "foxglove.PointCloud"},
      {"/foxglove/truth/path_poses", "foxglove.PosesInFrame"},
      {"/foxglove/truth/landmark_cloud", "foxglove.PointCloud"},
      {"/foxglove/landmarks", "foxglove.SceneUpdate"},
      {"/foxglove/submaps", "foxglove.SceneUpdate"},
      {"/foxglove/truth/pose", "foxglove.PoseInFrame"},
      {"/foxglove/truth/path", "foxglove.SceneUpdate"},
      {"/foxglove/truth/landmarks", "foxglove.SceneUpdate"},
      {"/foxglove/tf/map", "foxglove.FrameTransform"},
      {"/foxglove/tf/body", "foxglove.FrameTransform"},
      {"/foxglove/tf/body_truth", "foxglove.FrameTransform"},
      {"/foxglove/tf/sensor_0", "foxglove.FrameTransform"},
      {"/foxglove/pictures/top.png", "foxglove.CompressedImage"}};
  EXPECT_EQ(found, expected);
}

TEST_F(Foxglove, CloudsAreTheObservations) {
  const log::ObservationLog observations = log::read_observations(run_folder() / "observations.csv").log;
  const Json& clouds = messages("/foxglove/points");
  ASSERT_EQ(clouds.size(), kFrames);
  std::size_t points = 0;
  for (std::uint32_t i = 0; i < kFrames; ++i) {
    EXPECT_EQ(clouds[i].at("sequence"), i);
    EXPECT_EQ(clouds[i].at("frame_id"), "sensor_0");
    const auto seen = observations.frame(i);
    ASSERT_EQ(clouds[i].at("points").size(), seen.size()) << i;
    for (std::size_t k = 0; k < seen.size(); ++k, ++points) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(clouds[i].at("points")[k][axis].get<double>(),
                  static_cast<double>(static_cast<float>(seen[k].point[axis])));
      }
    }
  }
  EXPECT_GT(points, kFrames);
}

/// Transforms and poses of a trajectory file, bit by bit.
void expect_trajectory(const fs::path& file, const Json& transforms, const Json& poses,
                       const std::string& frame) {
  const std::vector<log::StampedPose> trajectory = log::read_tum(file);
  ASSERT_GT(trajectory.size(), kFrames / 2);
  ASSERT_EQ(transforms.size(), trajectory.size());
  ASSERT_EQ(poses.size(), trajectory.size());
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    EXPECT_EQ(seconds(transforms[i].at("timestamp")), trajectory[i].t_s);
    EXPECT_EQ(transforms[i].at("parent_frame_id"), frame);
    EXPECT_EQ(xyz(transforms[i].at("translation")), trajectory[i].position_m);
    EXPECT_EQ(wxyz(transforms[i].at("rotation")), trajectory[i].orientation);
    EXPECT_EQ(seconds(poses[i].at("timestamp")), trajectory[i].t_s);
    EXPECT_EQ(poses[i].at("frame_id"), frame);
    EXPECT_EQ(xyz(poses[i].at("pose").at("position")), trajectory[i].position_m);
    EXPECT_EQ(wxyz(poses[i].at("pose").at("orientation")), trajectory[i].orientation);
  }
}

TEST_F(Foxglove, PosesAreTheTrajectories) {
  expect_trajectory(run_folder() / "trajectory.tum", messages("/foxglove/tf/body"),
                    messages("/foxglove/pose"), "map");
  expect_trajectory(run_folder() / "truth.tum", messages("/foxglove/tf/body_truth"),
                    messages("/foxglove/truth/pose"), "world");
}

TEST_F(Foxglove, PathsAreTheTrajectoriesAtTheEnd) {
  const Json& path = messages("/foxglove/path").back().at("entities");
  const Json& truth = messages("/foxglove/truth/path").back().at("entities");
  ASSERT_EQ(path.size(), 1u);
  ASSERT_EQ(truth.size(), 1u);
  EXPECT_EQ(path[0].at("frame_id"), "map");
  EXPECT_EQ(truth[0].at("frame_id"), "world");
  EXPECT_EQ(line_points(path[0]), positions(log::read_tum(run_folder() / "trajectory.tum")));
  EXPECT_EQ(line_points(truth[0]), positions(log::read_tum(run_folder() / "truth.tum")));
}

TEST_F(Foxglove, BallsAreTheLandmarks) {
  const Json& entity = messages("/foxglove/landmarks").back().at("entities").at(0);
  const auto landmarks = log::read_map_landmarks(run_folder() / "landmarks.csv");
  ASSERT_FALSE(landmarks.empty());
  EXPECT_EQ(entity.at("frame_id"), "map");
  EXPECT_EQ(ball_centres(entity), positions(landmarks));
  std::map<log::LandmarkStatus, std::set<std::string>> colours;
  for (std::size_t i = 0; i < landmarks.size(); ++i)
    colours[landmarks[i].status].insert(entity.at("spheres")[i].at("color").dump());
  std::set<std::string> all;
  for (const auto& [status, of_status] : colours) {
    EXPECT_EQ(of_status.size(), 1u) << log::landmark_status_name(status);
    EXPECT_TRUE(all.insert(*of_status.begin()).second) << log::landmark_status_name(status);
  }
  const Json& truth = messages("/foxglove/truth/landmarks").back().at("entities").at(0);
  EXPECT_EQ(truth.at("frame_id"), "world");
  EXPECT_EQ(ball_centres(truth), positions(log::read_landmarks(run_folder() / "truth_landmarks.csv")));
}

TEST_F(Foxglove, ThePictureIsTheFile) {
  const Json& image = messages("/foxglove/pictures/top.png").at(0);
  EXPECT_EQ(image.at("format"), "png");
  const std::string base64 = image.at("data").get<std::string>();
  const std::string png = read_file(run_folder() / "top.png");
  EXPECT_EQ(base64.size(), (png.size() + 2) / 3 * 4);
  EXPECT_TRUE(base64.starts_with("iVBORw0KGgo")) << base64.substr(0, 20);
}

/// The frames that messages speak of, and whose child each is.
TEST_F(Foxglove, FramesAreATree) {
  std::map<std::string, std::set<std::string>> parents;
  std::set<std::string> used;
  for (const auto& [topic, channel] : topics_.items()) {
    for (const Json& message : channel.at("messages")) {
      if (message.contains("child_frame_id")) {
        parents[message.at("child_frame_id").get<std::string>()].insert(
            message.at("parent_frame_id").get<std::string>());
      }
      if (message.contains("frame_id")) used.insert(message.at("frame_id").get<std::string>());
      if (!message.contains("entities")) continue;
      for (const Json& entity : message.at("entities")) used.insert(entity.at("frame_id").get<std::string>());
    }
  }
  used.erase("picture");
  EXPECT_EQ(parents,
            (std::map<std::string, std::set<std::string>>{
                {"map", {"world"}}, {"body", {"map"}}, {"body_truth", {"world"}}, {"sensor_0", {"body"}}}));
  for (const std::string& frame : used) EXPECT_TRUE(frame == "world" || parents.contains(frame)) << frame;
}

/// Where x of frame `child` lies in its parent.
std::array<double, 3> in_parent(const Json& transform, const std::array<double, 3>& x) {
  const auto t = xyz(transform.at("translation"));
  const auto q = wxyz(transform.at("rotation"));
  const std::array<double, 3> u{q[1], q[2], q[3]};
  const auto cross = [](const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return std::array<double, 3>{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                                 a[0] * b[1] - a[1] * b[0]};
  };
  const auto once = cross(u, x);
  const auto twice = cross(u, once);
  std::array<double, 3> y{};
  for (std::size_t i = 0; i < 3; ++i) y[i] = x[i] + 2 * (q[0] * once[i] + twice[i]) + t[i];
  return y;
}

TEST_F(Foxglove, TheMapLiesWhereTheFirstPoseIsTrue) {
  const Json& T_world_map = messages("/foxglove/tf/map");
  ASSERT_EQ(T_world_map.size(), 1u);
  const Json& first = messages("/foxglove/tf/body").front();
  const Json& truth = messages("/foxglove/tf/body_truth").at(first.at("sequence").get<std::size_t>());
  for (const std::array<double, 3>& x : {std::array<double, 3>{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
    const auto estimated = in_parent(T_world_map[0], in_parent(first, x));
    const auto is = in_parent(truth, x);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(estimated[i], is[i], 1e-12);
  }
}

}  // namespace
}  // namespace hallway::test
