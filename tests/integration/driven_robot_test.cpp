// SPDX-License-Identifier: MIT
// A robot drives at random through whole worlds, with noise and slip: a drive that obeys commands, a body that meets what stands there. At every step its
// body is apart from every triangle: said by separating axes, which share no code with the distances that the library goes by.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "base/random.hpp"
#include "bsp/point_location.hpp"
#include "contact/robot.hpp"
#include "csg/surface.hpp"
#include "drive/drive.hpp"
#include "map/reader.hpp"
#include "sim/models.hpp"
#include "support/data.hpp"
#include "support/long_mode.hpp"
#include "support/overlap_oracle.hpp"
#include "world/compiled_world.hpp"

namespace hallway {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kFrameNs = 100'000'000;
constexpr std::int64_t kLongestStandNs = 10'000'000'000;
constexpr double kRadius = 0.2;

/// An upright prism of eight sides.
std::vector<Vec3> body_points() {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) {
    const double angle = i * std::numbers::pi / 4.0;
    for (const double z : {0.03, 0.5})
      points.emplace_back(kRadius * std::cos(angle), kRadius * std::sin(angle), z);
  }
  return points;
}

contact::RobotSpec robot_spec() {
  contact::RobotSpec spec{.shape = contact::BodyShape::polytope(body_points()),
                          .wheels = {{Vec2(0.0, 0.15), Vec2(0.0, -0.15), Vec2(0.15, 0.0), Vec2(-0.15, 0.0)}}};
  spec.ground.step_m = 0.025;
  spec.ground.ledge_m = 0.025;
  spec.ground.clearance_m = 0.03;
  spec.move.gyration = 0.15;
  return spec;
}

drive::DriveSpec drive_spec() {
  constexpr std::int64_t kSecond = 1'000'000'000;
  drive::DriveSpec spec;
  spec.latency_ns = 30'000'000;
  spec.forward_noise = {0.0, 0.05, kSecond};
  spec.angular_noise = {0.0, 0.1, kSecond};
  spec.lateral_drift = {0.0, 0.02, kSecond};
  spec.left_slip = {0.02, 0.02, kSecond / 2};
  spec.right_slip = {0.02, 0.02, kSecond / 2};
  return spec;
}

/// A world as triangles, and where in it robots may begin.
struct Place {
  contact::Obstacles obstacles;
  Box starts;                                      ///< of random places
  std::function<bool(const Vec3&)> is_solid = {};  ///< empty where only triangles are known
};

std::vector<contact::Triangle> triangles_of(const trace::TriangleMesh& mesh) {
  std::vector<contact::Triangle> triangles;
  for (const auto& corners : mesh.triangles)
    triangles.push_back({mesh.vertices[corners[0]], mesh.vertices[corners[1]], mesh.vertices[corners[2]]});
  return triangles;
}

Place place_of_map(const fs::path& file) {
  const map::Document document = map::load(file);
  auto world = std::make_shared<world::CompiledWorld>(world::compile(document, {.level = {}}));
  std::vector<contact::Triangle> triangles;
  const csg::Surface& surface = world->partition.surface;
  for (const csg::SurfacePolygon& polygon : surface.polygons) {
    for (const auto& t : csg::triangulate(surface, polygon))
      triangles.push_back({surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]});
  }
  for (const trace::TriangleMesh& mesh : sim::triangles_of(sim::load_models(document, file.parent_path()))) {
    for (const contact::Triangle& triangle : triangles_of(mesh)) triangles.push_back(triangle);
  }
  const Box bounds = world->partition.tree.bounds;
  return {contact::Obstacles(std::move(triangles)), bounds,
          [world](const Vec3& point) { return bsp::cluster_at(world->partition.tree, point) < 0; }};
}

/// A model alone, whose floor is its lowest level.
Place place_of_model(const fs::path& folder, const std::string& model, double start_height_m) {
  map::Document document;
  document.entities.resize(2);
  document.entities[0].keys = {{"classname", "worldspawn"}, {"_scale", "1"}};
  document.entities[1].keys = {{"classname", "hw_mesh"}, {"origin", "0 0 0"}, {"model", model}};
  std::vector<contact::Triangle> triangles;
  Box bounds;
  for (const trace::TriangleMesh& mesh : sim::triangles_of(sim::load_models(document, folder))) {
    for (const contact::Triangle& triangle : triangles_of(mesh)) {
      triangles.push_back(triangle);
      for (const Vec3& corner : triangle) bounds.extend(corner);
    }
  }
  bounds.min().z() += start_height_m;
  bounds.max().z() = bounds.min().z() + 1e-3;
  return {contact::Obstacles(std::move(triangles)), bounds};
}

