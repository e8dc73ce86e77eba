// SPDX-License-Identifier: MIT
#include "wall_follower/core/loop_finder.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace hallway::wall_follower {
namespace {

constexpr std::size_t kMostSkipped = 3;  // landmarks of one lap between two pairs
constexpr double kLeastScore = 0.2;      // of a pair, or its alignment ends
constexpr std::size_t kLeastPairs = 5;
constexpr double kStrong = 10.0;    // a score from which on a known wall may be far from where it is expected
constexpr double kFarMargin = 4.0;  // that the next best place is below it then
constexpr double kCrossingError = 2.0;  // [m]
constexpr double kWide = 3.0;           // how many times as far off it may be then

/// What a landmark adds to the score where it matches exactly.
double worth(const Node& node) {
  return node.kind == Kind::discontinuity && node.size_m < 0.2 ? 0.8 : 1.0;
}

/// What it takes from the score that only one lap has this landmark. Small steps are missed, or seen where there are none, more than others.
double cost_of_missing(const Node& node) {
  if (node.kind != Kind::discontinuity) return 1.2;
  return std::isfinite(node.size_m) ? 0.3 + node.size_m : 0.8;
}

bool is_opening(Kind kind) {
  return kind == Kind::sweep || kind == Kind::room || kind == Kind::junction;
}

/// What of two landmarks differs; nothing where they cannot be one.
std::optional<double> difference(const Node& a, const Node& b) {
  if (a.kind != b.kind) return is_opening(a.kind) && is_opening(b.kind) ? std::optional(1.5) : std::nullopt;
  if (a.kind != Kind::discontinuity) return 0.0;
  if (a.direction != b.direction) return std::nullopt;
  if (std::isfinite(a.size_m) && std::isfinite(b.size_m))
    return std::min(1.5, std::abs(a.size_m - b.size_m) / 0.15);
  if (std::isfinite(a.size_m) || std::isfinite(b.size_m))
    return std::min(a.size_m, b.size_m) > 0.2 ? 0.8 : 1.5;
  return 0.0;
}

/// The way between two landmarks, as it is from the wall at the first one.
Vec2 way_between(const Node& from, const Node& to) {
  return turned(to.at - from.at, -from.quarter * kQuarter);
}

/// What of two ways differs; nothing where they cannot be one.
std::optional<double> way_difference(const Node& a, const Node& to_a, const Node& b, const Node& to_b) {
  const Vec2 way = way_between(a, to_a);
  const double sigma = 0.12 + 0.05 * way.norm();
  const double off = (way - way_between(b, to_b)).norm() / sigma;
  if (off > 3.0) return std::nullopt;
  return 0.12 * off * off;
}

}  // namespace

void LoopFinder::begin(const Chart& chart) {
  places_.clear();
  rows_.clear();
  for (std::size_t circuit = 0; circuit < chart.circuits.size(); ++circuit) {
    const std::vector<std::uint32_t>& lap = chart.circuits[circuit].lap;
    for (std::size_t i = 0; i < 2 * lap.size(); ++i)
      places_.push_back({chart.node(lap[i % lap.size()]), circuit, i % lap.size()});
  }
  known_ = places_.size();
}

void LoopFinder::forget(std::size_t from) {
  rows_.resize(from);
  places_.resize(known_ + from);
}

bool LoopFinder::leads_back(const Place& first, const Node& again, bool is_strong) const {
  if (first.circuit && (again.quarter - first.node.quarter) % kWholeTurn != 0) return is_strong;
  const double way = again.way_m - (first.circuit ? seen(0) : first.node).way_m;
  // Where a crossing meets a wall is less certain than the way along it.
  const double more = first.circuit && is_strong ? kCrossingError : 0.0;
  const double drift = options_.drift_m + options_.drift_per_m * way;
  return (again.at - first.node.at).norm() <= more + (is_strong ? kWide : 1.0) * drift;
}

bool LoopFinder::may_be_one(const Place& first, const Node& again) const {
  if (first.circuit) return true;
  // A room whose lap was not taken back adds a whole turn.
  const int turns = again.quarter - first.node.quarter;
  return turns != 0 && turns % kWholeTurn == 0 && again.way_m - first.node.way_m >= options_.least_lap_m;
}

/// Whether the landmarks of two pairs are turned by the same angle: of a known wall, less whole turns.
bool LoopFinder::is_turned_alike(const Place& a, const Node& again_a, const Place& b, const Node& again_b) {
  const int differs = (again_a.quarter - a.node.quarter) - (again_b.quarter - b.node.quarter);
  return b.circuit ? differs % kWholeTurn == 0 : differs == 0;
}

