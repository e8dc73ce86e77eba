// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "scenes.hpp"
#include "slam_point/core/fit/alignment.hpp"
#include "slam_point/core/frame/frame_placer.hpp"

/// A sensor in a small map, for the tests of what places its frames.
namespace hallway::slam_point::placing {

/// Points about a place, none nearer than two metres to another.
inline std::vector<Vec3> room(std::size_t count, std::uint64_t seed, bool planar,
                              const Vec3& centre = Vec3::Zero()) {
  scenes::Random random(seed);
  std::vector<Vec3> points;
  while (points.size() < count) {
    const Vec3 p =
        centre + Vec3(random.uniform(-15, 15), random.uniform(-15, 15), planar ? 0.0 : random.uniform(-5, 5));
    if (std::all_of(points.begin(), points.end(), [&](const Vec3& q) { return (p - q).norm() > 2.0; }))
      points.push_back(p);
  }
  return points;
}

/// Points where nothing is mapped.
inline std::vector<Vec3> nowhere(std::size_t count, bool planar) {
  return room(count, 99, planar, Vec3(500, 0, 0));
}

inline std::vector<Vec3> operator+(std::vector<Vec3> a, const std::vector<Vec3>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

inline std::vector<Vec3> first_of(const std::vector<Vec3>& points, std::size_t count) {
  return {points.begin(), points.begin() + static_cast<std::ptrdiff_t>(count)};
}

inline Pose ahead(double x, double yaw = 0.0) {
  return scenes::heading(Vec3(x, 0, 0), yaw);
}

/// Parts of a map of which two are being made one.
struct JoiningParts {
  JoiningParts() {
    for (int part = 0; part < 2; ++part) {
      parts.begin();
      parts.anchor(graph.add_submap(Pose{}));
    }
    parts.join(0, 1, Pose{});
  }
  SubmapGraph graph{1.0};
  MapParts parts{graph, 0.3};
};

/// A map of one submap that knows `landmarks` exactly, and a sensor in it that was placed at the map's origin.
class Sensor {
 public:
  explicit Sensor(std::vector<Vec3> landmarks, bool planar = false, const Options& options = {})
      : options_(options), landmarks_(std::move(landmarks)) {
    graph.planar = frame.planar = planar;
    for (const Vec3& p : landmarks_) graph.add_landmark(p, 1);
    submaps.open_new(Pose{});
    see(landmarks_, Pose{});
    for (Index l = 0; l < frame.observations.size(); ++l) frame.observations[l].landmark = l;
    integrate();
  }

  /// A frame that shows `points` (map frame) from T_map_sensor.
  void see(const std::vector<Vec3>& points, const Pose& T_map_sensor) {
    Observations& seen = frame.observations;
    seen.clear();
    for (const Vec3& p : points) seen.push_back({T_map_sensor.inverse() * p, seen.size()});
  }
  /// Places the frame where the prediction leads: a frame with the sensor's tracks is not searched. Whether it has a pose.
  bool place() {
    frame.followed = true;
    placement = placer.place(frame);
    return placement.has_pose;
  }
  bool place(const std::vector<Vec3>& points, const Pose& T_map_sensor) {
    see(points, T_map_sensor);
    return place();
  }
  /// The same. Whether the prediction led there.
  bool track(const std::vector<Vec3>& points, const Pose& T_map_sensor) {
    place(points, T_map_sensor);
    return placement.is_sure;
  }
  /// Places a frame, which is searched by its constellations and by rotations. Whether it has a pose.
  bool search(const std::vector<Vec3>& points, const Pose& T_map_sensor) {
    return search_by(placer, points, T_map_sensor);
  }
  /// The same by rotations alone: while parts are joined, constellations are not asked.
  bool search_turn(const std::vector<Vec3>& points, const Pose& T_map_sensor) {
    return search_by(turn_placer_, points, T_map_sensor);
  }
  /// The placed frame is where the next one is predicted from.
  void accept() {
    tracking.learn(placement);
    tracking.enter(placement.T_submap_sensor, tracking.last_seen());
  }
  /// A frame that is placed and averaged in.
  void follow(const Pose& T_map_sensor) {
    ASSERT_TRUE(place(landmarks_, T_map_sensor));
    accept();
    integrate();
  }
  /// A frame of `points` that has no pose. Returns what it determines all the same.
  int lose(const std::vector<Vec3>& points = {}, const Pose& T_map_sensor = {}) {
    EXPECT_FALSE(place(points, T_map_sensor));
    tracking.learn(placement);
    return placement.determined;
  }
  void integrate() {
    const std::size_t seen = submaps.integrate(frame.observations, placement.T_submap_sensor);
    tracking.enter(placement.T_submap_sensor, seen);
  }
  std::size_t matched() const {
    return static_cast<std::size_t>(std::count_if(frame.observations.begin(), frame.observations.end(),
                                                  [](const Observation& o) { return o.landmark != kNone; }));
  }
  void expect_at(const Pose& T_map_sensor) const {
    EXPECT_LT((placement.T_map_sensor.t - T_map_sensor.t).norm(), 1e-9);
    EXPECT_LT(placement.T_map_sensor.q.angularDistance(T_map_sensor.q), 1e-9);
  }
  const std::vector<Vec3>& landmarks() const { return landmarks_; }

 private:
  bool search_by(FramePlacer& by, const std::vector<Vec3>& points, const Pose& T_map_sensor) {
    see(points, T_map_sensor);
    frame.followed = false;
    placement = by.place(frame);
    return placement.has_pose;
  }

  Options options_;
  std::vector<Vec3> landmarks_;
  StageClock clock_{};
  JoiningParts joining_{};

 public:
  SubmapGraph graph{options_.map_bound()};
  FrameMatcher matcher{options_, graph};
  SubmapSequence submaps{options_, graph, matcher};
  MapParts parts{graph, options_.agreement()};
  PlaceRecogniser places{options_, graph};
  Tracking tracking{options_};
  FramePlacer placer{options_, submaps, parts, tracking, matcher, places, clock_};
  Frame frame{};
  Placement placement{};

 private:
  FramePlacer turn_placer_{options_, submaps, joining_.parts, tracking, matcher, places, clock_};
};

}  // namespace hallway::slam_point::placing
