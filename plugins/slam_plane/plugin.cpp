// SPDX-License-Identifier: MIT
#include <hallway/plugin.hpp>

#include <optional>
#include <vector>

#include "adapter/option_rows.hpp"
#include "slam_plane/core/mapper.hpp"
#include "slam_plane/spatial/mapper.hpp"
#include "slam_plane/spatial_adapter.hpp"
#include "slam_plane/thesis/thesis_mapper.hpp"
#include "slam_plane/wall_adapter.hpp"

namespace hallway::slam_plane {
namespace {

static_assert(kNoLandmark == HW_NO_LANDMARK);

enum class Mode : int { relative = 0, thesis = 1 };
constexpr const char* kModeNames[] = {"relative", "thesis"};
/// Degrees of freedom of the robot's motion.
enum class Dof : int { three = 0, six = 1 };
constexpr const char* kDofNames[] = {"3", "6"};

/// What is reckoned with at least where the noise is a sensor's own: a sensor without noise makes no map without errors while loops are open.
constexpr double kLeastNoise_m = 0.01;

/// The mapper behind the plugin ABI, and in its place, with mode=thesis, the thesis's own algorithm. Walls have ids where landmarks have them.
class SlamPlane final : public sdk::Plugin {
 public:
  static const hw_plugin_info_t* info();

  explicit SlamPlane(const hw_host_t* host) : Plugin(host) {
    add_options(parameters(), options_, slam_plane::parameters());
    parameters().add("range_bounds_sides", &range_bounds_sides_, 0, 1, "1",
                     "1: the sensor's range bounds distances; 0: it bounds depths, straight ahead.");
    parameters().add_choice(
        "mode", &mode_, kModeNames,
        "relative: submaps of lines and corners, placed together; thesis: comparisons of pairs, chained.");
    parameters().add_choice(
        "dof", &dof_, kDofNames,
        "3: upright walls, a robot that stays level; 6: any faces, a robot that moves and "
        "turns as it likes.");
    add_options(parameters(), thesis_options_, thesis::parameters());
  }

  void activate(const hw_activation_t& activation) override {
    if (dof_ == static_cast<int>(Dof::six)) {
      if (mode_ == static_cast<int>(Mode::thesis))
        throw sdk::Failure(HW_ERROR_ARGUMENT, "dof=6 goes with mode=relative alone: mode=thesis is 2 1/2-D");
      spatial_adapter_.activate(activation);
      take_noise(spatial_adapter_.noise_m());
      spatial_adapter_.view().range_bounds_sides = range_bounds_sides_ != 0;
      spatial_.emplace(options_);
      return;
    }
    adapter_.activate(activation);
    adapter_.view().range_bounds_sides = range_bounds_sides_ != 0;
    if (mode_ == static_cast<int>(Mode::thesis)) {
      thesis_.emplace(thesis_options_);  // knows no noise
    } else {
      take_noise(adapter_.noise_m());
      mapper_.emplace(options_);
    }
  }

  void deactivate() override {
    mapper_.reset();
    thesis_.reset();
    spatial_.reset();
  }

  void reset() override {
    if (mapper_) mapper_->reset();
    if (thesis_) thesis_->reset();
    if (spatial_) spatial_->reset();
  }

  void process(const hw_frame_t& frame) override {
    if (spatial_) {
      spatial_adapter_.put_answer(host(),
                                  spatial_->process(spatial_adapter_.gather(frame), spatial_adapter_.view()));
      host().put_map_epoch(0);  // it never begins anew
      return;
    }
    const std::vector<WallObservation>& observations = adapter_.gather(frame);
    const Answer& answer = thesis_ ? thesis_->process(observations, adapter_.view())
                                   : mapper_->process(observations, adapter_.view());
    adapter_.put_pose(host(), answer);
    adapter_.put_associations(host(), answer.associations);
    if (thesis_) {
      put_thesis_counters(answer);
    } else {
      put_counters(answer);
    }
    host().put_map_epoch(answer.part);
  }

