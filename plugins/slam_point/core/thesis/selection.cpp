// SPDX-License-Identifier: MIT
#include "slam_point/core/thesis/selection.hpp"

#include <algorithm>
#include <bit>
#include <tuple>
#include <utility>

namespace hallway::slam_point::thesis {
namespace {

/// A fixed order of points that has nothing to do with when they were first seen.
std::uint32_t mixed(Index point) {
  std::uint64_t h = (point + 1) * 0x9e3779b97f4a7c15u;
  h = (h ^ (h >> 29)) * 0xbf58476d1ce4e5b9u;
  return static_cast<std::uint32_t>(h >> 32);
}

bool is_seen_more(std::size_t count_a, Index a, std::size_t count_b, Index b) {
  return std::tuple(count_b, mixed(a), a) < std::tuple(count_a, mixed(b), b);
}

void keep_at_least(std::vector<Candidate>& candidates, std::size_t threshold) {
  std::erase_if(candidates, [&](const Candidate& candidate) { return candidate.count < threshold; });
}

/// A candidate of either list, by how often it was seen.
struct Ranked {
  std::size_t count;
  bool is_previous;
  const PresentPoint* candidate;
};

void rank(const std::vector<PresentPoint>& points, bool is_previous, std::vector<Ranked>& ranking) {
  for (const PresentPoint& point : points) ranking.push_back({point.presence.count(), is_previous, &point});
}

}  // namespace

void sort_most_seen_first(std::vector<Candidate>& candidates) {
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return is_seen_more(a.count, a.point, b.count, b.point);
  });
}

bool select_by_constants(std::vector<Candidate> previous, std::vector<Candidate> next,
                         const Constants& constants, bool first, Selection& selection) {
  keep_at_least(previous, constants.threshold);
  keep_at_least(next, constants.threshold);
  if (previous.size() < constants.previous_min && !first) return false;
  if (next.size() < constants.next_min || previous.size() + next.size() < 3) return false;
  sort_most_seen_first(previous);
  sort_most_seen_first(next);
  if (previous.size() > constants.previous_max) previous.resize(constants.previous_max);
  selection = {};
  for (const Candidate& candidate : previous) selection.points.push_back(candidate.point);
  for (const Candidate& candidate : next) selection.points.push_back(candidate.point);
  selection.previous = previous.size();
  return true;
}

std::size_t Presence::count() const {
  std::size_t sum = 0;
  for (const std::uint64_t word : words_) sum += static_cast<std::size_t>(std::popcount(word));
  return sum;
}

std::size_t Presence::count_with(const Presence& other) const {
  std::size_t sum = 0;
  for (std::size_t w = 0; w < words_.size(); ++w)
    sum += static_cast<std::size_t>(std::popcount(words_[w] & other.words_[w]));
  return sum;
}

void Presence::keep(const Presence& other) {
  for (std::size_t w = 0; w < words_.size(); ++w) words_[w] &= other.words_[w];
}

bool select_by_total(const PresentPoint& creation, std::vector<PresentPoint> previous,
                     std::vector<PresentPoint> next, bool first, Selection& selection) {
  std::vector<Ranked> ranking;
  rank(previous, true, ranking);
  rank(next, false, ranking);
  std::sort(ranking.begin(), ranking.end(), [](const Ranked& a, const Ranked& b) {
    if (a.is_previous != b.is_previous) return a.is_previous;
    return is_seen_more(a.count, a.candidate->point, b.count, b.candidate->point);
  });
  Presence together = creation.presence;
  std::vector<Index> mapped;
  std::vector<Index> unmapped{creation.point};
  const auto join = [&](const Ranked& ranked) {
    together.keep(ranked.candidate->presence);
    (ranked.is_previous ? mapped : unmapped).push_back(ranked.candidate->point);
  };
  std::size_t core = 0;
  std::vector<Ranked> others;
  for (const Ranked& ranked : ranking) {
    if (core < 3 && (ranked.is_previous || first)) {
      join(ranked);
      ++core;
    } else {
      others.push_back(ranked);
    }
  }
  std::size_t total = together.count() * (core + 1);
  if (core < 3 || total == 0) return false;
  for (const Ranked& ranked : others) {
    const std::size_t members = mapped.size() + unmapped.size() + 1;
    const std::size_t with = together.count_with(ranked.candidate->presence) * members;
    if (with <= total) continue;
    total = with;
    join(ranked);
  }
  selection.previous = mapped.size();
  selection.points = std::move(mapped);
  selection.points.insert(selection.points.end(), unmapped.begin(), unmapped.end());
  return true;
}

}  // namespace hallway::slam_point::thesis
