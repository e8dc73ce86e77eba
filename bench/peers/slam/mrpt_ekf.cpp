// SPDX-License-Identifier: MIT
#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/slam/CRangeBearingKFSLAM.h>
#include <hallway/plugin.hpp>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <numbers>
#include <vector>

#include "adapter/point_adapter.hpp"

namespace hallway::peers {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr const char* kAssociations[] = {"sensor", "nearest", "compatible"};
constexpr const char* kMethods[] = {"naive", "davison"};

/// MRPT's EKF over the pose and all landmarks (CRangeBearingKFSLAM), without odometry.
class MrptEkf final : public sdk::Plugin {
 public:
  static const hw_plugin_info_t* info() {
    static constexpr std::uint32_t kInputs[] = {HW_SAMPLE_POINTS};
    static constexpr std::uint32_t kOutputs[] = {HW_OUTPUT_POSE, HW_OUTPUT_LANDMARKS, HW_OUTPUT_ASSOCIATIONS};
    static constexpr hw_plugin_info_t kInfo =
        sdk::plugin_info("peer_mrpt_ekf", "MRPT: range-bearing EKF in six degrees of freedom", "0.1.0",
                         "Hallway", "mrpt::slam::CRangeBearingKFSLAM without odometry.", kInputs, kOutputs);
    return &kInfo;
  }

  explicit MrptEkf(const hw_host_t* host) : Plugin(host) {
    parameters().add_choice("association", &association_, kAssociations,
                            "The sensor's tracks, or MRPT's own: nearest neighbour, joint compatibility.");
    parameters().add_choice("method", &method_, kMethods,
                            "All observations at once, or one after the other.");
    parameters().add("noise_m", &noise_, 1e-4, 10.0, "m", "Standard deviation of a range.");
    parameters().add("noise_rad", &noise_rad_, 1e-6, 1.0, "rad", "Standard deviation of a bearing.");
    parameters().add("step_m", &step_, 1e-6, 10.0, "m", "Standard deviation of the motion of one frame.");
    parameters().add("turn", &turn_, 1e-9, 1.0, "1", "The same, of each component of the quaternion.");
    parameters().add("view_yaw_deg", &view_yaw_, 1.0, 360.0, "deg",
                     "Width of the field of view: others are not predicted.");
    parameters().add("view_pitch_deg", &view_pitch_, 1.0, 180.0, "deg", "Its height.");
    parameters().add("range_m", &range_, 0.1, 1e6, "m", "Farthest that the sensor sees.");
  }

  void activate(const hw_activation_t& activation) override {
    adapter_.activate(activation);
    begin();
  }
  void deactivate() override { filter_.reset(); }
  void reset() override {
    adapter_.reset();
    begin();
  }

  void process(const hw_frame_t& frame) override {
    const std::vector<Vec3>& points = adapter_.gather(frame);
    if (association_ == kByTrack && adapter_.tracks().empty() && !points.empty()) {
      throw sdk::Failure(
          HW_ERROR_DATA,
          "association=sensor needs points that the sensor follows (hallway replay --ids-as-tracks)");
    }
    auto frame_seen = mrpt::obs::CSensoryFrame::Create();
    frame_seen->insert(observation_of(points));
    auto no_odometry = mrpt::obs::CActionCollection::Create();
    filter_->processActionObservation(no_odometry, frame_seen);
    adapter_.put_pose(host(), frame, true, pose_of(filter_->getCurrentRobotPoseMean()));
    adapter_.put_associations(host(), association_ == kByTrack ? adapter_.tracks() : found(points.size()));
    count(points.size());
  }

  void report(bool) override {
    mrpt::poses::CPose3DQuatPDFGaussian pose;
    std::vector<mrpt::math::TPoint3D> positions;
    std::map<unsigned int, mrpt::maps::CLandmark::TLandmarkID> ids;
    mrpt::math::CVectorDouble state;
    mrpt::math::CMatrixDouble covariance;
    filter_->getCurrentState(pose, positions, ids, state, covariance);
    std::vector<hw_landmark_t> landmarks;
    for (unsigned int i = 0; i < positions.size(); ++i) {
      const Vec3 p = adapter_.map_point({positions[i].x, positions[i].y, positions[i].z});
      const std::uint64_t id = association_ == kByTrack ? static_cast<std::uint64_t>(ids.at(i)) : i;
      landmarks.push_back({id, {p.x(), p.y(), p.z()}, observations_[id], HW_LANDMARK_MAPPED});
    }
    host().put_landmarks(landmarks);
  }

