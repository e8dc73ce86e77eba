// SPDX-License-Identifier: MIT
#include "slam_point/core/moving/motion_verdict.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "geometry/median.hpp"

namespace hallway::slam_point {
namespace {

constexpr double kMovedDeviations2 = 25.0;  // squared; a landmark that stands does so 1 time in 10^5
constexpr double kMedianChi3 = 2.366;       // of a sum of three squared standard normal deviates
constexpr std::size_t kLeastCommon = 5;
constexpr double kFewSuspects = 0.85;  // so many of the landmarks are above suspicion: they decide
constexpr std::size_t kMostWitnesses =
    600;  // landmarks above suspicion that are asked; more tell hardly more

/// Pairs of frames for a landmark in view for so many frames.
int pairs_for(std::uint64_t frames) {
  return static_cast<int>(std::clamp<std::uint64_t>(frames / 3, 1, MotionVerdict::kMostPairs));
}

/// The time between the blocks: of the longest that fits three significant bits, so that suspects can be judged together. Every
/// other attempt halves it, for what swings back to where it was.
std::uint64_t lag_for(std::uint64_t frames, int pairs, std::uint32_t attempt) {
  const std::uint64_t longest = frames - static_cast<std::uint64_t>(pairs);
  const std::uint64_t wanted = std::max<std::uint64_t>(longest >> (attempt % 3), 1);
  const auto bits = static_cast<int>(std::bit_width(wanted));
  return bits <= 3 ? wanted : wanted >> (bits - 3) << (bits - 3);
}

}  // namespace

void MotionVerdict::judge(const SightingHistory& history, const std::vector<Suspect>& suspects, bool planar,
                          std::vector<Finding>& findings) {
  findings.assign(suspects.size(), Finding::open);
  if (suspects.empty()) return;
  const std::uint64_t now = history.frames() - 1;
  const auto frames_of = [&](const Suspect& suspect) {
    return std::min<std::uint64_t>(now - suspect.since + 1, SightingHistory::kFrames);
  };
  const std::uint64_t first_frames = frames_of(suspects.front());
  if (first_frames < 3) return;
  const int pairs = pairs_for(first_frames);
  const std::uint64_t lag = lag_for(first_frames, pairs, suspects.front().attempt);
  rules_ = fit_rules(noise_m_, planar);
  begin_session(history, suspects);
  int laid = 0;
  for (int i = 0; i < pairs; ++i) {
    const std::uint64_t later = now - static_cast<std::uint64_t>(i);
    if (add_pair(history, later - lag, later)) ++laid;
  }
  if (laid == 0) return;
  const double usual = usual_variance(laid);
  for (std::size_t s = 0; s < suspects.size(); ++s) {
    const std::uint64_t frames = frames_of(suspects[s]);
    if (frames < 3 || pairs_for(frames) < pairs || lag_for(frames, pairs, suspects[s].attempt) != lag)
      continue;
    const Shift& shift = shifts_[suspects[s].landmark];
    if (shift.session == session_) findings[s] = finding(shift, laid, usual);
  }
}

void MotionVerdict::begin_session(const SightingHistory& history, const std::vector<Suspect>& suspects) {
  ++session_;
  touched_.clear();
  for (const Suspect& suspect : suspects) shift_of(suspect.landmark).suspect = true;
  const auto& newest = history.frame(history.frames() - 1);
  witness_step_ = static_cast<std::uint32_t>((newest.size() + kMostWitnesses - 1) / kMostWitnesses);
  for (const SightingHistory::Sighting& sighting : newest) {
    if (!history.is_forgotten(sighting.landmark) && is_asked(sighting.landmark)) shift_of(sighting.landmark);
  }
}

/// Suspects, and of the others the same few in all frames, whatever is numbered beside them.
bool MotionVerdict::is_asked(Index landmark) const {
  if (witness_step_ <= 1) return true;
  constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15u;
  if (((landmark * kOdd) >> 32) % witness_step_ == 0) return true;
  return landmark < shifts_.size() && shifts_[landmark].session == session_ && shifts_[landmark].suspect;
}

MotionVerdict::Shift& MotionVerdict::shift_of(Index landmark) {
  if (landmark >= shifts_.size()) {
    shifts_.resize(landmark + 1);
    stamped_.resize(landmark + 1, 0);
    later_point_.resize(landmark + 1, Vec3::Zero());
  }
  Shift& shift = shifts_[landmark];
  if (shift.session != session_) {
    shift = Shift();
    shift.session = session_;
    touched_.push_back(landmark);
  }
  return shift;
}

void MotionVerdict::find_common(const SightingHistory& history, std::uint64_t earlier, std::uint64_t later) {
  ++stamp_;
  for (const SightingHistory::Sighting& sighting : history.frame(later)) {
    if (history.is_forgotten(sighting.landmark) || !is_asked(sighting.landmark)) continue;
    shift_of(sighting.landmark);
    stamped_[sighting.landmark] = stamp_;
    later_point_[sighting.landmark] = sighting.point;
  }
  common_.clear();
  for (const SightingHistory::Sighting& sighting : history.frame(earlier)) {
    const Index l = sighting.landmark;
    if (l < stamped_.size() && stamped_[l] == stamp_)
      common_.push_back({l, sighting.point, later_point_[l], sighting.weight});
  }
}

bool MotionVerdict::fit(const Pose& guess, Pose& T_earlier_later) {
  pairs_.clear();
  for (const Common& common : common_) {
    if (!shifts_[common.landmark].suspect) pairs_.push_back({common.earlier, common.later, common.weight});
  }
  T_earlier_later = guess;
  const double kept = static_cast<double>(pairs_.size());
  if (pairs_.size() >= kLeastCommon && kept >= kFewSuspects * static_cast<double>(common_.size()))
    return robust_fit(pairs_, rules_, T_earlier_later);
  // Where many are suspected, those that are not may be the ones that move.
  pairs_.clear();
  for (const Common& common : common_) pairs_.push_back({common.earlier, common.later, common.weight});
  if (pairs_.size() < kLeastCommon) return false;
  const std::size_t agreeing = consensus_.fit(pairs_, rules_, T_earlier_later);
  return 2 * agreeing > pairs_.size();
}

bool MotionVerdict::add_pair(const SightingHistory& history, std::uint64_t earlier, std::uint64_t later) {
  if (!history.holds(earlier)) return false;
  find_common(history, earlier, later);
  const Pose& T_map_earlier = history.pose(earlier);
  Pose T;
  if (!fit(T_map_earlier.inverse() * history.pose(later), T)) return false;
  const Mat3 rotation = T.q.toRotationMatrix();
  const Mat3 to_map = T_map_earlier.q.toRotationMatrix();
  for (const Common& common : common_) {
    const Vec3 way = std::sqrt(common.weight) * to_map * (rotation * common.later + T.t - common.earlier);
    Shift& shift = shifts_[common.landmark];
    shift.sum += way;
    shift.squares += way.squaredNorm();
    ++shift.count;
  }
  return true;
}

/// The variance of one coordinate of a landmark's mean shift, as most landmarks have it; at least what the noise makes.
double MotionVerdict::usual_variance(int pairs) {
  lengths2_.clear();
  for (const Index landmark : touched_) {
    const Shift& shift = shifts_[landmark];
    if (!shift.suspect && shift.count == pairs)
      lengths2_.push_back((shift.sum / static_cast<double>(shift.count)).squaredNorm());
  }
  const double least = 2.0 * noise_m_ * noise_m_ / static_cast<double>(pairs);
  if (lengths2_.size() < kLeastCommon) return least;
  return std::max(least, median(lengths2_) / kMedianChi3);
}

MotionVerdict::Finding MotionVerdict::finding(const Shift& shift, int pairs, double usual) const {
  const int least = (pairs + 1) / 2;
  if (shift.count < least) return Finding::open;
  const double n = static_cast<double>(shift.count);
  const Vec3 mean = shift.sum / n;
  double variance = usual * static_cast<double>(pairs) / n;
  if (shift.count > 2) {
    const double own = (shift.squares - n * mean.squaredNorm()) / (3.0 * (n - 1.0)) / n;
    variance = std::max(variance, own);
  }
  return mean.squaredNorm() > kMovedDeviations2 * variance ? Finding::moves : Finding::stands;
}

}  // namespace hallway::slam_point
