// SPDX-License-Identifier: MIT
#include "slam_point/core/frame/frame_matcher.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/median.hpp"
#include "geometry/rigid_fit.hpp"
#include "slam_point/core/fit/alignment.hpp"

namespace hallway::slam_point {
namespace {

constexpr int kMaxMatchPasses = 4;
constexpr std::size_t kLeastDrifted = 3;  // so many old landmarks off the same way are drift, not neighbours
constexpr int kMaxTurnsEachWay = 60;
constexpr std::size_t kMostScored = 40;    // points of a frame that a turn is judged by
constexpr std::size_t kLeastFollowed = 4;  // so many can contradict each other

/// Of an observation from its reference, in units of its own noise times noise_m: by its weight, or where noise has directions by `known`, the
/// information of the reference.
double squared_residual(const PointMotion& motion, const Observation& observation, const Vec3& reference,
                        double weight, const Mat3* known) {
  const Vec3 residual = motion * observation.point - reference;
  if (known == nullptr) return weight * residual.squaredNorm();
  const Mat3 seen = ray_information(motion.turned(observation.point), observation.weights());
  return residual.dot(pair_information(*known, seen) * residual);
}

}  // namespace

FrameMatcher::FrameMatcher(const Options& options, const SubmapGraph& graph)
    : options_(options),
      graph_(graph),
      agreement2_(options.agreement() * options.agreement()),
      reach_(std::max({options.match_bound(), options.map_bound(), options.agreement()})) {}

void FrameMatcher::begin() {
  for (const Index landmark : taken_list_) taken_[landmark] = 0;
  taken_list_.clear();
  taken_.resize(graph_.landmarks.size(), 0);
}

void FrameMatcher::mark(const Observations& frame) {
  begin();
  for (const Observation& observation : frame) {
    if (observation.landmark == kNone) continue;
    taken_[observation.landmark] = 1;
    taken_list_.push_back(observation.landmark);
  }
}

void FrameMatcher::take(const Candidate& candidate, Observations& frame) {
  frame[candidate.observation].landmark = candidate.landmark;
  frame[candidate.observation].member = candidate.member;
  taken_[candidate.landmark] = 1;
  taken_list_.push_back(candidate.landmark);
}

void FrameMatcher::take_undisputed(Observations& frame) {
  claims_.resize(taken_.size(), 0);
  for (const Candidate& candidate : candidates_) {
    std::uint8_t& claims = claims_[candidate.landmark];
    if (claims < 2) ++claims;
  }
  disputed_.clear();
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    const Candidate& candidate = candidates_[c];
    const bool alone =
        (c == 0 || candidates_[c - 1].observation != candidate.observation) &&
        (c + 1 == candidates_.size() || candidates_[c + 1].observation != candidate.observation);
    if (alone && claims_[candidate.landmark] == 1) {
      take(candidate, frame);
    } else {
      disputed_.push_back(candidate);
    }
  }
  for (const Candidate& candidate : candidates_) claims_[candidate.landmark] = 0;
  std::swap(candidates_, disputed_);
}

void FrameMatcher::take_nearest_first(Observations& frame) {
  take_undisputed(frame);
  std::sort(candidates_.begin(), candidates_.end());
  for (const Candidate& candidate : candidates_) {
    const bool is_free = frame[candidate.observation].landmark == kNone && taken_[candidate.landmark] == 0;
    if (is_free) take(candidate, frame);
  }
}

void FrameMatcher::match_members(const ActiveSubmap& active, const Pose& T, double bound,
                                 double followed_bound, Observations& frame) {
  const std::vector<Member>& members = graph_.submaps[graph_.active()].members;
  const PointMotion motion(T);
  const double bound2 = bound * bound;
  const double reach2 = std::max(bound2, agreement2_);
  candidates_.clear();
  for (Index o = 0; o < frame.size(); ++o) {
    if (frame[o].landmark != kNone) continue;
    const Vec3 p = motion * frame[o].point;
    const double near2 = std::min(bound2 / frame[o].weight, reach2);
    const auto consider = [&](Index m, double within2) {
      const double d2 = (members[m].mean - p).squaredNorm();
      if (d2 <= within2 && taken_[members[m].landmark] == 0)
        candidates_.push_back({d2, o, members[m].landmark, m});
    };
    if (!frame[o].is_followed()) {
      active.visit_members_near(p, [&](Index m) { consider(m, near2); });
    } else if (frame[o].expected != kNone) {
      const Index m = graph_.landmarks[frame[o].expected].active_member;
      if (m != kNone) consider(m, followed_bound * followed_bound / frame[o].weight);
    }
  }
  take_nearest_first(frame);
}

bool FrameMatcher::fit_pairs(Pose& T) {
  return graph_.is_directional() ? directional_fit(directional_pairs_, rules(), T)
                                 : robust_fit(pairs_, rules(), T);
}

bool FrameMatcher::fit_active(const Observations& frame, Pose& T) {
  // As fit_submap() does, without a search for the member.
  const std::vector<Member>& members = graph_.submaps[graph_.active()].members;
  begin_pairs();
  for (const Observation& observation : frame) {
    if (observation.landmark == kNone) continue;
    const Member& member = members[observation.member];
    add_pair(member.mean, member.weight(), member_information(graph_.active(), observation.member),
             observation);
  }
  return fit_pairs(T);
}