 private:
  static constexpr int kByTrack = 0;
  static constexpr int kNearest = 1;

  void begin() {
    filter_ = std::make_unique<mrpt::slam::CRangeBearingKFSLAM>();
    filter_->setMinLoggingLevel(mrpt::system::LVL_ERROR);
    filter_->KF_options.method = method_ == 0 ? mrpt::bayes::kfEKFNaive : mrpt::bayes::kfEKFAlaDavison;
    auto& options = filter_->options;
    options.std_sensor_range = static_cast<float>(noise_);
    options.std_sensor_yaw = options.std_sensor_pitch = static_cast<float>(noise_rad_);
    options.data_assoc_method = association_ == kNearest ? mrpt::slam::assocNN : mrpt::slam::assocJCBB;
    options.force_ignore_odometry = true;
    for (std::size_t i = 0; i < 7; ++i) options.stds_Q_no_odo[i] = static_cast<float>(i < 3 ? step_ : turn_);
    observations_.clear();
    associations_.clear();
  }

  mrpt::obs::CObservation::Ptr observation_of(const std::vector<Vec3>& points) const {
    auto observation = mrpt::obs::CObservationBearingRange::Create();
    observation->fieldOfView_yaw = static_cast<float>(view_yaw_ * kDegree);
    observation->fieldOfView_pitch = static_cast<float>(view_pitch_ * kDegree);
    observation->maxSensorDistance = static_cast<float>(range_);
    observation->sensor_std_range = static_cast<float>(noise_);
    observation->sensor_std_yaw = observation->sensor_std_pitch = static_cast<float>(noise_rad_);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3& p = points[i];
      mrpt::obs::CObservationBearingRange::TMeasurement measurement;
      measurement.range = static_cast<float>(p.norm());
      measurement.yaw = static_cast<float>(std::atan2(p.y(), p.x()));
      measurement.pitch = static_cast<float>(-std::atan2(p.z(), std::hypot(p.x(), p.y())));  // downwards
      measurement.landmarkID = association_ == kByTrack ? static_cast<int>(adapter_.tracks()[i]) : -1;
      observation->sensedData.push_back(measurement);
    }
    return observation;
  }

  static Pose pose_of(const mrpt::poses::CPose3DQuat& pose) {
    return {
        Eigen::Quaterniond(pose.quat().r(), pose.quat().x(), pose.quat().y(), pose.quat().z()).normalized(),
        Vec3(pose.x(), pose.y(), pose.z())};
  }

  /// What the filter took each point for, by the landmark's place in its state.
  const std::vector<std::uint64_t>& found(std::size_t points) {
    const auto& last = filter_->getLastDataAssociation();
    associations_.assign(points, HW_NO_LANDMARK);
    for (const auto& [point, prediction] : last.results.associations) {
      associations_.at(point) = prediction;
    }
    for (const auto& [point, landmark] : last.newly_inserted_landmarks) associations_.at(point) = landmark;
    return associations_;
  }

  void count(std::size_t points) {
    const auto& given = association_ == kByTrack ? adapter_.tracks() : associations_;
    for (std::size_t i = 0; i < points; ++i) {
      if (given[i] != HW_NO_LANDMARK) ++observations_[given[i]];
    }
  }

  int association_ = kByTrack;
  int method_ = 1;
  double noise_ = 0.05;
  double noise_rad_ = 0.0025;
  double step_ = 0.3;
  double turn_ = 0.005;
  double view_yaw_ = 90.0;
  double view_pitch_ = 60.0;
  double range_ = 100.0;
  PointAdapter adapter_;
  std::unique_ptr<mrpt::slam::CRangeBearingKFSLAM> filter_;
  std::map<std::uint64_t, std::uint32_t> observations_;  ///< by landmark
  std::vector<std::uint64_t> associations_;
};

}  // namespace
}  // namespace hallway::peers

HALLWAY_PLUGINS(hallway::peers::MrptEkf);
