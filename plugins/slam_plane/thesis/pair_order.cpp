// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/pair_order.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>

#include <numeric>
#include <optional>
#include <utility>

namespace hallway::slam_plane::thesis {
namespace {

constexpr double kLineWorth = 1e-6;      // less than one iteration, however many there are
constexpr double kParallelWorth = 0.95;  // so the sum is never below 0.95 of the greatest possible one

/// Numbers of which the least is taken first.
class LeastFirst {
 public:
  explicit LeastFirst(std::size_t count) : words_((count + 63) / 64, 0), least_(words_.size()) {}

  void add(std::size_t i) {
    words_[i / 64] |= std::uint64_t{1} << (i % 64);
    least_ = std::min(least_, i / 64);
  }

  /// Takes the least one out; nothing if there is none.
  std::optional<std::size_t> take() {
    while (least_ < words_.size() && words_[least_] == 0) ++least_;
    if (least_ == words_.size()) return std::nullopt;
    const auto bit = static_cast<std::size_t>(std::countr_zero(words_[least_]));
    words_[least_] &= words_[least_] - 1;
    return 64 * least_ + bit;
  }

 private:
  std::vector<std::uint64_t> words_;
  std::size_t least_;  // words before it are empty
};

std::size_t end_of(std::size_t member, KeyPoint key) {
  return 2 * member + (key == KeyPoint::right ? 1 : 0);
}

}  // namespace

std::size_t OfferGraph::end_told(const PlaceStep& step) {
  return step.key[1] == KeyPoint::none ? kNoEnd : end_of(step.child, step.key[1]);
}

OfferGraph::OfferGraph(std::span<const PlaceOffer> offers, std::size_t members)
    : offers_(offers),
      begin_(2 * members + 1, 0),
      edges_(offers.size()),
      first_end_(members, kNoEnd),
      placed_(members),
      known_(2 * members) {
  for (const PlaceOffer& offer : offers) {
    const std::size_t from = end_of(offer.step.parent, offer.step.key[0]);
    ++begin_[from + 1];
    std::size_t& first = first_end_[offer.step.parent];
    if (first == kNoEnd) first = from;
  }
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t i = 0; i < offers.size(); ++i) {
    const PlaceStep& step = offers[i].step;
    edges_[next[end_of(step.parent, step.key[0])]++] = {i, step.child, end_told(step)};
  }
}

const std::vector<bool>& OfferGraph::placed_from(std::size_t root) {
  placed_.assign(placed_.size(), false);
  known_.assign(known_.size(), false);
  open_.clear();
  if (first_end_[root] == kNoEnd) return placed_;
  placed_[root] = known_[first_end_[root]] = true;
  open_.push_back(first_end_[root]);
  while (!open_.empty()) {
    const std::size_t from = open_.back();
    open_.pop_back();
    for (std::size_t i = begin_[from]; i < begin_[from + 1]; ++i) {
      placed_[edges_[i].child] = true;
      const std::size_t end = edges_[i].end;
      if (end == kNoEnd || known_[end]) continue;
      known_[end] = true;
      open_.push_back(end);
    }
  }
  return placed_;
}

double worth(const Comparison& comparison) {
  const int ends =
      (comparison.key[0] != KeyPoint::none ? 1 : 0) + (comparison.key[1] != KeyPoint::none ? 1 : 0);
  if (!comparison.valid || ends == 0) return 0.0;
  if (ends == 1) return kLineWorth * comparison.shared;
  return (comparison.parallel ? kParallelWorth : 1.0) * comparison.shared;
}

void append_offers(const PlaceStep& there, double worth, std::vector<PlaceOffer>& offers) {
  const PlaceStep back{there.child, there.parent, {there.key[1], there.key[0]}};
  for (const PlaceStep& step : {there, back}) {
    if (step.key[0] != KeyPoint::none) offers.push_back({step, worth});
  }
}

void sort_offers(std::vector<PlaceOffer>& offers) {
  std::ranges::stable_sort(offers, std::greater{}, &PlaceOffer::worth);
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

std::vector<PlaceStep> OfferGraph::spanning_steps(std::size_t root) const {
  std::vector<PlaceStep> steps;
  if (first_end_[root] == kNoEnd) return steps;
  LeastFirst open(offers_.size());  // offers from ends that are known
  std::vector<bool> placed(placed_.size(), false), known(known_.size(), false);
  const auto learn = [&](std::size_t end) {
    known[end] = true;
    for (std::size_t i = begin_[end]; i < begin_[end + 1]; ++i) open.add(edges_[i].offer);
  };
  placed[root] = true;
  learn(first_end_[root]);
  while (const std::optional<std::size_t> next = open.take()) {
    const PlaceStep& step = offers_[*next].step;
    const std::size_t end = end_told(step);
    const bool tells = end != kNoEnd && !known[end];
    if (placed[step.child] && !tells) continue;
    placed[step.child] = true;
    steps.push_back(step);
    if (tells) learn(end);
  }
  return steps;
}

}  // namespace hallway::slam_plane::thesis
