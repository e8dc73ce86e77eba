// SPDX-License-Identifier: MIT
#include "slam_point/core/frame/frame_intake.hpp"

namespace hallway::slam_point {
namespace {

constexpr double kMaxCoordinate_m = 1e6;

}  // namespace

FrameIntake::FrameIntake(const Options& options)
    : options_(options),
      ranges_count_(options.noise_per_m > 0.0 || options.noise_per_m2 > 0.0 || options.is_directional()) {}

void FrameIntake::take(std::span<const Vec3> points, std::span<const TrackId> tracks, const TrackBook& book,
                       const SubmapGraph& graph, std::vector<Observation>& frame) {
  frame.clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    // Written so that NaN fails.
    if (!(points[i].cwiseAbs().maxCoeff() <= kMaxCoordinate_m) || !points[i].allFinite()) continue;
    if (points[i].z() != 0.0) planar_ = false;
    frame.push_back({points[i], i});
    if (ranges_count_) weigh(frame.back());
  }
  take_tracks(tracks, book, graph, frame);
}

void FrameIntake::weigh(Observation& observation) const {
  const double range = observation.point.norm();
  const double along = options_.noise_m / options_.noise_at(range);
  const double across = options_.noise_m / options_.noise_across_at(range);
  observation.weight = along * along;
  observation.across = across * across;
}

void FrameIntake::take_tracks(std::span<const TrackId> tracks, const TrackBook& book,
                              const SubmapGraph& graph, std::vector<Observation>& frame) {
  followed_ = options_.association == Association::sensor && !tracks.empty();
  if (!followed_) return;
  for (Observation& observation : frame) {
    observation.track = tracks[observation.given];
    observation.expected = book.landmark_of(observation.track, graph);
    const bool elsewhere =
        observation.expected != kNone && graph.landmarks[observation.expected].part != graph.part();
    if (elsewhere) observation.expected = kNone;
  }
}

}  // namespace hallway::slam_point
