// SPDX-License-Identifier: MIT
//
// Visible sets, blocks and batches change nothing in what is seen, and view volumes pass over nothing that is in view.
#include <gtest/gtest.h>

#include <algorithm>

#include "sense/point_visibility.hpp"
#include "sense/view_volume.hpp"
#include "support/long_mode.hpp"
#include "unit/sense/rooms.hpp"
#include "unit/sense/sensor_fixture.hpp"

namespace hallway::sense {
namespace {

/// Random numbers one after the other.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed, stream_id("test")) {}
  double uniform(double low, double high) { return random_.uniform(0, next_++, low, high); }
  Vec3 point(const Vec3& low, const Vec3& high) {
    const double x = uniform(low.x(), high.x());
    const double y = uniform(low.y(), high.y());
    return {x, y, uniform(low.z(), high.z())};
  }
  Quat rotation() { return from_yaw_pitch_roll(uniform(-3.1, 3.1), uniform(-1.5, 1.5), uniform(-3.1, 3.1)); }

 private:
  Random random_;
  std::uint64_t next_ = 0;
};

/// Cameras and scanners of all kinds.
FieldOfView any_view(Draw& draw) {
  const bool camera = draw.uniform(0.0, 1.0) < 0.5;
  const double horizontal = camera ? draw.uniform(0.05, 3.1) : draw.uniform(0.05, 6.28318);
  const double vertical = camera ? draw.uniform(0.05, 3.1) : draw.uniform(0.05, 6.28318);
  const double min_range = draw.uniform(-2.0, 4.0);
  return {horizontal, vertical, std::max(0.0, min_range), std::max(0.0, min_range) + draw.uniform(0.1, 40.0)};
}

std::vector<VisiblePoint> brute_force(const FieldOfView& view, const std::vector<Vec3>& landmarks,
                                      const trace::Scene& scene, const Pose& T_world_sensor) {
  std::vector<VisiblePoint> visible;
  const Eigen::Matrix3d to_sensor = T_world_sensor.q.conjugate().toRotationMatrix();
  for (std::uint32_t i = 0; i < landmarks.size(); ++i) {
    const Vec3 point = to_sensor * (landmarks[i] - T_world_sensor.t);
    if (view.contains(point) && !scene.occluded(landmarks[i], T_world_sensor.t))
      visible.push_back({i, point});
  }
  return visible;
}

void expect_same(std::vector<VisiblePoint> got, const std::vector<VisiblePoint>& expected) {
  std::sort(got.begin(), got.end(),
            [](const VisiblePoint& a, const VisiblePoint& b) { return a.landmark < b.landmark; });
  ASSERT_EQ(got.size(), expected.size());
  for (std::size_t i = 0; i < got.size(); ++i) {
    ASSERT_EQ(got[i].landmark, expected[i].landmark);
    ASSERT_EQ(got[i].point, expected[i].point);
  }
}

/// Landmarks in the rooms and around them; some exactly on planes of the tree, some in doors.
std::vector<Vec3> landmarks_of(Draw& draw, const test::Rooms& rooms) {
  const double length = test::Rooms::kLength * rooms.count;
  std::vector<Vec3> landmarks;
  for (int i = 0; i < 4000; ++i) {
    Vec3 point = draw.point({-3, -5, -1}, {length + 3, 5, 4});
    if (i % 20 == 0) point.x() = std::round(point.x() / 10.0) * 10.0;
    if (i % 27 == 0) point.y() = 4.0;
    landmarks.push_back(point);
  }
  return landmarks;
}

TEST(VisibleSetsAgreement, WithBruteForceOnAnyNumberOfThreads) {
  Draw draw(61);
  const test::Rooms rooms(9);
  const std::vector<Vec3> landmarks = landmarks_of(draw, rooms);
  const trace::Scene scene(rooms.walls, trace::Backend::kBruteForce);
  const LandmarkIndex plain(landmarks);
  const LandmarkIndex with_sets(landmarks, rooms.tree, rooms.visible);
  std::size_t seen = 0;
  std::vector<VisiblePoint> visible;
  for (int frame = 0; frame < test::sized(120, 3000); ++frame) {
    const FieldOfView view = any_view(draw);
    Pose pose{draw.rotation(), draw.point({-2, -4.5, -0.5}, {92, 4.5, 3.5})};
    if (frame % 5 == 0) pose.t.x() = std::round(pose.t.x() / 10.0) * 10.0;  // on a plane of the tree
    const auto expected = brute_force(view, landmarks, scene, pose);
    seen += expected.size();
    for (const LandmarkIndex* index : {&plain, &with_sets}) {
      for (const unsigned threads : {1u, 2u, 4u}) {
        PointVisibility(view, *index, scene).find(pose, threads, visible);
        expect_same(visible, expected);
        if (HasFatalFailure()) return;
      }
    }
  }
  EXPECT_GT(seen, 1000u);
}

TEST(VisibleSetsAgreement, OfWholeFramesBitByBit) {
  Draw draw(62);
  const test::Rooms rooms(6);
  const std::vector<Vec3> landmarks = landmarks_of(draw, rooms);
  const trace::Scene scene(rooms.walls, trace::Backend::kBruteForce);
  const LandmarkIndex plain(landmarks);
  const LandmarkIndex with_sets(landmarks, rooms.tree, rooms.visible);
  PointSensorSpec spec = test::camera();
  spec.noise_m = Vec3(0.1, 0.2, 0.3);
  const PointSensor one(spec, plain, scene, 1);
  const PointSensor other(spec, with_sets, scene, 1);
  for (std::uint32_t step = 0; step < 20; ++step) {
    const Pose pose{from_yaw_pitch_roll(draw.uniform(-3, 3), 0, 0), draw.point({1, -3, 1}, {59, 3, 2})};
    const auto expected = test::observe(one, pose, step, 1);
    const auto got = test::observe(other, pose, step, 3);
    ASSERT_EQ(got.size(), expected.size());
    for (std::size_t i = 0; i < got.size(); ++i) {
      ASSERT_EQ(got[i].landmark, expected[i].landmark);
      ASSERT_EQ(got[i].point, expected[i].point);
    }
  }
}

TEST(ViewVolume, PassesOverNothingThatIsInView) {
  Draw draw(63);
  int passed_over = 0;
  const int boxes = test::sized(4000, 100000);
  for (int i = 0; i < boxes; ++i) {
    const FieldOfView view = any_view(draw);
    const Pose pose{draw.rotation(), draw.point({-50, -50, -50}, {50, 50, 50})};
    const Vec3 low = pose.t + draw.point({-30, -30, -30}, {30, 30, 30});
    const Vec3 size = draw.point({0, 0, 0}, {6, 6, 6});
    const bool may = ViewVolume(view, pose).may_contain(Box(low, Vec3(low + size)));
    passed_over += may ? 0 : 1;
    if (may) continue;
    const Eigen::Matrix3d to_sensor = pose.q.conjugate().toRotationMatrix();
    for (int k = 0; k < 60; ++k) {
      Vec3 at = draw.point({0, 0, 0}, {1, 1, 1});
      if (k % 3 == 0) at = at.array().round();  // corners
      if (k % 3 == 1) at.x() = std::round(at.x());
      ASSERT_FALSE(view.contains(to_sensor * (low + size.cwiseProduct(at) - pose.t))) << i;
    }
  }
  EXPECT_GT(passed_over, boxes / 4);
}

TEST(ViewVolume, PassesOverWhatIsBehindAndTooFar) {
  const FieldOfView camera(1.5, 1.0, 2.0, 20.0);
  const ViewVolume volume(camera, Pose());
  const auto around = [](double x, double y, double z) {
    return Box(Vec3(x - 1, y - 1, z - 1), Vec3(x + 1, y + 1, z + 1));
  };
  EXPECT_TRUE(volume.may_contain(around(10, 0, 0)));
  EXPECT_FALSE(volume.may_contain(around(-10, 0, 0))) << "behind";
  EXPECT_FALSE(volume.may_contain(around(10, 15, 0))) << "to the left";
  EXPECT_FALSE(volume.may_contain(around(10, 0, 9))) << "above";
  EXPECT_FALSE(volume.may_contain(around(25, 0, 0))) << "too far";
  EXPECT_FALSE(volume.may_contain(around(0, 0, 0))) << "too near";
  const ViewVolume scanner(FieldOfView(6.28318, 0.4, 0.0, 20.0), Pose());
  EXPECT_TRUE(scanner.may_contain(around(-10, 0, 0)));
  EXPECT_FALSE(scanner.may_contain(around(5, 0, 6))) << "above the band";
}

}  // namespace
}  // namespace hallway::sense