  void report(bool refine) override {
    if (spatial_) {
      spatial_adapter_.put_map(host(), refine ? spatial_->refined_map() : spatial_->map());
      return;
    }
    const Map map = thesis_ ? map_of(*thesis_, refine) : map_of(*mapper_, refine);
    adapter_.put_landmarks(host(), map.walls);
    if (mapper_) {
      for (const JoinedPart& joined : mapper_->joined_parts())
        host().put_joined_epoch(joined.part, joined.into);
    }
    adapter_.put_submaps(host(), map.submaps);
  }

 private:
  /// Takes the sensor's noise where none was set.
  void take_noise(double noise_m) {
    const bool from_sensor = parameters().take_from_sensor("noise_m", noise_m);
    options_.least_noise_m = from_sensor ? kLeastNoise_m : 0.0;
  }

  template <typename AnyMapper>
  static Map map_of(AnyMapper& mapper, bool refine) {
    return refine ? mapper.refined_map() : mapper.map();
  }

  void put_counters(const Answer& answer) const {
    const Counters& counters = answer.counters;
    const hw_counter_t list[] = {
        {"lost", number(counters.lost)},
        {"walls", number(counters.landmarks)},
        {"submaps", number(counters.submaps)},
        {"closes", number(counters.closes)},
        {"reopened", number(counters.reopened)},
        {"degenerate", number(counters.degenerate)},
        {"gaps", number(counters.gaps)},
        {"gaps_closed", number(counters.gaps_closed)},
        {"global_steps", number(counters.global_steps)},
        {"merged", number(counters.merged)},
        {"dynamic", number(counters.dynamic)},
        {"corners_revoked", number(counters.corners_revoked)},
        {"undetermined_x", answer.unobservable.x()},
        {"undetermined_y", answer.unobservable.y()},
        {"untied_x", answer.untied.x()},
        {"untied_y", answer.untied.y()},
    };
    host().put_counters(list);
  }

  void put_thesis_counters(const Answer& answer) const {
    const Counters& counters = answer.counters;
    const thesis::ThesisCounters own = thesis_->counters();
    const hw_counter_t list[] = {
        {"lost", number(counters.lost)},
        {"walls", number(counters.landmarks)},
        {"submaps", number(counters.submaps)},
        {"degenerate", number(counters.degenerate)},
        {"comparisons", number(own.comparisons)},
        {"cache_hits", number(own.cache_hits)},
        {"roll_backs", number(own.roll_backs)},
        {"replayed", number(own.replayed)},
        {"submaps_after_motion", number(own.submaps_after_motion)},
        {"undetermined_x", answer.unobservable.x()},
        {"undetermined_y", answer.unobservable.y()},
    };
    host().put_counters(list);
  }

  Options options_;
  int range_bounds_sides_ = 0;
  thesis::Options thesis_options_;
  int mode_ = static_cast<int>(Mode::relative);
  int dof_ = static_cast<int>(Dof::three);
  WallAdapter adapter_;
  SpatialAdapter spatial_adapter_;
  std::optional<Mapper> mapper_;  // one of the three while active
  std::optional<thesis::ThesisMapper> thesis_;
  std::optional<spatial::Mapper> spatial_;
};

const hw_plugin_info_t* SlamPlane::info() {
  static constexpr std::uint32_t kInputs[] = {HW_SAMPLE_PLANES};
  static constexpr std::uint32_t kOutputs[] = {
      HW_OUTPUT_POSE, HW_OUTPUT_ASSOCIATIONS, HW_OUTPUT_MAPPED_PLANES, HW_OUTPUT_SUBMAPS, HW_OUTPUT_COUNTERS};
  static constexpr hw_plugin_info_t kInfo = sdk::plugin_info(
      "slam_plane", "Relative plane SLAM", "0.1.0", "Hallway",
      "Maps walls seen in part, without odometry or identities, by submaps of lines and corners.", kInputs,
      kOutputs);
  return &kInfo;
}

}  // namespace
}  // namespace hallway::slam_plane

HALLWAY_PLUGINS(hallway::slam_plane::SlamPlane);
