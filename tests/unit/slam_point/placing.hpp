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

inline constexpr bool kByPlace = true;  ///< FramePlacer::search asks constellations, too
inline constexpr bool kByTurnsAlone = false;

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

/// A map of one submap that knows `landmarks` exactly, and a sensor in it that was placed at the map's origin.
class Sensor {
 public:
  explicit Sensor(std::vector<Vec3> landmarks, bool planar = false, const Options& options = {})
      : options_(options), landmarks_(std::move(landmarks)), planar_(planar) {
    for (const Vec3& p : landmarks_) graph.add_landmark(p, 1);
    submaps.open_new(Pose{});
    placer.begin(planar, false);
    placer.restart(Pose{});
    placer.enter_submap(Pose{});
    see(landmarks_, Pose{});
    for (Index l = 0; l < frame.size(); ++l) frame[l].landmark = l;
    integrate();
  }

  /// A frame that shows `points` (map frame) from T_map_sensor.
  void see(const std::vector<Vec3>& points, const Pose& T_map_sensor) {
    frame.clear();
    for (const Vec3& p : points) frame.push_back({T_map_sensor.inverse() * p, frame.size()});
  }
  /// Sees, matches and fits. Whether the prediction led there.
  bool track(const std::vector<Vec3>& points, const Pose& T_map_sensor) {
    see(points, T_map_sensor);
    placer.begin(planar_, false);
    placer.match(frame);
    return placer.fit(frame);
  }
  /// The same, and whether the frame has a pose then.
  bool place(const std::vector<Vec3>& points, const Pose& T_map_sensor) {
    track(points, T_map_sensor);
    return placer.is_placed(frame);
  }
  /// A frame that is placed and averaged in.
  void follow(const Pose& T_map_sensor) {
    ASSERT_TRUE(place(landmarks_, T_map_sensor));
    placer.accept(frame);
    integrate();
  }
  /// A frame of `points` that has no pose. Returns what it determines all the same.
  int lose(const std::vector<Vec3>& points = {}, const Pose& T_map_sensor = {}) {
    EXPECT_FALSE(place(points, T_map_sensor));
    return placer.lose(frame);
  }
  void integrate() { placer.note_seen(submaps.integrate(frame, placer.T_submap_sensor(), planar_)); }
  std::size_t matched() const {
    return static_cast<std::size_t>(
        std::count_if(frame.begin(), frame.end(), [](const Observation& o) { return o.landmark != kNone; }));
  }
  void expect_at(const Pose& T_map_sensor) const {
    EXPECT_LT((placer.T_map_sensor().t - T_map_sensor.t).norm(), 1e-9);
    EXPECT_LT(placer.T_map_sensor().q.angularDistance(T_map_sensor.q), 1e-9);
  }
  const std::vector<Vec3>& landmarks() const { return landmarks_; }

 private:
  Options options_;
  std::vector<Vec3> landmarks_;
  bool planar_;

 public:
  FrameMatcher matcher{options_};
  SubmapGraph graph{options_.map_bound()};
  SubmapSequence submaps{options_, graph, matcher};
  PlaceRecogniser places{options_, matcher};
  FramePlacer placer{options_, graph, submaps, matcher, places};
  std::vector<Observation> frame{};
};

}  // namespace hallway::slam_point::placing
