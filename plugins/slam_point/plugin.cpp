// SPDX-License-Identifier: MIT
#include <hallway/plugin.hpp>

#include <optional>
#include <vector>

#include "adapter/option_rows.hpp"
#include "adapter/point_adapter.hpp"
#include "slam_point/core/index/point_index.hpp"
#include "slam_point/core/mapper.hpp"
#include "slam_point/core/thesis/mapper.hpp"

namespace hallway::slam_point {
namespace {

std::uint32_t to_c(LandmarkStatus status) {
  switch (status) {
    case LandmarkStatus::mapped:
      return HW_LANDMARK_MAPPED;
    case LandmarkStatus::dynamic:
      return HW_LANDMARK_DYNAMIC;
    case LandmarkStatus::temporary:
      break;
  }
  return HW_LANDMARK_TEMPORARY;
}

static_assert(kNoLandmark == HW_NO_LANDMARK);
static_assert(kNoTrack == HW_NO_TRACK);

constexpr const char* kAssociations[] = {"place", "sensor"};  // by Association

enum class Mode : int { ours = 0, thesis = 1 };
constexpr const char* kModeNames[] = {"ours", "thesis"};

/// What bounds derive from at least where the noise is a sensor's own: they have to cover the motion too, which a sensor knows nothing of.
constexpr double kLeastBoundNoise_m = 0.01;

/// The mapper behind the plugin ABI, and in its place, with mode=thesis, the thesis's own algorithm.
class SlamPoint final : public sdk::Plugin {
 public:
  static const hw_plugin_info_t* info();

  explicit SlamPoint(const hw_host_t* host) : Plugin(host) {
    add_options(parameters(), options_, slam_point::parameters());
    parameters().add_choice("index", &options_.index, kIndexNames,
                            "Spatial index of points; changes the time of a frame and no result.");
    parameters().add_choice(
        "association", &association_, kAssociations,
        "How a point is associated: by its place, or by the track that the sensor gives it.");
    parameters().add_choice("mode", &mode_, kModeNames,
                            "ours: submaps optimised together; thesis: groups placed one after another.");
    parameters().add_choice(
        "thesis_basis", &thesis_options_.basis, thesis::kBasisNames,
        "mode=thesis: three: three points of a group are its axes; all: its mean shape is.");
    parameters().add_choice(
        "thesis_matching", &thesis_options_.matching, thesis::kMatchingNames,
        "mode=thesis: nearest: to the last iterations as they were seen; predicted: as the last "
        "motion moves them.");
    add_options(parameters(), thesis_options_, thesis::parameters());
  }

  void activate(const hw_activation_t& activation) override {
    adapter_.activate(activation);
    const bool from_sensor = parameters().take_from_sensor("noise_m", adapter_.noise_m());
    options_.least_bound_noise_m = from_sensor ? kLeastBoundNoise_m : 0.0;
    options_.association = static_cast<Association>(association_);
    if (mode_ == static_cast<int>(Mode::thesis)) {
      thesis_.emplace(options_, thesis_options_);
    } else {
      mapper_.emplace(options_);
    }
  }

  void deactivate() override {
    mapper_.reset();
    thesis_.reset();
  }

  void reset() override {
    if (mapper_) mapper_->reset();
    if (thesis_) thesis_->reset();
    adapter_.reset();
  }

  void process(const hw_frame_t& frame) override {
    const std::vector<Vec3>& points = adapter_.gather(frame);
    const Answer& answer = thesis_ ? thesis_->process(points) : mapper_->process(points, adapter_.tracks());
    adapter_.put_pose(host(), frame, answer.has_pose, answer.T_map_sensor, answer.covariance);
    adapter_.put_associations(host(), answer.associations);
    put_counters(answer);
    host().put_map_epoch(answer.epoch);
  }

  void report(bool refine) override {
    const Map map = thesis_ ? thesis_->map() : refine ? mapper_->refined_map() : mapper_->map();
    put_landmarks(map);
    put_submaps(map);
  }

 private:
  void put_counters(const Answer& answer) const {
    const Counters& counters = answer.counters;
    const hw_counter_t list[] = {{"lost", static_cast<double>(counters.lost)},
                                 {"landmarks", static_cast<double>(counters.landmarks)},
                                 {"submaps", static_cast<double>(counters.submaps)},
                                 {"closes", static_cast<double>(counters.closes)},
                                 {"reopened", static_cast<double>(counters.reopened)},
                                 {"searches", static_cast<double>(counters.searches)},
                                 {"relocalised", static_cast<double>(counters.relocalised)},
                                 {"parts", static_cast<double>(counters.parts)},
                                 {"parts_joined", static_cast<double>(counters.joined)},
                                 {"determined", static_cast<double>(answer.determined)},
                                 {"part", answer.in_part ? static_cast<double>(answer.part) : -1.0}};
    host().put_counters(list);
  }

  void put_landmarks(const Map& map) const {
    std::vector<hw_landmark_t> landmarks;
    std::vector<double> covariances;  // six for each
    bool told = false;
    landmarks.reserve(map.landmarks.size());
    for (const Landmark& landmark : map.landmarks) {
      const Vec3 p = adapter_.map_point(landmark.position);
      landmarks.push_back({landmark.id, {p.x(), p.y(), p.z()}, landmark.observations, to_c(landmark.status)});
      const Mat3 c = landmark.covariance ? adapter_.map_covariance(*landmark.covariance) : Mat3(Mat3::Zero());
      covariances.insert(covariances.end(), {c(0, 0), c(0, 1), c(0, 2), c(1, 1), c(1, 2), c(2, 2)});
      told = told || landmark.covariance.has_value();
    }
    host().put_landmarks(landmarks, told ? covariances.data() : nullptr);
  }

  void put_submaps(const Map& map) const {
    std::vector<hw_submap_t> submaps;
    std::vector<std::uint64_t> members;
    for (const Submap& submap : map.submaps) {
      submaps.push_back(
          {submap.id, adapter_.body_pose(submap.T_map_submap), members.size(), submap.members.size()});
      members.insert(members.end(), submap.members.begin(), submap.members.end());
    }
    host().put_submaps(submaps, members);
  }

  Options options_;
  int association_ = 0;  ///< a place in kAssociations
  thesis::Options thesis_options_;
  int mode_ = static_cast<int>(Mode::ours);
  PointAdapter adapter_;
  std::optional<Mapper> mapper_;  // one of the two while active
  std::optional<thesis::Mapper> thesis_;
};

const hw_plugin_info_t* SlamPoint::info() {
  static constexpr std::uint32_t kInputs[] = {HW_SAMPLE_POINTS};
  static constexpr std::uint32_t kOutputs[] = {HW_OUTPUT_POSE, HW_OUTPUT_LANDMARKS, HW_OUTPUT_ASSOCIATIONS,
                                               HW_OUTPUT_SUBMAPS, HW_OUTPUT_COUNTERS};
  static constexpr hw_plugin_info_t kInfo = sdk::plugin_info(
      "slam_point", "Relative point SLAM", "0.1.0", "Hallway",
      "Maps points without odometry or identities, by poses relative to submaps.", kInputs, kOutputs);
  return &kInfo;
}

}  // namespace
}  // namespace hallway::slam_point

HALLWAY_PLUGINS(hallway::slam_point::SlamPoint);
