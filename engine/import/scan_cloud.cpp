// SPDX-License-Identifier: MIT
#include "import/scan_cloud.hpp"

#include <hallway/range_scan.h>

#include <algorithm>

#include "base/error.hpp"
#include "geom/arrays.hpp"

namespace hallway::import {
namespace {

/// Copies what each point may have beside its place.
class CloudData {
 public:
  CloudData(LidarCloud& cloud, const std::int64_t* times, const float* intensities,
            const std::uint32_t* rings)
      : cloud_(cloud), times_(times), intensities_(intensities), rings_(rings) {}

  void add(std::uint64_t i, const hw_point3_t& point) {
    cloud_.points.push_back({point.x, point.y, point.z});
    if (times_ != nullptr) cloud_.t_offset_ns.push_back(times_[i]);
    if (intensities_ != nullptr) cloud_.intensity.push_back(intensities_[i]);
    if (rings_ != nullptr) cloud_.ring.push_back(rings_[i]);
  }

 private:
  LidarCloud& cloud_;
  const std::int64_t* times_;
  const float* intensities_;
  const std::uint32_t* rings_;
};

LidarCloud cloud_of_scan(const hw_range_scan_t& scan) {
  LidarCloud cloud;
  CloudData data(cloud, scan.t_offset_ns, scan.intensity, scan.ring);
  for (std::uint64_t i = 0; i < scan.count; ++i) {
    const hw_ray_t* ray = hw_ray_at(&scan, i);
    if (hw_ray_has_return(ray) != 0) data.add(i, hw_ray_point(ray));
  }
  return cloud;
}

LidarCloud cloud_of_points(const hw_points_t& points) {
  LidarCloud cloud;
  CloudData data(cloud, hw_point_times_of(&points), hw_point_intensities_of(&points),
                 hw_point_rings_of(&points));
  for (std::uint64_t i = 0; i < points.count; ++i) data.add(i, *hw_point_at(&points, i));
  return cloud;
}

}  // namespace

LidarCloud cloud_of(const hw_sample_t& sample) {
  if (sample.kind == HW_SAMPLE_RANGE_SCAN)
    return cloud_of_scan(*static_cast<const hw_range_scan_t*>(sample.payload));
  if (sample.kind == HW_SAMPLE_POINTS)
    return cloud_of_points(*static_cast<const hw_points_t*>(sample.payload));
  throw Error(ErrorCode::kInternal, "a sample without rays or points was to become a cloud");
}

TrueMotion::TrueMotion(std::vector<TimedPose> poses) : poses_(std::move(poses)) {
  std::ranges::stable_sort(poses_, {}, &TimedPose::t_ns);
  const auto same_time = [](const TimedPose& a, const TimedPose& b) { return a.t_ns == b.t_ns; };
  poses_.erase(std::unique(poses_.begin(), poses_.end(), same_time), poses_.end());
}

bool TrueMotion::covers(std::int64_t begin_ns, std::int64_t end_ns) const {
  return !poses_.empty() && poses_.front().t_ns <= begin_ns && end_ns <= poses_.back().t_ns;
}

std::size_t TrueMotion::index_after(std::int64_t t_ns) const {
  return static_cast<std::size_t>(std::ranges::lower_bound(poses_, t_ns, {}, &TimedPose::t_ns) -
                                  poses_.begin());
}

bool TrueMotion::has(std::int64_t t_ns) const {
  return std::ranges::binary_search(poses_, t_ns, {}, &TimedPose::t_ns);
}

Pose TrueMotion::at(std::int64_t t_ns) const {
  const std::size_t after = index_after(t_ns);
  const TimedPose& b = poses_.at(after);
  if (b.t_ns == t_ns) return b.T_world_body;
  const TimedPose& a = poses_.at(after - 1);
  const double share = static_cast<double>(t_ns - a.t_ns) / static_cast<double>(b.t_ns - a.t_ns);
  return {a.T_world_body.q.slerp(share, b.T_world_body.q),
          a.T_world_body.t + share * (b.T_world_body.t - a.T_world_body.t)};
}

std::int64_t TrueMotion::longest_gap_ns(std::int64_t begin_ns, std::int64_t end_ns) const {
  std::size_t i = index_after(begin_ns);
  if (poses_.at(i).t_ns > begin_ns) --i;
  std::int64_t longest_ns = 0;
  for (; poses_[i].t_ns < end_ns; ++i)
    longest_ns = std::max(longest_ns, poses_.at(i + 1).t_ns - poses_[i].t_ns);
  return longest_ns;
}

void deskew(LidarCloud& cloud, std::int64_t begin_ns, const Pose& T_body_sensor, const Pose& T_world_body,
            const TrueMotion& motion) {
  const Pose T_sensor_world = (T_world_body * T_body_sensor).inverse();
  std::int64_t known_ns = -1;  // columns of a scan have one time each
  Pose T_there_then;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    if (cloud.t_offset_ns.at(i) != known_ns) {
      known_ns = cloud.t_offset_ns[i];
      T_there_then = T_sensor_world * motion.at(begin_ns + known_ns) * T_body_sensor;
    }
    cloud.points[i] = to_array(T_there_then * to_vec3(cloud.points[i]));
  }
}

}  // namespace hallway::import