/// Drives ahead in gentle curves; off what it touches, and turns.
class Wanderer {
 public:
  explicit Wanderer(std::uint64_t seed) : random_(seed, stream_id("test.wanderer")) {}

  /// @param away  where it is free, in the body's frame: the sum of the normals of what is touched; zero if nothing is
  drive::Command next(const Vec3& away) {
    ++since_;
    if (!away.isZero() && leave_ == 0 && turn_ == 0) {
      leave_ = 5;
      turn_ = 4 + static_cast<int>(in(0.0, 20.0));
      const bool helped = since_ > 40;  // frames since it last left something, if only in vain
      ahead_ = helped ? (away.x() >= 0.0 ? 0.3 : -0.3) : -ahead_;
      since_ = 0;
      sign_ = in(0.0, 1.0) < 0.5 ? -1.0 : 1.0;
    }
    if (leave_ > 0) {
      --leave_;
      return {ahead_, 0.0, 0.0};
    }
    if (turn_ > 0) {
      --turn_;
      return {0.0, 0.0, 1.2 * sign_};
    }
    if (++frames_ % 30 == 0) bend_ = in(-0.4, 0.4);
    return {0.5, 0.0, bend_};
  }

 private:
  double in(double low, double high) { return random_.uniform(0, next_++, low, high); }

  Random random_;
  std::uint64_t next_ = 0;
  int leave_ = 0, turn_ = 0, frames_ = 0, since_ = 100;
  double ahead_ = 0.0, sign_ = 1.0, bend_ = 0.0;
};

struct Outcome {
  bool began = false;
  std::size_t checked = 0;  ///< pairs of a pose and a triangle
  double least_gap_m = INFINITY;
  std::string worst{};
  std::int64_t longest_stand_ns = 0;
  contact::Counts counts{};
  std::size_t cells = 0;  ///< of 0.5 m, in which the robot was
};

bool put_somewhere(contact::Robot& robot, const Place& place, std::uint64_t seed) {
  const Random random(seed, stream_id("test.start"));
  for (std::uint32_t attempt = 0; attempt < 20'000; ++attempt) {
    Vec3 at;
    for (int axis = 0; axis < 3; ++axis)
      at[axis] = random.uniform(attempt, static_cast<std::uint64_t>(axis), place.starts.min()[axis],
                                place.starts.max()[axis]);
    if (place.is_solid && place.is_solid(at)) continue;
    if (robot.put(at, random.uniform(attempt, 3, -3.1, 3.1), 0, place.is_solid) == contact::Start::kStands)
      return true;
  }
  return false;
}

/// Looks at the body from outside. Which triangles are near is found anew when the robot has gone on by a metre.
class Inspector {
 public:
  Inspector(const Place& place, Outcome& outcome) : place_(place), outcome_(outcome), oracle_(body_points()) {
    for (std::uint32_t i = 0; i < place.obstacles.size(); ++i) {
      boxes_.emplace_back();
      for (const Vec3& corner : place.obstacles.triangle(i)) boxes_.back().extend(corner);
    }
  }

  void look(const Pose& pose, std::int64_t t_ns) {
    if (!known_.contains(pose.t) || near_.empty()) find_near(pose.t);
    Box box;
    for (const Vec3& point : body_points()) box.extend(pose * point);
    for (const std::uint32_t i : near_) {
      if (!boxes_[i].intersects(box)) continue;
      const double gap = oracle_.gap(pose, place_.obstacles.triangle(i));
      ++outcome_.checked;
      if (gap >= outcome_.least_gap_m) continue;
      outcome_.least_gap_m = gap;
      outcome_.worst =
          "triangle " + std::to_string(i) + " at " + std::to_string(static_cast<double>(t_ns) * 1e-9) + " s";
    }
  }

 private:
  void find_near(const Vec3& place) {
    known_ = Box(place - Vec3::Ones(), place + Vec3::Ones());
    const Box wide(place - Vec3::Constant(2.0), place + Vec3::Constant(2.0));
    near_.clear();
    for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
      if (boxes_[i].intersects(wide)) near_.push_back(i);
    }
  }

  const Place& place_;
  Outcome& outcome_;
  contact::test::HullOracle oracle_;
  std::vector<Box> boxes_;
  std::vector<std::uint32_t> near_;
  Box known_;
};

