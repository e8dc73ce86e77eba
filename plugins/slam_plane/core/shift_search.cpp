// SPDX-License-Identifier: MIT
#include "slam_plane/core/shift_search.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace hallway::slam_plane {
namespace {

constexpr double kCrossing = 0.3;    // sine of the least angle at which a line crosses the direction
constexpr double kWindow_m = 0.15;   // of votes that agree
constexpr double kRival_m = 0.3;     // from which on a displacement is another one
constexpr double kRivalShare = 0.6;  // of the support that a rival may have
constexpr int kLeastSupport = 3;
constexpr int kMostSupport = 6;  // that is asked for
constexpr int kLeastWalls = 3;
constexpr double kLeastShare = 0.45;  // of the young walls that are to be found among the old ones
constexpr double kWide_m = 2.0;       // range from which on that is asked for; of narrower gaps less
constexpr double kSampleStep_m = 2.0;
constexpr double kDuplicateOverlap = 0.5;
constexpr double kCornerBound_m = 0.15;
constexpr double kDuplicateAngle_rad = 0.03;

/// Agreements that are asked for: the more displacements there are to choose from, the more agree by chance.
int least_support(const Gap& gap) {
  const double choices = 1.0 + 2.0 * gap.range_m / kWindow_m;
  return std::clamp(1 + static_cast<int>(std::ceil(std::log2(choices))), kLeastSupport, kMostSupport);
}

double least_share(const Gap& gap) {
  return kLeastShare * std::min(1.0, gap.range_m / kWide_m);
}

}  // namespace

bool are_duplicates(const WallEstimate& wall, const WallEstimate& other, const Vec2& step, double bound_m,
                    double sine, bool& contradict) {
  const WallBasis& basis = wall.basis;
  if (basis.differs(other.basis.direction, sine)) return false;
  const Vec2 a = other.extent(kEndA) + step;
  const Vec2 b = other.extent(kEndB) + step;
  const double from = std::max(basis.along(a), wall.reach[kEndA]);
  const double to = std::min(basis.along(b), wall.reach[kEndB]);
  const double shorter =
      std::min(other.reach[kEndB] - other.reach[kEndA], wall.reach[kEndB] - wall.reach[kEndA]);
  if (to - from <= kDuplicateOverlap * shorter || to <= from) return false;
  // Where both were seen.
  const Vec2 middle = basis.point(0.5 * (from + to));
  const Vec2 there = other.basis.point(other.basis.along(middle - step)) + step;
  if (std::abs(basis.across(there)) > bound_m) return false;
  for (int k = 0; k < 2; ++k) {
    const double beyond = outward(k) * (basis.along(other.extent(k) + step) - wall.reach[k]);
    const bool off =
        (wall.known[k] && beyond > kCornerBound_m) || (other.known[k] && beyond < -kCornerBound_m);
    if (off) contradict = true;
  }
  return !contradict;
}

ShiftSearch::ShiftSearch(const Options& options)
    : bound_(options.match_bound_m),
      sine_(std::sin(kDuplicateAngle_rad)),
      least_count_(static_cast<std::uint32_t>(options.min_observations)) {}

void ShiftSearch::vote(const WallMap& map, Index young, Index old, const Gap& gap) {
  const WallEstimate& y = map.walls[young].estimate;
  const WallEstimate& o = map.walls[old].estimate;
  const Vec2& d = o.basis.direction;
  if (o.basis.differs(y.basis.direction, sine_)) return;
  const double crossing = cross(d, gap.direction);
  const auto take = [&](double shift, Kind kind) {
    bool contradict = false;
    if (std::abs(shift) > gap.range_m ||
        !are_duplicates(o, y, shift * gap.direction + across_, bound_, sine_, contradict))
      return false;
    votes_.push_back({shift, young, old, kind});
    return true;
  };
  if (std::abs(crossing) > kCrossing) {
    // Where they overlap the angle between them counts least; the middle of the shorter one stands for that.
    const bool short_young = y.reach[kEndB] - y.reach[kEndA] < o.reach[kEndB] - o.reach[kEndA];
    const WallEstimate& shorter = short_young ? y : o;
    const Vec2 middle = shorter.basis.point(0.5 * (shorter.reach[kEndA] + shorter.reach[kEndB]));
    const double offset = short_young ? o.basis.across(middle + across_) : -y.basis.across(middle - across_);
    const double shift = -offset / crossing;
    const bool corners = (y.known[kEndA] && o.known[kEndA]) || (y.known[kEndB] && o.known[kEndB]);
    if (take(shift, Kind::line) && corners)
      take(shift, Kind::corner);  // which agree, or it would not be taken
    return;
  }
  for (int k = 0; k < 2; ++k) {
    if (!y.known[k] || !o.known[k]) continue;
    take((o.end[k] - o.basis.along(y.basis.point(y.end[k]) + across_)) / d.dot(gap.direction), Kind::corner);
  }
}

