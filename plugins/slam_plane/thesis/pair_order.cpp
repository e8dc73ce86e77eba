// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/pair_order.hpp"

#include <algorithm>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>

#include "slam_plane/thesis/resize.hpp"

namespace hallway::slam_plane::thesis {
namespace {

constexpr double kParallelWorth = 0.95;  // so the sum is never below 0.95 of the greatest possible one
constexpr double kKeylessWorth = 1e-6;   // less than one iteration, however many there are

/// Disjoint sets of members.
class Components {
 public:
  explicit Components(int n) : parent_(static_cast<std::size_t>(n)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  int find(int i) {
    while (at(i) != i) {
      at(i) = at(at(i));
      i = at(i);
    }
    return i;
  }

  /// False if they were joined already.
  bool join(int a, int b) {
    const int ra = find(a), rb = find(b);
    if (ra == rb) return false;
    at(std::max(ra, rb)) = std::min(ra, rb);
    return true;
  }

 private:
  int& at(int i) { return parent_[static_cast<std::size_t>(i)]; }
  std::vector<int> parent_;
};

/// A pair with what it is worth, or what it is worth at most.
struct Offer {
  double worth;
  int a, b;
  bool exact;

  bool operator<(const Offer& other) const {  // the best one is the greatest
    return std::make_tuple(worth, -a, -b) < std::make_tuple(other.worth, -other.a, -other.b);
  }
};

/// Edges from member 0 outwards.
std::vector<PairEdge> rooted(int n, const std::vector<std::pair<int, int>>& pairs) {
  std::vector<std::vector<int>> neighbours(static_cast<std::size_t>(n));
  for (const auto& [a, b] : pairs) {
    neighbours[static_cast<std::size_t>(a)].push_back(b);
    neighbours[static_cast<std::size_t>(b)].push_back(a);
  }
  std::vector<bool> reached(static_cast<std::size_t>(n), false);
  std::vector<int> order;
  std::vector<PairEdge> edges;
  if (n == 0) return edges;
  order.push_back(0);
  reached[0] = true;
  for (std::size_t i = 0; i < order.size(); ++i) {
    std::vector<int>& next = neighbours[static_cast<std::size_t>(order[i])];
    std::sort(next.begin(), next.end());
    for (const int child : next) {
      if (reached[static_cast<std::size_t>(child)]) continue;
      reached[static_cast<std::size_t>(child)] = true;
      edges.push_back({order[i], child});
      order.push_back(child);
    }
  }
  return edges;
}

}  // namespace

double pair_weight(const Comparison& comparison) {
  if (!comparison.valid) return 0.0;
  if (!comparison.has_keys()) return kKeylessWorth * comparison.shared;
  return (comparison.parallel ? kParallelWorth : 1.0) * comparison.shared;
}

std::vector<PairEdge> maximum_spanning_tree(int n, const std::function<double(int, int)>& bound,
                                            const std::function<double(int, int)>& weight) {
  std::vector<Offer> bounds;
  for (int a = 0; a < n; ++a) {
    for (int b = a + 1; b < n; ++b) {
      if (const double most = bound(a, b); most > 0.0) bounds.push_back({most, a, b, false});
    }
  }
  std::priority_queue<Offer> offers({}, std::move(bounds));
  Components components(n);
  std::vector<std::pair<int, int>> pairs;
  while (!offers.empty() && static_cast<int>(pairs.size()) < n - 1) {
    Offer offer = offers.top();
    offers.pop();
    if (components.find(offer.a) == components.find(offer.b)) continue;
    if (!offer.exact) {
      offer.exact = true;
      offer.worth = weight(offer.a, offer.b);
      if (offer.worth > 0.0) offers.push(offer);
    } else if (components.join(offer.a, offer.b)) {
      pairs.emplace_back(offer.a, offer.b);
    }
  }
  return rooted(n, pairs);
}

std::vector<PairEdge> interval_spanning_tree(std::span<const Interval> visible) {
  std::vector<int> by_start(visible.size());
  std::iota(by_start.begin(), by_start.end(), 0);
  const auto of = [&](int i) { return visible[static_cast<std::size_t>(i)]; };
  std::sort(by_start.begin(), by_start.end(),
            [&](int a, int b) { return std::make_pair(of(a).first, a) < std::make_pair(of(b).first, b); });
  std::vector<std::pair<int, int>> pairs;
  int lasting = -1;  // of those before, the one that lasts longest
  for (const int member : by_start) {
    if (of(member).empty()) continue;
    if (lasting >= 0 && !intersection(of(lasting), of(member)).empty()) pairs.emplace_back(lasting, member);
    if (lasting < 0 || of(member).last > of(lasting).last) lasting = member;
  }
  return rooted(static_cast<int>(visible.size()), pairs);
}

std::vector<PairEdge> order_comparisons(PairComparer& comparer, std::span<const Track* const> members) {
  std::vector<Intervals> visible;
  for (const Track* member : members) visible.push_back(member->visible());
  const auto bound = [&](int a, int b) {
    const Intervals both =
        intersection(visible[static_cast<std::size_t>(a)], visible[static_cast<std::size_t>(b)]);
    return static_cast<double>(longest(both).size());
  };
  const auto weight = [&](int a, int b) {
    return pair_weight(
        comparer.compare(*members[static_cast<std::size_t>(a)], *members[static_cast<std::size_t>(b)]));
  };
  return maximum_spanning_tree(static_cast<int>(members.size()), bound, weight);
}

std::vector<Placement> place_members(PairComparer& comparer, std::span<const Track* const> members,
                                     std::span<const PairEdge> edges) {
  std::vector<Placement> placements(members.size());
  const double tolerance = comparer.options().similar_size_m;
  for (const PairEdge& edge : edges) {
    const auto parent = static_cast<std::size_t>(edge.parent);
    const auto child = static_cast<std::size_t>(edge.child);
    const Comparison comparison = comparer.compare(*members[parent], *members[child]);
    if (parent == 0 && !placements[0].valid) placements[0] = comparison.placement(0);
    placements[child] = chained(placements[parent], comparison, tolerance);
  }
  return placements;
}

}  // namespace hallway::slam_plane::thesis
