// SPDX-License-Identifier: MIT
// A whole SLAM plugin: registers each frame of points with the map by nearest neighbours and a rigid fit.
#include <hallway/plugin.hpp>

#include <Eigen/Geometry>

class TinySlam final : public hallway::sdk::Plugin {
 public:
  static const hw_plugin_info_t* info() {
    static constexpr std::uint32_t kInputs[] = {HW_SAMPLE_POINTS};
    static constexpr std::uint32_t kOutputs[] = {HW_OUTPUT_POSE, HW_OUTPUT_ASSOCIATIONS, HW_OUTPUT_LANDMARKS};
    static constexpr hw_plugin_info_t kInfo = hallway::sdk::plugin_info(
        "tiny_slam", "Tiny SLAM", "0.1.0", "", "Registers each frame with the map.", kInputs, kOutputs);
    return &kInfo;
  }
  explicit TinySlam(const hw_host_t* host) : Plugin(host) {}

  void process(const hw_frame_t& frame) override {
    for (std::uint32_t sample = 0; sample < frame.n_samples; ++sample) {
      if (frame.samples[sample]->kind != HW_SAMPLE_POINTS) continue;
      const auto& seen = *static_cast<const hw_points_t*>(frame.samples[sample]->payload);
      const Eigen::Isometry3d last = pose_;
      pose_ = last * motion_;  // predict: the robot moves as before
      for (int round = 0; round < 6; ++round) align(seen);
      motion_ = last.inverse() * pose_;
      host().put_associations(sample, associate(seen));
    }
    const Eigen::Vector3d t = pose_.translation();
    const Eigen::Quaterniond q(pose_.linear());
    host().put_pose({{t.x(), t.y(), t.z()}, {q.w(), q.x(), q.y(), q.z()}});
  }

  void report(bool) override { host().put_landmarks(map_); }
  void deactivate() override { reset(); }
  void reset() override {
    map_.clear();
    pose_ = motion_ = Eigen::Isometry3d::Identity();
  }

 private:
  static Eigen::Vector3d point(const hw_points_t& seen, std::uint64_t i) {
    const hw_point3_t& p = *hw_point_at(&seen, i);
    return {p.x, p.y, p.z};
  }

  /// The landmark nearest to a point of the map, within half a metre.
  hw_landmark_t* nearest(const Eigen::Vector3d& at) {
    hw_landmark_t* best = nullptr;
    double least = 0.5;
    for (hw_landmark_t& landmark : map_) {
      const double distance = (Eigen::Vector3d(landmark.position) - at).norm();
      if (distance < least) least = distance, best = &landmark;
    }
    return best;
  }

  /// Moves the pose to where the points meet their landmarks best.
  void align(const hw_points_t& seen) {
    Eigen::Matrix3Xd body(3, seen.count), map(3, seen.count);
    Eigen::Index pairs = 0;
    for (std::uint64_t i = 0; i < seen.count; ++i) {
      const hw_landmark_t* landmark = nearest(pose_ * point(seen, i));
      if (!landmark) continue;
      body.col(pairs) = point(seen, i);
      map.col(pairs++) = Eigen::Vector3d(landmark->position);
    }
    if (pairs > 3) pose_.matrix() = Eigen::umeyama(body.leftCols(pairs), map.leftCols(pairs), false);
  }

  /// The landmark of each point; what has none becomes one.
  std::vector<std::uint64_t> associate(const hw_points_t& seen) {
    std::vector<std::uint64_t> ids;
    for (std::uint64_t i = 0; i < seen.count; ++i) {
      const Eigen::Vector3d at = pose_ * point(seen, i);
      if (!at.allFinite()) {
        ids.push_back(HW_NO_LANDMARK);
        continue;
      }
      hw_landmark_t* landmark = nearest(at);
      if (!landmark)
        landmark =
            &map_.emplace_back(hw_landmark_t{map_.size(), {at.x(), at.y(), at.z()}, 0, HW_LANDMARK_MAPPED});
      ++landmark->observations;
      ids.push_back(landmark->id);
    }
    return ids;
  }

  std::vector<hw_landmark_t> map_;
  Eigen::Isometry3d pose_ = Eigen::Isometry3d::Identity();    // T_map_body
  Eigen::Isometry3d motion_ = Eigen::Isometry3d::Identity();  // of the last frame
};
HALLWAY_PLUGINS(TinySlam);