void ShiftSearch::vote(const WallMap& map, Index young, const Gap& gap) {
  const WallEstimate& y = map.walls[young].estimate;
  seen_.clear();
  const Vec2 a = y.extent(kEndA), b = y.extent(kEndB);
  const int steps = 1 + static_cast<int>((b - a).norm() / kSampleStep_m);
  const int shifts = 1 + static_cast<int>(gap.range_m / kSampleStep_m);
  for (int i = 0; i <= steps; ++i) {
    for (int j = -shifts; j <= shifts; ++j) {
      const Vec2 p = a + (b - a) * (static_cast<double>(i) / steps) +
                     gap.direction * (gap.range_m * static_cast<double>(j) / shifts);
      map.visit_near(p, [&](Index w) {
        const WallRecord& wall = map.walls[w];
        if (wall.epoch >= gap.epoch || wall.count < least_count_ || wall.is_dynamic) return;
        seen_.push_back(w);
      });
    }
  }
  make_set(seen_);
  for (const Index old : seen_) vote(map, young, old, gap);
}

Index ShiftSearch::only_duplicate(const WallMap& map, Index young, const Gap& gap, double& shift) {
  across_.setZero();
  votes_.clear();
  vote(map, young, gap);
  Index duplicate = kNone;
  for (const Vote& v : votes_) {
    if (duplicate != kNone && v.old != duplicate) return kNone;
    duplicate = v.old;
  }
  for (const Vote& v : votes_) {
    if (v.kind != Kind::corner) continue;
    shift = v.shift;
    return duplicate;
  }
  return kNone;
}

/// Of votes next to each other in their order: how many lines and corners of young walls.
int ShiftSearch::support(std::size_t first, std::size_t end) const {
  voters_.clear();
  for (std::size_t i = first; i < end; ++i) voters_.emplace_back(votes_[i].young, votes_[i].kind);
  std::ranges::sort(voters_);
  return static_cast<int>(std::unique(voters_.begin(), voters_.end()) - voters_.begin());
}

int ShiftSearch::rival_support(double shift) const {
  int most = 0;
  for (std::size_t first = 0, end = 0; first < votes_.size(); ++first) {
    if (std::abs(votes_[first].shift - shift) < kRival_m) continue;
    end = std::max(end, first + 1);
    while (end < votes_.size() && votes_[end].shift <= votes_[first].shift + kWindow_m &&
           std::abs(votes_[end].shift - shift) >= kRival_m)
      ++end;
    most = std::max(most, support(first, end));
  }
  return most;
}

bool ShiftSearch::find(const WallMap& map, const std::vector<Index>& young, const Gap& gap, Vec2& step,
                       std::vector<Duplicates>& duplicates) {
  // On the way through a gap some drift across it comes together too.
  for (const double across : {0.0, 1.0, -1.0, 2.0, -2.0}) {
    across_ = across * bound_ * left_of(gap.direction);
    if (find_beside(map, young, gap, step, duplicates)) return true;
  }
  return false;
}

bool ShiftSearch::find_beside(const WallMap& map, const std::vector<Index>& young, const Gap& gap, Vec2& step,
                              std::vector<Duplicates>& duplicates) {
  votes_.clear();
  for (const Index w : young) vote(map, w, gap);
  std::ranges::sort(votes_, [](const Vote& a, const Vote& b) {
    return std::tie(a.shift, a.young, a.old) < std::tie(b.shift, b.young, b.old);
  });
  int most = 0;
  double best = 0.0;
  for (std::size_t first = 0, end = 0; first < votes_.size(); ++first) {
    while (end < votes_.size() && votes_[end].shift <= votes_[first].shift + kWindow_m) ++end;
    const int found = support(first, end);
    if (found <= most) continue;
    most = found;
    best = votes_[first + (end - first) / 2].shift;  // their median
  }
  if (most < least_support(gap) || rival_support(best) > kRivalShare * most) return false;
  step = best * gap.direction + across_;
  duplicates.clear();
  int against = 0;
  for (const Index y : young) {
    seen_.clear();
    for (const Vote& v : votes_) {
      if (v.young == y && std::abs(v.shift - best) <= kWindow_m) seen_.push_back(v.old);
    }
    if (!seen_.empty()) {
      duplicates.push_back({seen_.front(), y});
      continue;
    }
    const WallEstimate& wall = map.walls[y].estimate;
    Index duplicate = kNone;
    bool any_contradicts = false;
    map.visit_near(wall.basis.point(0.5 * (wall.reach[kEndA] + wall.reach[kEndB])) + step, [&](Index w) {
      const WallRecord& other = map.walls[w];
      if (other.epoch >= gap.epoch || other.count < least_count_ || other.is_dynamic) return;
      bool contradict = false;
      if (are_duplicates(map.walls[w].estimate, wall, step, bound_, sine_, contradict))
        duplicate = std::min(duplicate, w);
      any_contradicts = any_contradicts || contradict;
    });
    if (duplicate != kNone) duplicates.push_back({duplicate, y});
    if (duplicate == kNone && any_contradicts) ++against;
  }
  const auto found = static_cast<double>(duplicates.size());
  return found >= kLeastWalls && found >= least_share(gap) * static_cast<double>(young.size()) &&
         2 * against < most;
}

}  // namespace hallway::slam_plane
