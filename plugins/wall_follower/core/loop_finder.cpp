// SPDX-License-Identifier: MIT
#include "wall_follower/core/loop_finder.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace hallway::wall_follower {
namespace {

constexpr int kWholeTurn = 4;
constexpr std::size_t kMostSkipped = 3;  // landmarks of one lap between two pairs
constexpr double kLeastScore = 0.2;      // of a pair, or its alignment ends
constexpr int kLeastPairs = 5;

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

bool LoopFinder::leads_back(const Node& first, const Node& again, double times) const {
  const double lap = again.way_m - first.way_m;
  return (again.at - first.at).norm() <= times * (options_.drift_m + options_.drift_per_m * lap);
}

LoopFinder::Cell LoopFinder::cell_of(const std::vector<Node>& nodes, std::size_t first,
                                     std::size_t again) const {
  Cell cell;
  if (std::abs(nodes[again].quarter - nodes[first].quarter) != kWholeTurn) return cell;
  if (nodes[again].way_m - nodes[first].way_m < options_.least_lap_m) return cell;
  const std::optional<double> differs = difference(nodes[first], nodes[again]);
  if (!differs) return cell;
  const double own = worth(nodes[first]) - *differs;
  double best = 0.0;
  double missing_again = 0.0;
  for (std::size_t j = 1; j <= std::min(kMostSkipped + 1, again); ++j) {
    double missing = missing_again;
    for (std::size_t i = 1; i <= std::min(kMostSkipped + 1, first); ++i) {
      const std::vector<Cell>& row = rows_[again - j];
      const std::size_t a = first - i, b = again - j;
      if (a < row.size() && row[a].score > 0.0F &&
          nodes[b].quarter - nodes[a].quarter == nodes[again].quarter - nodes[first].quarter) {
        const std::optional<double> way = way_difference(nodes[a], nodes[first], nodes[b], nodes[again]);
        const double before = way ? static_cast<double>(row[a].score) - *way - missing : 0.0;
        if (before > best) {
          best = before;
          cell.first_back = static_cast<std::int8_t>(i);
          cell.again_back = static_cast<std::int8_t>(j);
          cell.length = row[a].length;
        }
      }
      missing += cost_of_missing(nodes[first - i]);
    }
    missing_again += cost_of_missing(nodes[again - j]);
  }
  cell.score = static_cast<float>(best + own);
  if (static_cast<double>(cell.score) < kLeastScore) return {};
  ++cell.length;
  return cell;
}

bool LoopFinder::turns_between(const std::vector<Node>& nodes, std::size_t first, std::size_t again) const {
  const int quarter = nodes[again].quarter;
  for (;;) {
    const Cell& cell = rows_[again][first];
    if (nodes[again].quarter != quarter) return true;
    if (cell.again_back == 0) return false;
    first -= static_cast<std::size_t>(cell.first_back);
    again -= static_cast<std::size_t>(cell.again_back);
  }
}

LoopVerdict LoopFinder::add(const Chart& chart) {
  const std::vector<Node>& nodes = chart.nodes;
  const std::size_t again = nodes.size() - 1;
  std::vector<Cell> row(again);
  for (std::size_t first = 0; first < again; ++first) row[first] = cell_of(nodes, first, again);
  rows_.push_back(std::move(row));

  LoopVerdict verdict;
  std::optional<std::size_t> best;
  for (std::size_t first = 0; first < again; ++first) {
    const double score = static_cast<double>(rows_[again][first].score);
    if (score <= verdict.score || !leads_back(nodes[first], nodes[again], 1.0)) continue;
    verdict.score = score;
    best = first;
  }
  if (!best) return verdict;
  for (std::size_t first = 0; first < again; ++first) {
    if (first != *best && leads_back(nodes[first], nodes[again], 3.0))
      verdict.other = std::max(verdict.other, static_cast<double>(rows_[again][first].score));
  }
  if (verdict.score < options_.match_score || rows_[again][*best].length < kLeastPairs) return verdict;
  const bool is_alone = verdict.score >= verdict.other + options_.match_margin;
  verdict.loop = is_alone && turns_between(nodes, *best, again) ? Loop::closed : Loop::uncertain;
  if (verdict.loop != Loop::closed) return verdict;
  std::size_t first = *best, second = again;
  for (;;) {
    verdict.same.push_back({first, second});
    const Cell& cell = rows_[second][first];
    if (cell.again_back == 0) break;
    first -= static_cast<std::size_t>(cell.first_back);
    second -= static_cast<std::size_t>(cell.again_back);
  }
  std::reverse(verdict.same.begin(), verdict.same.end());
  return verdict;
}

std::size_t first_sight(const std::vector<SameLandmark>& same, std::size_t node) {
  for (auto pair = same.rbegin(); pair != same.rend(); ++pair) {
    if (pair->again == node) node = pair->first;
  }
  return node;
}

void close_loop(Chart& chart, const std::vector<SameLandmark>& same) {
  const SameLandmark& joint = same.front();
  for (const SameLandmark& pair : same) ++chart.nodes[first_sight(same, pair.again)].visits;
  Edge back = chart.edges[joint.again - 1];  // that led to the first landmark seen again
  back.to = chart.nodes[joint.first].id;
  chart.nodes.resize(joint.again);
  chart.edges.resize(joint.again - 1);
  chart.edges.push_back(back);
  ++chart.changes;
}

}  // namespace hallway::wall_follower