int FrameMatcher::drop_disagreeing(const Pose& T, Observations& frame) {
  const std::vector<Member>& members = graph_.submaps[graph_.active()].members;
  const PointMotion motion(T);
  int dropped = 0;
  for (Observation& observation : frame) {
    if (observation.landmark == kNone) continue;
    const Member& member = members[observation.member];
    if (squared_residual(motion, observation, member.mean, pair_weight(member.weight(), observation.weight),
                         member_information(graph_.active(), observation.member)) <= agreement2_)
      continue;
    taken_[observation.landmark] = 0;
    observation.landmark = kNone;
    ++dropped;
  }
  return dropped;
}

FrameMatcher::Fit FrameMatcher::match_active(const ActiveSubmap& active, const Pose& predicted,
                                             Observations& frame) {
  const Fit fit = match_from(active, predicted, options_.match_bound(), frame);
  const auto comparable = std::count_if(frame.begin(), frame.end(), [&](const Observation& observation) {
    return observation.expected != kNone && graph_.landmarks[observation.expected].active_member != kNone;
  });
  if (fit.solved && 2 * fit.agreeing >= comparable) return fit;
  if (comparable == 0) return fit;
  return match_from(active, predicted, std::numeric_limits<double>::infinity(), frame);
}

FrameMatcher::Fit FrameMatcher::match_from(const ActiveSubmap& active, const Pose& predicted,
                                           double followed_bound, Observations& frame) {
  Fit fit;
  fit.T_submap_sensor = predicted;
  for (int pass = 0; pass < kMaxMatchPasses; ++pass) {
    begin();
    for (Observation& observation : frame) observation.landmark = kNone;
    match_members(active, fit.T_submap_sensor, options_.match_bound(), followed_bound, frame);
    const int matched = static_cast<int>(taken_list_.size());
    fit.solved = fit_active(frame, fit.T_submap_sensor);
    if (!fit.solved) break;
    const int dropped = drop_disagreeing(fit.T_submap_sensor, frame);
    fit.agreeing = matched - dropped;
    if (10 * dropped <= matched) break;
  }
  if (!fit.solved) {
    begin();
    for (Observation& observation : frame) observation.landmark = kNone;
    fit.agreeing = 0;
    return fit;
  }
  // What the prediction put too far from its member, or on another one, may agree now.
  const std::size_t before = taken_list_.size();
  match_members(active, fit.T_submap_sensor, options_.agreement(), options_.agreement(), frame);
  fit.agreeing += static_cast<int>(taken_list_.size() - before);
  return fit;
}

bool FrameMatcher::locate_by_tracks(const Observations& frame, Pose& T_map_sensor) {
  pairs_.clear();
  for (const Observation& observation : frame) {
    if (observation.expected == kNone || graph_.landmarks[observation.expected].count == 0) continue;
    const LandmarkRecord& landmark = graph_.landmarks[observation.expected];
    pairs_.push_back({landmark.position, observation.point, pair_weight(landmark.weight, observation.weight),
                      observation.weight});
  }
  if (pairs_.size() < kLeastFollowed) return false;
  Eigen::Matrix3Xd from(3, pairs_.size()), to(3, pairs_.size());
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    from.col(static_cast<Eigen::Index>(i)) = pairs_[i].point;
    to.col(static_cast<Eigen::Index>(i)) = pairs_[i].reference;
  }
  // No guess is near, as the fit needs one: a closed form gives it.
  const Eigen::Matrix4d T = rigid_motion(from, to);
  Pose located{Quat(T.topLeftCorner<3, 3>()), T.topRightCorner<3, 1>()};
  if (!robust_fit(pairs_, rules(), located)) return false;
  T_map_sensor = located;
  return true;
}

double FrameMatcher::score(const Pose& T_map_sensor, const Observations& frame) const {
  const Mat3 rotation = T_map_sensor.q.toRotationMatrix();
  const double bound2 = options_.match_bound() * options_.match_bound();
  double sum = 0.0;
  // Many points need not all be asked.
  const std::size_t step = 1 + frame.size() / kMostScored;
  for (std::size_t o = 0; o < frame.size(); o += step) {
    const Vec3 p = rotation * frame[o].point + T_map_sensor.t;
    double nearest2 = bound2;
    graph_.visit_landmarks_near(
        p, [&](Index l) { nearest2 = std::min(nearest2, (graph_.landmarks[l].position - p).squaredNorm()); });
    sum += 1.0 - nearest2 / bound2;
  }
  return sum;
}

double FrameMatcher::turn_step(const Observations& frame, double max_turn_rad) {
  ranges_.clear();
  for (const Observation& observation : frame) ranges_.push_back(observation.point.norm());
  // Half a bound of arc at the middle range.
  return std::max(0.5 * options_.match_bound() / std::max(median(ranges_), options_.match_bound()),
                  max_turn_rad / kMaxTurnsEachWay);
}

