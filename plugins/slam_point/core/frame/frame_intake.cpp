// SPDX-License-Identifier: MIT
#include "slam_point/core/frame/frame_intake.hpp"

namespace hallway::slam_point {
namespace {

constexpr double kMaxCoordinate_m = 1e6;

}  // namespace

FrameIntake::FrameIntake(const Options& options, const TrackBook& book, const SubmapGraph& graph)
    : options_(options),
      book_(book),
      graph_(graph),
      ranges_count_(options.noise_per_m > 0.0 || options.noise_per_m2 > 0.0 || options.is_directional()) {}

bool FrameIntake::is_usable(const Vec3& point) {
  // Written so that NaN fails.
  return point.cwiseAbs().maxCoeff() <= kMaxCoordinate_m && point.allFinite();
}

void FrameIntake::take(std::span<const Vec3> points, std::span<const TrackId> tracks, Frame& frame) const {
  frame.observations.clear();
  frame.followed = options_.association == Association::sensor && !tracks.empty();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_usable(points[i])) continue;
    if (points[i].z() != 0.0) frame.planar = false;
    Observation& observation = frame.observations.emplace_back(Observation{points[i], i});
    if (ranges_count_) weigh(observation);
    if (!frame.followed) continue;
    observation.track = tracks[i];
    observation.expected = expected(tracks[i]);
  }
}

void FrameIntake::weigh(Observation& observation) const {
  const double range = observation.point.norm();
  const double along = options_.noise_m / options_.noise_at(range);
  const double across = options_.noise_m / options_.noise_across_at(range);
  observation.weight = along * along;
  observation.across = across * across;
}

/// The landmark of a track, if it is in the current part.
Index FrameIntake::expected(TrackId track) const {
  const Index landmark = book_.landmark_of(track, graph_);
  return landmark != kNone && graph_.landmarks[landmark].part == graph_.part() ? landmark : kNone;
}

}  // namespace hallway::slam_point
