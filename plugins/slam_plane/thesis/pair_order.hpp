// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "slam_plane/thesis/comparison.hpp"
#include "slam_plane/thesis/reference.hpp"

namespace hallway::slam_plane::thesis {

/// One comparison of a submap's order: it places member `child` relative to member `parent`, or tells one more end of it. Indices into the submap's members.
struct PlaceStep {
  std::size_t parent = 0;
  std::size_t child = 0;
  KeyPoint key[2] = {KeyPoint::none, KeyPoint::none};  ///< the ends that are compared: parent's, child's
  bool operator==(const PlaceStep&) const = default;
};

/// A comparison that can be a step.
struct PlaceOffer {
  PlaceStep step;
  double worth = 0.0;
};

/// What a comparison is worth, whichever way round: the iterations it was made over; of parallel planes 0.95 of that, so that others are preferred (Rules 15, 30). One that tells a line alone is worth next to nothing, so
/// that it is used only where nothing else places a member.
double worth(const Comparison& comparison);

/// Appends what a comparison can place: the child from the parent, and the parent from the child, each if the end that it starts from is told.
void append_offers(const PlaceStep& there, double worth, std::vector<PlaceOffer>& offers);

/// Sorts offers, those worth most first; equal ones stay in their order.
void sort_offers(std::vector<PlaceOffer>& offers);

/// Places the child of a comparison in the parent's frame, or adds to what is known of it (Rule 28). @returns whether it told anything new.
bool take_offer(Reference& parent, const Comparison& comparison, Reference& child);

/// Sorted offers, by the ends that they need to be known. Which offer tells something depends on nothing but the ends that are known, so nothing is placed here. The offers have to outlive it.
class OfferGraph {
 public:
  OfferGraph(std::span<const PlaceOffer> offers, std::size_t members);

  /// The members that spanning_steps places from a root, by member. O(offers). Good until the next call.
  const std::vector<bool>& placed_from(std::size_t root);

  /// Which comparisons place the members of a submap (Rule 30): from the root outwards, always the one worth most of those that place another member or tell another end, given ends that
  /// are known already (Prim's algorithm). Where each comparison knows the ends that it needs it is a maximum spanning tree, and steps that tell further ends.
  /// The first step places the root too, with the end that it needs. O(offers), and a look at each 64 offers for each step.
  std::vector<PlaceStep> spanning_steps(std::size_t root) const;

 private:
  struct Edge {
    std::size_t offer;
    std::size_t child;  // a member
    std::size_t end;    // 2 * member + end that becomes known with it; kNoEnd: its line alone is told
  };

  static constexpr std::size_t kNoEnd = ~std::size_t{0};

  /// The end of the child that becomes known with a step.
  static std::size_t end_told(const PlaceStep& step);

  std::span<const PlaceOffer> offers_;
  std::vector<std::size_t> begin_;  // by 2 * parent + end, in edges_
  std::vector<Edge> edges_;
  std::vector<std::size_t> first_end_;  // by root: of its offer worth most; kNoEnd if it has none
  std::vector<bool> placed_;
  std::vector<bool> known_;        // by 2 * member + end
  std::vector<std::size_t> open_;  // ends whose edges were not followed yet
};

}  // namespace hallway::slam_plane::thesis