int FrameMatcher::search_turn(const std::vector<Pose>& bases, double max_turn_rad, const Observations& frame,
                              Pose& T_map_sensor) {
  struct Hypothesis {
    double score = 0.0;
    Pose T;
  };
  if (frame.empty()) return 0;
  std::array<Hypothesis, 4> best;  // by falling score
  const double step = turn_step(frame, max_turn_rad);
  const int turns = static_cast<int>(max_turn_rad / step);
  for (const Pose& base : bases) {
    for (int turn = -turns; turn <= turns; ++turn) {
      const Pose T{(base.q * rotation_exp(Vec3(0.0, 0.0, step * turn))).normalized(), base.t};
      Hypothesis hypothesis{score(T, frame), T};
      for (Hypothesis& kept : best) {
        if (hypothesis.score > kept.score) std::swap(hypothesis, kept);
      }
    }
  }
  int most = 0;
  for (const Hypothesis& hypothesis : best) {
    Pose T = hypothesis.T;
    int agreeing = 0;
    for (int pass = 0; pass < kMaxMatchPasses; ++pass) {
      trial_ = frame;
      for (Observation& observation : trial_) observation.landmark = kNone;
      begin();
      match_map(T, 0, options_.match_bound(), trial_);
      if (!fit_map(trial_, T)) break;
      agreeing = count_agreeing(trial_, T);
    }
    if (agreeing > most) {
      most = agreeing;
      T_map_sensor = T;
    }
  }
  return most;
}

void FrameMatcher::match_map(const Pose& T_map_sensor, std::uint64_t local_since, double local_bound_m,
                             Observations& frame) {
  const PointMotion motion(T_map_sensor);
  const double local2 = local_bound_m * local_bound_m;
  const double old2 = options_.map_bound() * options_.map_bound();
  candidates_.clear();
  for (Index o = 0; o < frame.size(); ++o) {
    if (frame[o].landmark != kNone) continue;
    const Vec3 p = motion * frame[o].point;
    const auto consider = [&](Index l, double reach2) {
      const LandmarkRecord& landmark = graph_.landmarks[l];
      const double bound2 = (landmark.last_activation >= local_since ? local2 : old2) / frame[o].weight;
      const double d2 = (landmark.position - p).squaredNorm();
      if (d2 <= std::min(bound2, reach2) && taken_[l] == 0) candidates_.push_back({d2, o, l, kNone});
    };
    if (!frame[o].is_followed()) {
      graph_.visit_landmarks_near(p, [&](Index l) { consider(l, reach_ * reach_); });
    } else if (frame[o].expected != kNone) {
      consider(frame[o].expected, std::numeric_limits<double>::infinity());
    }
  }
  take_nearest_first(frame);
}

bool FrameMatcher::fit_map(const Observations& frame, Pose& T_map_sensor) {
  begin_pairs();
  for (const Observation& observation : frame) {
    if (observation.landmark == kNone) continue;
    const LandmarkRecord& landmark = graph_.landmarks[observation.landmark];
    if (landmark.count == 0) continue;
    add_pair(landmark.position, landmark.weight, information(observation.landmark), observation);
  }
  return fit_pairs(T_map_sensor);
}

bool FrameMatcher::fit_submap(Index submap, const Observations& frame, Pose& T_submap_sensor) {
  begin_pairs();
  for (const Observation& observation : frame) {
    if (observation.landmark == kNone) continue;
    for (const Membership& at : graph_.landmarks[observation.landmark].memberships) {
      if (at.submap != submap) continue;
      const Member& member = graph_.submaps[submap].members[at.member];
      add_pair(member.mean, member.weight(), member_information(submap, at.member), observation);
    }
  }
  return fit_pairs(T_submap_sensor);
}

bool FrameMatcher::agrees(const PointMotion& to_map, const Observation& observation) const {
  return squared_residual(to_map, observation, graph_.landmarks[observation.landmark].position,
                          observation.weight, information(observation.landmark)) <= agreement2_;
}

int FrameMatcher::count_agreeing(const Observations& frame, const Pose& T_map_sensor) const {
  const PointMotion to_map(T_map_sensor);
  int agreeing = 0;
  for (const Observation& observation : frame) {
    if (observation.landmark != kNone && agrees(to_map, observation)) ++agreeing;
  }
  return agreeing;
}

void FrameMatcher::drop_outliers(const Pose& T_map_sensor, std::uint64_t local_since, Observations& frame) {
  const PointMotion to_map(T_map_sensor);
  outliers_.clear();
  std::size_t agreeing = 0;
  for (Index o = 0; o < frame.size(); ++o) {
    if (frame[o].landmark == kNone || graph_.landmarks[frame[o].landmark].last_activation >= local_since)
      continue;
    if (agrees(to_map, frame[o])) {
      ++agreeing;
    } else {
      outliers_.push_back(o);
    }
  }
  const bool drifted = agreeing < outliers_.size();
  if (drifted && outliers_.size() >= kLeastDrifted) return;
  for (const Index o : outliers_) {
    taken_[frame[o].landmark] = 0;
    frame[o].landmark = kNone;
    frame[o].withheld = drifted;
  }
}

}  // namespace hallway::slam_point
