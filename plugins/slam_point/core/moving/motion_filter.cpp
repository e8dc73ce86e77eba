// SPDX-License-Identifier: MIT
#include "slam_point/core/moving/motion_filter.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace hallway::slam_point {
namespace {

constexpr std::uint32_t kLeastAstray = 3;  // sightings away from the mapped place before it is judged
constexpr std::uint32_t kMostAstray = 8;   // what stands there by then is another landmark
constexpr std::uint32_t kLeastAcquittal = 3;
constexpr std::uint64_t kVelocityFrames = 8;

}  // namespace

MotionFilter::MotionFilter(const Options& options, SubmapGraph& graph)
    : graph_(graph),
      reach_m_(options.match_bound()),
      watch_(options.noise_m),
      verdict_(options.noise_m),
      tracks_(graph, 0.5 * options.match_bound()) {}

void MotionFilter::follow(const Pose& T_map_sensor, Observations& frame) {
  find_candidates(T_map_sensor, frame);
  tracks_.follow(history_.frames(), candidates_,
                 [&](Index observation, Index landmark) { frame[observation].moving = landmark; });
  std::erase_if(candidates_,
                [&](const auto& candidate) { return frame[candidate.observation].moving != kNone; });
  if (candidates_.empty()) return;
  find_missing(frame);
  link_astray(frame);
}

void MotionFilter::find_candidates(const Pose& T_map_sensor, const Observations& frame) {
  const PointMotion to_map(T_map_sensor);
  candidates_.clear();
  for (Index o = 0; o < frame.size(); ++o) {
    if (frame[o].landmark == kNone && !frame[o].withheld) candidates_.push_back({o, to_map * frame[o].point});
  }
}

void MotionFilter::find_missing(const Observations& frame) {
  missing_.clear();
  const std::uint64_t now = history_.frames();
  if (now == 0) return;
  seen_in_.resize(graph_.landmarks.size(), 0);
  for (const Observation& observation : frame) {
    if (observation.landmark != kNone) seen_in_[observation.landmark] = now + 1;
  }
  for (const SightingHistory::Sighting& sighting : history_.frame(now - 1)) {
    const Index l = sighting.landmark;
    if (seen_in_[l] == now + 1 || graph_.landmarks[l].count == 0 || watch_.astray(l) >= kMostAstray) continue;
    missing_.push_back({l, history_.pose(now - 1) * sighting.point});
  }
}

void MotionFilter::link_astray(Observations& frame) {
  hops_.clear();
  for (Index c = 0; c < candidates_.size(); ++c) {
    for (Index m = 0; m < missing_.size(); ++m) {
      const double d2 = (candidates_[c].place - missing_[m].place).squaredNorm();
      if (d2 <= reach_m_ * reach_m_) hops_.push_back({d2, c, m});
    }
  }
  std::sort(hops_.begin(), hops_.end());
  for (const Pairing& hop : hops_) {
    Observation& observation = frame[candidates_[hop.point].observation];
    Missing& missing = missing_[hop.other];
    if (observation.moving != kNone || missing.landmark == kNone) continue;
    observation.moving = missing.landmark;
    missing.landmark = kNone;
  }
}

bool MotionFilter::judge(ActiveSubmap& active, const Pose& T_map_sensor, Observations& frame) {
  record(T_map_sensor, frame);
  suspects_.clear();
  suspect_astray(frame);
  suspect_drifting(T_map_sensor, frame);
  if (suspects_.empty()) return false;
  // Which of them says what time is looked at must not depend on the order of the points.
  std::sort(suspects_.begin(), suspects_.end(), [](const auto& a, const auto& b) {
    return std::tie(a.since, a.attempt, a.landmark) < std::tie(b.since, b.attempt, b.landmark);
  });
  std::rotate(suspects_.begin(), suspects_.begin() + static_cast<std::ptrdiff_t>(turn_++ % suspects_.size()),
              suspects_.end());
  verdict_.judge(history_, suspects_, graph_.planar, findings_);
  bool any = false;
  for (std::size_t s = 0; s < suspects_.size(); ++s) {
    const Index landmark = suspects_[s].landmark;
    if (findings_[s] == MotionVerdict::Finding::stands) {
      const std::uint64_t frames = history_.frames() - suspects_[s].since;
      watch_.acquit(landmark, std::max(kLeastAcquittal, static_cast<std::uint32_t>(frames / 4)));
    }
    if (findings_[s] != MotionVerdict::Finding::moves) continue;
    take_out(active, landmark);
    for (Observation& observation : frame) {
      if (observation.landmark != landmark) continue;
      observation.landmark = kNone;
      observation.moving = landmark;
    }
    any = true;
  }
  return any;
}

void MotionFilter::record(const Pose& T_map_sensor, const Observations& frame) {
  history_.begin_frame(T_map_sensor);
  watch_.begin_frame(history_.frames() - 1);
  for (const Observation& observation : frame) {
    if (observation.landmark != kNone) {
      history_.add(observation.landmark, observation.point, observation.weight);
    } else if (observation.moving != kNone && !graph_.landmarks[observation.moving].moving) {
      history_.add(observation.moving, observation.point, observation.weight);
    }
  }
}

void MotionFilter::suspect_astray(const Observations& frame) {
  for (const Observation& observation : frame) {
    const Index l = observation.moving;
    if (l == kNone || graph_.landmarks[l].moving) continue;
    if (watch_.add_astray(l) >= kLeastAstray) suspects_.push_back({l, watch_.since(l), 0});
  }
}

void MotionFilter::suspect_drifting(const Pose& T_map_sensor, const Observations& frame) {
  const PointMotion to_map(T_map_sensor);
  for (const Observation& observation : frame) {
    const Index l = observation.landmark;
    if (l == kNone) continue;
    const LandmarkRecord& landmark = graph_.landmarks[l];
    Vec3 residual = to_map * observation.point - landmark.position;
    if (observation.weight != 1.0) residual *= std::sqrt(observation.weight);
    if (watch_.add(l, residual, landmark.count))
      suspects_.push_back({l, watch_.since(l), watch_.acquittals(l)});
  }
}

void MotionFilter::take_out(ActiveSubmap& active, Index landmark) {
  const std::uint64_t now = history_.frames() - 1;
  const std::uint64_t since = std::max(now - std::min(now, kVelocityFrames), watch_.since(landmark));
  Vec3 first = Vec3::Zero();
  Vec3 last = Vec3::Zero();
  std::uint64_t first_frame = now;
  std::uint64_t last_frame = now;
  bool found = false;
  for (std::uint64_t number = since; number <= now; ++number) {
    if (!history_.holds(number)) continue;
    for (const SightingHistory::Sighting& sighting : history_.frame(number)) {
      if (sighting.landmark != landmark) continue;
      last = history_.pose(number) * sighting.point;
      last_frame = number;
      if (!found) first = last;
      if (!found) first_frame = number;
      found = true;
    }
  }
  const double frames = std::max(1.0, static_cast<double>(last_frame - first_frame));
  const std::uint32_t sightings = graph_.landmarks[landmark].count;
  if (graph_.landmarks[landmark].active_member != kNone)
    active.withdraw(graph_.landmarks[landmark].active_member);
  graph_.withdraw(landmark);
  history_.forget(landmark);
  tracks_.begin(landmark, last_frame, last, (last - first) / frames, sightings);
}

void MotionFilter::clear() {
  history_.clear();
  watch_.clear();
  tracks_.clear();
  seen_in_.clear();
  turn_ = 0;
}

}  // namespace hallway::slam_point
