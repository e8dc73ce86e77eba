// SPDX-License-Identifier: MIT
#include "slam_point/core/moving/motion_tracks.hpp"

#include <algorithm>
#include <tuple>

namespace hallway::slam_point {
namespace {

constexpr std::uint64_t kMaxFramesUnseen = 10;
constexpr double kNewestVelocity = 0.3;  // its share in the velocity
constexpr double kSwerve = 0.5;          // of the way since the last sighting, that the velocity may change

}  // namespace

void MotionTracks::begin(Index landmark, std::uint64_t frame, const Vec3& place, const Vec3& velocity,
                         std::uint32_t sightings) {
  tracks_.push_back({landmark, sightings, kNone, Vec3::Zero()});
  live_.push_back({tracks_.size() - 1, frame, place, velocity});
  see(live_.back(), frame, place);
}

void MotionTracks::see(Live& live, std::uint64_t frame, const Vec3& place) {
  if (frame > live.last_frame) {
    const Vec3 velocity = (place - live.place) / static_cast<double>(frame - live.last_frame);
    live.velocity += kNewestVelocity * (velocity - live.velocity);
  }
  live.last_frame = frame;
  live.place = place;
  Track& track = tracks_[live.track];
  ++track.sightings;
  track.submap = graph_.active();
  track.place = graph_.poses[graph_.active()].inverse() * place;
}

void MotionTracks::match(std::uint64_t frame, const std::vector<Candidate>& candidates) {
  expected_.clear();
  double farthest = 0.0;
  for (Index i = 0; i < live_.size(); ++i) {
    const Live& live = live_[i];
    const double frames = static_cast<double>(frame - live.last_frame);
    const Vec3 way = frames * live.velocity;
    const double reach = reach_m_ + kSwerve * way.norm();
    expected_.push_back({live.place + way, reach, i});
    farthest = std::max(farthest, reach);
  }
  std::sort(expected_.begin(), expected_.end(), [](const Expected& a, const Expected& b) {
    return std::tie(a.place.x(), a.live) < std::tie(b.place.x(), b.live);
  });
  matches_.clear();
  taken_.assign(candidates.size(), 0);
  for (Index c = 0; c < candidates.size(); ++c) {
    const Vec3& p = candidates[c].place;
    auto at = std::lower_bound(expected_.begin(), expected_.end(), p.x() - farthest,
                               [](const Expected& e, double x) { return e.place.x() < x; });
    for (; at != expected_.end() && at->place.x() <= p.x() + farthest; ++at) {
      const double d2 = (at->place - p).squaredNorm();
      if (d2 <= at->reach_m * at->reach_m) matches_.push_back({d2, c, at->live});
    }
  }
  std::sort(matches_.begin(), matches_.end());
}

void MotionTracks::forget(std::uint64_t frame) {
  std::erase_if(live_, [&](const Live& live) { return frame - live.last_frame > kMaxFramesUnseen; });
}

void MotionTracks::clear() {
  tracks_.clear();
  live_.clear();
}

}  // namespace hallway::slam_point
