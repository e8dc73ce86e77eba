// SPDX-License-Identifier: MIT
#include "slam_point/core/places/part_watch.hpp"

#include <algorithm>

namespace hallway::slam_point {
namespace {

constexpr std::uint64_t kYoungFrames = 10;   // a part with fewer is given up when the sensor gets lost in it
constexpr std::uint64_t kMeetPeriod = 10;    // frames between looks for other parts, in one that is not young
constexpr std::size_t kLeastPartPoints = 5;  // that begin another part
constexpr int kFalsePartsAtOnce = 8;
constexpr int kMostDoublings = 6;
constexpr std::uint32_t kLeastInView = 3;  // observations of a landmark that is looked for in other parts
constexpr double kMeetingNoises = 12.0;

}  // namespace

PartWatch::PartWatch(const Options& options, const SubmapGraph& graph, const MapParts& parts,
                     PlaceRecogniser& places)
    : bridge_frames_(options.bridge_frames),
      tolerance_(kMeetingNoises * options.noise_m),
      graph_(graph),
      parts_(parts),
      places_(places),
      meeting_(tolerance_) {}

bool PartWatch::is_young(std::uint64_t frames) {
  return frames < kYoungFrames;
}

bool PartWatch::is_time_to_begin(std::size_t points, int frames_without_pose) const {
  if (parts_.is_joining() || points < kLeastPartPoints) return false;
  return frames_without_pose > frames_to_bridge(parts_.frames(graph_.part()) == 1);
}

void PartWatch::note_begin() {
  const bool false_start = parts_.frames(graph_.part()) == 1;
  false_parts_ = false_start ? false_parts_ + 1 : 0;
}

/// A part that no second frame was placed in is begun again at once; what goes on like this is tried ever more seldom.
int PartWatch::frames_to_bridge(bool false_start) const {
  if (!false_start) return bridge_frames_;
  if (false_parts_ < kFalsePartsAtOnce) return 0;
  return (1 + bridge_frames_) << std::min(false_parts_ - kFalsePartsAtOnce, kMostDoublings);
}

std::optional<PartWatch::Meeting> PartWatch::look(const Pose& T_map_sensor, std::uint64_t iteration) {
  if (parts_.count() < 2 || parts_.is_joining()) return std::nullopt;
  const Index here = graph_.part();
  const std::uint64_t frames = parts_.frames(here);
  if (!is_young(frames) && iteration % kMeetPeriod != 0) return std::nullopt;
  gather_view(frames, T_map_sensor);
  Relocalisation found;
  if (!places_.find_elsewhere(view_, here, found)) return std::nullopt;
  const Pose T_other_here = found.T_map_points * T_map_sensor.inverse();
  for (Vec3& p : view_) p = T_map_sensor * p;
  if (!meeting_.confirm(here, found.part, T_other_here, view_)) return std::nullopt;
  return Meeting{found.part, T_other_here};
}

/// The landmarks about the sensor: more of them, and better known, than one frame sees.
void PartWatch::gather_view(std::uint64_t frames, const Pose& T_map_sensor) {
  const Pose T_sensor_map = T_map_sensor.inverse();
  view_.clear();
  const auto least = static_cast<std::uint32_t>(std::min<std::uint64_t>(kLeastInView, frames));
  for (const Member& member : graph_.submaps[graph_.active()].members) {
    if (member.count == 0 || graph_.landmarks[member.landmark].count < least) continue;
    view_.push_back(T_sensor_map * graph_.landmarks[member.landmark].position);
  }
}

void PartWatch::clear() {
  meeting_ = PartMeeting(tolerance_);
}

}  // namespace hallway::slam_point
