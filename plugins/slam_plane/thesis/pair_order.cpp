// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/pair_order.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

namespace hallway::slam_plane::thesis {
namespace {

constexpr double kLineWorth = 1e-6;      // less than one iteration, however many there are
constexpr double kParallelWorth = 0.95;  // so the sum is never below 0.95 of the greatest possible one

using EarliestFirst = std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>>;

/// Indices of offers, by their parents.
class OffersOfParents {
 public:
  OffersOfParents(std::span<const PlaceOffer> offers, std::size_t members)
      : begin_(members + 1, 0), offers_(offers.size()) {
    for (const PlaceOffer& offer : offers) ++begin_[offer.step.parent + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t i = 0; i < offers.size(); ++i) offers_[next[offers[i].step.parent]++] = i;
  }

  void add(std::size_t parent, EarliestFirst& to) const {
    for (std::size_t i = begin_[parent]; i < begin_[parent + 1]; ++i) to.push(offers_[i]);
  }

 private:
  std::vector<std::size_t> begin_;  // by parent, in offers_
  std::vector<std::size_t> offers_;
};

}  // namespace

double worth(const Comparison& comparison) {
  if (!comparison.places()) return 0.0;
  if (!comparison.has_keys()) return kLineWorth * comparison.shared;
  return (comparison.parallel ? kParallelWorth : 1.0) * comparison.shared;
}

void sort_offers(std::vector<PlaceOffer>& offers) {
  std::vector<std::pair<double, std::size_t>> order;  // offers are large: they are moved once
  order.reserve(offers.size());
  for (std::size_t i = 0; i < offers.size(); ++i) order.emplace_back(worth(offers[i].comparison), i);
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<PlaceOffer> sorted;
  sorted.reserve(offers.size());
  for (const auto& [value, i] : order) sorted.push_back(offers[i]);
  offers.swap(sorted);
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
  const OffersOfParents offers_of(offers, references.size());
  std::vector<PlaceStep> steps;
  EarliestFirst open;  // offers of a parent that was placed, or of which another end became known, since they were looked at
  offers_of.add(root, open);
  while (!open.empty()) {
    const PlaceOffer& offer = offers[open.top()];
    open.pop();
    Reference& parent = references[offer.step.parent];
    Reference& child = references[offer.step.child];
    if (steps.empty()) parent = reference_of(offer.comparison, 0);
    if (child.full() || !take_offer(parent, offer.comparison, child)) continue;
    steps.push_back(offer.step);
    offers_of.add(offer.step.child, open);
  }
  return steps;
}

}  // namespace hallway::slam_plane::thesis