LoopFinder::Cell LoopFinder::cell_of(std::size_t first, std::size_t again) const {
  Cell cell;
  const Place& place = places_[first];
  const Node& node = seen(again);
  if (!may_be_one(place, node)) return cell;
  const std::optional<double> differs = difference(place.node, node);
  if (!differs) return cell;
  const double own = worth(place.node) - *differs;
  double best = 0.0;
  double missing_again = 0.0;
  for (std::size_t j = 1; j <= std::min(kMostSkipped + 1, again); ++j) {
    double missing = missing_again;
    const std::vector<Cell>& row = rows_[again - j];
    for (std::size_t i = 1; i <= std::min(kMostSkipped + 1, first); ++i) {
      const std::size_t a = first - i;
      if (places_[a].circuit != place.circuit) break;
      const Node& before = seen(again - j);
      if (a < row.size() && row[a].score > 0.0F && is_turned_alike(places_[a], before, place, node)) {
        const std::optional<double> way = way_difference(places_[a].node, place.node, before, node);
        const double score = way ? static_cast<double>(row[a].score) - *way - missing : 0.0;
        if (score > best) {
          best = score;
          cell.first_back = static_cast<std::int8_t>(i);
          cell.again_back = static_cast<std::int8_t>(j);
          cell.length = row[a].length;
        }
      }
      missing += cost_of_missing(places_[a].node);
    }
    missing_again += cost_of_missing(seen(again - j));
  }
  cell.score = static_cast<float>(best + own);
  if (static_cast<double>(cell.score) < kLeastScore) return {};
  ++cell.length;
  return cell;
}

LoopVerdict LoopFinder::add(const Node& node) {
  const std::size_t again = rows_.size(), firsts = places_.size();
  places_.push_back({node, std::nullopt, again});
  std::vector<Cell> row(firsts);
  for (std::size_t first = 0; first < firsts; ++first) row[first] = cell_of(first, again);
  rows_.push_back(std::move(row));

  LoopVerdict verdict;
  std::optional<std::size_t> best;
  for (std::size_t first = 0; first < firsts; ++first) {
    const double score = static_cast<double>(rows_[again][first].score);
    const bool is_strong = places_[first].circuit && score >= kStrong;
    if (score <= verdict.score || !leads_back(places_[first], node, is_strong)) continue;
    verdict.score = score;
    best = first;
  }
  if (!best) return verdict;
  Alignment alignment = trusted(*best, again);
  verdict.score = alignment.score;
  verdict.other = alignment.other;
  if (verdict.score < options_.match_score || alignment.same.size() < kLeastPairs) return verdict;
  const Place& place = places_[*best];
  const bool is_far = !leads_back(place, node, false);
  const bool is_alone = verdict.score >= verdict.other + (is_far ? kFarMargin : options_.match_margin);
  const bool is_certain = is_far || alignment.turns;
  verdict.loop = is_alone && is_certain ? Loop::closed : Loop::uncertain;
  if (verdict.loop != Loop::closed) return verdict;
  verdict.circuit = place.circuit;
  verdict.same = std::move(alignment.same);
  return verdict;
}

double LoopFinder::best_beside(std::size_t first, std::size_t again, bool is_strong) const {
  const Place& place = places_[first];
  const std::vector<Cell>& row = rows_[again];
  double best = 0.0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    // An earlier lap of a wall that is a known one says nothing against that.
    if (is_strong && place.circuit && !places_[i].circuit) continue;
    const bool is_it = places_[i].circuit == place.circuit && places_[i].index == place.index;
    if (!is_it && leads_back(places_[i], seen(again), true))
      best = std::max(best, static_cast<double>(row[i].score));
  }
  return best;
}

LoopFinder::Alignment LoopFinder::trusted(std::size_t first, std::size_t again) const {
  Alignment alignment;
  const double all = static_cast<double>(rows_[again][first].score);
  const int quarter = seen(again).quarter;
  for (;;) {
    const Cell& cell = rows_[again][first];
    const double score = static_cast<double>(cell.score), other = best_beside(first, again, all >= kStrong);
    if (other > score + options_.match_margin && !alignment.same.empty()) break;
    alignment.same.push_back({places_[first].index, again});
    alignment.other = std::max(alignment.other, other);
    alignment.score =
        all - score + worth(places_[first].node) - *difference(places_[first].node, seen(again));
    if (seen(again).quarter != quarter) alignment.turns = true;
    if (cell.again_back == 0) break;
    first -= static_cast<std::size_t>(cell.first_back);
    again -= static_cast<std::size_t>(cell.again_back);
  }
  std::reverse(alignment.same.begin(), alignment.same.end());
  return alignment;
}

std::vector<SameLandmark> LoopFinder::pairs_of(std::size_t first, std::size_t again) const {
  std::vector<SameLandmark> same;
  for (;;) {
    same.push_back({places_[first].index, again});
    const Cell& cell = rows_[again][first];
    if (cell.again_back == 0) break;
    first -= static_cast<std::size_t>(cell.first_back);
    again -= static_cast<std::size_t>(cell.again_back);
  }
  std::reverse(same.begin(), same.end());
  return same;
}

std::vector<SameLandmark> LoopFinder::best_with(std::size_t circuit) const {
  double least_score = options_.match_score;
  std::optional<SameLandmark> best;
  for (std::size_t again = 0; again < rows_.size(); ++again) {
    for (std::size_t first = 0; first < known_; ++first) {
      const double score = static_cast<double>(rows_[again][first].score);
      if (places_[first].circuit != circuit || score < least_score) continue;
      if (rows_[again][first].length < static_cast<int>(kLeastPairs) ||
          !leads_back(places_[first], seen(again), true))
        continue;
      least_score = score;
      best = SameLandmark{first, again};
    }
  }
  return best ? pairs_of(best->first, best->again) : std::vector<SameLandmark>();
}

}  // namespace hallway::wall_follower
