// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "slam_plane/plane_adapter.hpp"
#include "slam_plane/spatial/types.hpp"

namespace hallway::slam_plane {

/// Between the ABI and the mapper of planes in space: planes go in as they are, in the sensor's frame, with the hull as their outline where it is given; answers are
/// moved to the body, so that the map's frame is the body's at the frame that the map began with.
class SpatialAdapter : public PlaneAdapter<spatial::PlaneObservation, spatial::View> {
 public:
  /// Throws sdk::Failure as take_sensor() does.
  void activate(const hw_activation_t& activation) {
    const hw_sensor_info_t& sensor = take_sensor(activation);
    view().vertical_fov_rad = or_else(sensor.vertical_fov, 2.0 * std::numbers::pi);
    view().min_range_m = or_else(sensor.min_range_m, 0.0);
  }

  const std::vector<spatial::PlaneObservation>& gather(const hw_frame_t& frame) {
    return PlaneAdapter::gather(frame, [](const hw_planes_t& planes, const hw_plane_t& plane) {
      spatial::PlaneObservation observation{Vec3(plane.normal).normalized(), Vec3(plane.centroid), {}};
      visit_bounds(planes, plane, [&](const Vec3& point) { observation.outline.push_back(point); });
      return observation;
    });
  }

  void put_answer(const sdk::Host& host, const spatial::Answer& answer) const {
    if (answer.has_pose) {
      const spatial::Mat6 covariance = body_covariance(answer);
      host.put_pose(body_pose(answer.T_map_robot), covariance.data());
    } else {
      host.put_lost();
    }
    put_associations(host, answer.associations);
    const spatial::Counters& counters = answer.counters;
    const Vec3 open = T_body_sensor_.q * answer.unobservable;
    const hw_counter_t list[] = {
        {"lost", number(counters.lost)},
        {"faces", number(counters.landmarks)},
        {"submaps", number(counters.submaps)},
        {"closes", number(counters.closes)},
        {"reopened", number(counters.reopened)},
        {"degenerate", number(counters.degenerate)},
        {"global_steps", number(counters.global_steps)},
        {"merged", number(counters.merged)},
        {"edges", number(counters.edges)},
        {"edges_revoked", number(counters.edges_revoked)},
        {"dynamic", number(counters.dynamic)},
        {"found_again", number(counters.found_again)},
        {"undetermined", static_cast<double>(answer.open)},
        {"undetermined_x", open.x()},
        {"undetermined_y", open.y()},
        {"undetermined_z", open.z()},
    };
    host.put_counters(list);
  }

  void put_map(const sdk::Host& host, const spatial::Map& map) const {
    put_landmarks(host, map.landmarks);
    put_submaps(host, map.submaps, [this](const Pose& T) { return body_pose(T); });
  }

 private:
  hw_pose_t body_pose(const Pose& T_map_sensor) const {
    const Pose T = T_body_sensor_ * T_map_sensor * T_body_sensor_.inverse();
    return {{T.t.x(), T.t.y(), T.t.z()}, {T.q.w(), T.q.x(), T.q.y(), T.q.z()}};
  }

  /// The covariance of body_pose(), whose axes are those of the body at the start.
  spatial::Mat6 body_covariance(const spatial::Answer& answer) const {
    const Vec3 arm = answer.T_map_robot.q * T_body_sensor_.inverse().t;  // from sensor to body
    spatial::Mat6 motion = spatial::Mat6::Identity();
    motion.topRightCorner<3, 3>() << 0.0, arm.z(), -arm.y(), -arm.z(), 0.0, arm.x(), arm.y(), -arm.x(), 0.0;
    spatial::Mat6 turn = spatial::Mat6::Zero();
    turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = T_body_sensor_.q.toRotationMatrix();
    const spatial::Mat6 all = turn * motion;
    const spatial::Mat6 c = all * answer.covariance * all.transpose();
    return 0.5 * (c + c.transpose());
  }

  /// The edge whose middle is lowest: of an upright wall its bottom, with which outlines begin.
  std::size_t lowest_edge(const std::vector<Vec3>& outline) const {
    std::size_t lowest = 0;
    double least = 0.0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec3 twice = T_body_sensor_.q * (outline[i] + outline[(i + 1) % outline.size()]);
      if (i > 0 && twice.z() >= least) continue;
      least = twice.z();
      lowest = i;
    }
    return lowest;
  }

  void put_landmarks(const sdk::Host& host, const std::vector<spatial::PlaneLandmark>& landmarks) const {
    std::vector<hw_mapped_plane_t> planes;
    std::vector<hw_mapped_corner_t> corners;
    for (const spatial::PlaneLandmark& landmark : landmarks) {
      const Vec3 n = (T_body_sensor_.q * landmark.normal).normalized();
      const std::size_t count = landmark.outline.size(), first = lowest_edge(landmark.outline);
      planes.push_back({landmark.id,
                        {n.x(), n.y(), n.z()},
                        n.dot(T_body_sensor_ * landmark.outline.front()),
                        landmark.observations,
                        status_of(landmark.status),
                        corners.size(),
                        count});
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t i = (first + k) % count;
        const Vec3 p = T_body_sensor_ * landmark.outline[i];
        corners.push_back({{p.x(), p.y(), p.z()}, landmark.certain[i] ? HW_EDGE_CERTAIN : 0u, 0});
      }
    }
    host.put_mapped_planes(planes, corners);
  }
};

}  // namespace hallway::slam_plane
