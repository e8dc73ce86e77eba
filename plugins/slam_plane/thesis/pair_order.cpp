// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/pair_order.hpp"

#include <algorithm>

namespace hallway::slam_plane::thesis {
namespace {

constexpr double kLineWorth = 1e-6;      // less than one iteration, however many there are
constexpr double kParallelWorth = 0.95;  // so the sum is never below 0.95 of the greatest possible one

}  // namespace

double worth(const Comparison& comparison) {
  if (!comparison.places()) return 0.0;
  if (!comparison.has_keys()) return kLineWorth * comparison.shared;
  return (comparison.parallel ? kParallelWorth : 1.0) * comparison.shared;
}

void sort_offers(std::vector<PlaceOffer>& offers) {
  std::stable_sort(offers.begin(), offers.end(), [](const PlaceOffer& a, const PlaceOffer& b) {
    return worth(a.comparison) > worth(b.comparison);
  });
}

bool take_offer(Reference& parent, const Comparison& comparison, Reference& child) {
  Reference seen = chained(parent, comparison);
  if (!seen.valid()) return false;
  if (!child.valid()) {
    child = seen;
    return true;
  }
  const bool tells = (seen.known[0] && !child.known[0]) || (seen.known[1] && !child.known[1]);
  if (tells) grow(child, seen);
  return tells;
}

std::vector<PlaceStep> spanning_steps(std::size_t root, std::span<const PlaceOffer> offers,
                                      std::span<Reference> references) {
  std::vector<PlaceStep> steps;
  for (std::size_t i = 0; i < offers.size();) {
    const PlaceOffer& offer = offers[i++];
    Reference& parent = references[offer.step.parent];
    Reference& child = references[offer.step.child];
    if (steps.empty() && offer.step.parent == root) parent = reference_of(offer.comparison, 0);
    if (!parent.valid() || child.full() || !take_offer(parent, offer.comparison, child)) continue;
    steps.push_back(offer.step);
    i = 0;  // what was not possible before may be now
  }
  return steps;
}

}  // namespace hallway::slam_plane::thesis