Outcome wander(const Place& place, std::uint64_t seed, double seconds) {
  Outcome outcome;
  contact::Robot robot(place.obstacles, robot_spec());
  if (!put_somewhere(robot, place, seed)) return outcome;
  outcome.began = true;
  drive::Drive drive(drive_spec(), seed);
  Wanderer wanderer(seed);
  Inspector inspector(place, outcome);
  std::set<std::pair<int, int>> cells;
  std::int64_t stand_begin_ns = 0;
  Pose stand = robot.pose();
  Vec3 away = Vec3::Zero();
  const auto frames = static_cast<std::int64_t>(seconds * 10.0);
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    const std::int64_t now = frame * kFrameNs;
    drive.command(now, wanderer.next(away));
    std::vector<TwistRamp> ramps;
    for (const drive::Motion& motion : drive.advance(now + kFrameNs)) ramps.push_back(motion.body);
    const contact::Advance advance = robot.advance(ramps);
    away.setZero();
    for (const auto& touches : {advance.begun, advance.touching}) {
      for (const contact::Touch& touch : touches) away += robot.pose().q.conjugate() * touch.normal;
    }
    if (!advance.touching.empty()) drive.set_twist(robot.twist());
    for (const std::int64_t t : {now + kFrameNs / 3, now + kFrameNs})
      inspector.look(robot.history().pose_at(t), t);
    robot.forget_before(now);
    const Pose& pose = robot.pose();
    if ((pose.t - stand.t).norm() > 0.01 || pose.q.angularDistance(stand.q) > 0.02) {
      stand = pose;
      stand_begin_ns = now + kFrameNs;
    }
    outcome.longest_stand_ns = std::max(outcome.longest_stand_ns, now + kFrameNs - stand_begin_ns);
    cells.emplace(static_cast<int>(std::floor(pose.t.x() * 2.0)),
                  static_cast<int>(std::floor(pose.t.y() * 2.0)));
  }
  outcome.counts = robot.counts();
  outcome.cells = cells.size();
  return outcome;
}

void expect_free(const Place& place, std::uint64_t seeds, double seconds) {
  std::vector<Outcome> outcomes(seeds);
  parallel_for(seeds, 1, hardware_threads(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) outcomes[i] = wander(place, 1 + i, seconds);
  });
  std::size_t checked = 0;
  for (std::size_t i = 0; i < seeds; ++i) {
    const Outcome& o = outcomes[i];
    SCOPED_TRACE("seed " + std::to_string(1 + i));
    if (test::long_mode()) {
      std::printf("seed %zu: %.0f m, %llu contacts, longest stand %.1f s, %zu cells, %zu pairs looked at\n",
                  1 + i, o.counts.distance_m, static_cast<unsigned long long>(o.counts.contacts),
                  static_cast<double>(o.longest_stand_ns) * 1e-9, o.cells, o.checked);
    }
    ASSERT_TRUE(o.began);
    checked += o.checked;
    EXPECT_GT(o.least_gap_m, 0.0) << o.worst;
    EXPECT_LE(o.longest_stand_ns, kLongestStandNs);
    EXPECT_EQ(o.counts.falls, 0u);
  }
  EXPECT_GT(checked, 0u);
}

TEST(DrivenRobot, NeverMeetsTheOffice) {
  const Place place = place_of_map(test::source_folder() / "maps/office.map");
  expect_free(place, test::sized(2u, 20u), test::sized(60.0, 3600.0));
}

TEST(DrivenRobot, NeverMeetsAModel) {
  HALLWAY_DATA_OR_SKIP(folder, "models/buildings/willowgarage");
  const Place place = place_of_model(folder, "meshes/willowgarage_visual.dae", 0.5);
  expect_free(place, test::sized(2u, 20u), test::sized(60.0, 3600.0));
}

TEST(DrivenRobot, NeverMeetsAMapOfQuake) {
  HALLWAY_DATA_OR_SKIP(file, "maps/id1/e1m1.map");
  const Place place = place_of_map(file);
  expect_free(place, test::sized(2u, 20u), test::sized(60.0, 3600.0));
}

}  // namespace
}  // namespace hallway
