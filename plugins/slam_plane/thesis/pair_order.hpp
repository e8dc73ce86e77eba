// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "slam_plane/thesis/comparison.hpp"
#include "slam_plane/thesis/pair_comparer.hpp"

namespace hallway::slam_plane::thesis {

/// One comparison of a submap: member `child` is placed relative to member `parent`. Indices into the submap's members.
struct PairEdge {
  int parent = 0;
  int child = 0;
  bool operator==(const PairEdge&) const = default;
};

/// Weight of a pair: the iterations it was compared over; for parallel planes 0.95 of that, so that others are preferred; without key points next to nothing, so that it is
/// used only where nothing else connects a member (Rules 15, 30); 0 if it is not valid.
double pair_weight(const Comparison& comparison);

/// The order of comparisons of a submap with n members: a spanning tree with the greatest sum of weights (Rule 30), rooted in member 0, each parent before its children. A pair's weight is asked
/// for only when it can matter: `bound(a, b)` must be at least weight(a, b). Members that nothing connects to member 0 are left out. Ties go to the smaller indices.
/// Exact (Kruskal). O(n^2 log n) bounds, few weights.
std::vector<PairEdge> maximum_spanning_tree(int n, const std::function<double(int, int)>& bound,
                                            const std::function<double(int, int)>& weight);

/// The same where the weight of a pair is the overlap of two intervals, one for each member: sorted by when they start, each is paired with the one before it that lasts longest (thesis 5.3 item 3).
/// Exact; O(n log n). It is the first order of a submap's comparisons, before anything is compared.
std::vector<PairEdge> interval_spanning_tree(std::span<const Interval> visible);

/// Rule 30 for the members of a submap: maximum_spanning_tree with pair_weight. The comparisons that were made are kept by the comparer.
std::vector<PairEdge> order_comparisons(PairComparer& comparer, std::span<const Track* const> members);

/// Compares along the edges and chains the results (Rules 2, 28): each member in the frame of member 0, not valid where it could not be placed.
std::vector<Placement> place_members(PairComparer& comparer, std::span<const Track* const> members,
                                     std::span<const PairEdge> edges);

}  // namespace hallway::slam_plane::thesis
