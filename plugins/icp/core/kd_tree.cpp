// SPDX-License-Identifier: MIT
#include "icp/core/kd_tree.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace hallway::icp {
namespace {

constexpr std::uint32_t kLeafPoints = 8;

bool before(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/// A total order by distance that asks for the order of the list only where two points are the same.
struct Candidate {
  double distance2;
  const Vec3* point;
  std::uint32_t number;

  bool operator<(const Candidate& other) const {
    if (distance2 != other.distance2) return distance2 < other.distance2;
    if (*point != *other.point) return before(*point, *other.point);
    return number < other.number;
  }
};

class NearestOne {
 public:
  explicit NearestOne(double most_m)
      : best_{most_m * most_m, nullptr, std::numeric_limits<std::uint32_t>::max()} {}

  double bound2() const { return best_.distance2; }
  void take(const Candidate& candidate) {
    if (best_.point == nullptr ? candidate.distance2 <= best_.distance2 : candidate < best_)
      best_ = candidate;
  }
  const Candidate& best() const { return best_; }

 private:
  Candidate best_;
};

class NearestSome {
 public:
  explicit NearestSome(std::size_t count) : count_(count) { heap_.reserve(count + 1); }

  double bound2() const {
    return heap_.size() < count_ ? std::numeric_limits<double>::infinity() : heap_.front().distance2;
  }
  void take(const Candidate& candidate) {
    if (heap_.size() == count_ && !(candidate < heap_.front())) return;
    heap_.push_back(candidate);
    std::push_heap(heap_.begin(), heap_.end());
    if (heap_.size() <= count_) return;
    std::pop_heap(heap_.begin(), heap_.end());
    heap_.pop_back();
  }
  const std::vector<Candidate>& sorted() {
    std::sort_heap(heap_.begin(), heap_.end());
    return heap_;
  }

 private:
  std::size_t count_;
  std::vector<Candidate> heap_;
};

}  // namespace

KdTree::KdTree(std::span<const Vec3> points) : numbers_(points.size()), axes_(points.size()) {
  std::iota(numbers_.begin(), numbers_.end(), 0u);
  build({0, static_cast<std::uint32_t>(points.size())}, points);
  points_.reserve(points.size());
  for (const std::uint32_t number : numbers_) points_.push_back(points[number]);
}

void KdTree::build(Range range, std::span<const Vec3> given) {
  if (range.end - range.begin <= kLeafPoints) return;
  Vec3 low = given[numbers_[range.begin]], high = low;
  for (std::uint32_t i = range.begin; i < range.end; ++i) {
    low = low.cwiseMin(given[numbers_[i]]);
    high = high.cwiseMax(given[numbers_[i]]);
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const std::uint32_t middle = range.begin + (range.end - range.begin) / 2;
  const auto at = [this](std::uint32_t i) { return numbers_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(range.begin), at(middle), at(range.end),
                   [&](std::uint32_t a, std::uint32_t b) { return given[a][axis] < given[b][axis]; });
  axes_[middle] = static_cast<std::uint8_t>(axis);
  build({range.begin, middle}, given);
  build({middle + 1, range.end}, given);
}

template <typename Found>
void KdTree::search(Range range, const Vec3& place, Found& found) const {
  const auto take = [&](std::uint32_t i) {
    found.take({(points_[i] - place).squaredNorm(), &points_[i], numbers_[i]});
  };
  if (range.end - range.begin <= kLeafPoints) {
    for (std::uint32_t i = range.begin; i < range.end; ++i) take(i);
    return;
  }
  const std::uint32_t middle = range.begin + (range.end - range.begin) / 2;
  const double beyond = place[axes_[middle]] - points_[middle][axes_[middle]];
  const Range below{range.begin, middle}, above{middle + 1, range.end};
  search(beyond < 0.0 ? below : above, place, found);
  if (beyond * beyond > found.bound2()) return;
  take(middle);
  search(beyond < 0.0 ? above : below, place, found);
}

std::optional<Neighbour> KdTree::nearest(const Vec3& place, double most_m) const {
  NearestOne found(most_m);
  search({0, static_cast<std::uint32_t>(points_.size())}, place, found);
  if (found.best().point == nullptr) return std::nullopt;
  return Neighbour{found.best().number, found.best().distance2};
}

void KdTree::nearest(const Vec3& place, std::size_t count, std::vector<Neighbour>& found) const {
  found.clear();
  if (count == 0) return;
  NearestSome some(count);
  search({0, static_cast<std::uint32_t>(points_.size())}, place, some);
  for (const Candidate& candidate : some.sorted()) found.push_back({candidate.number, candidate.distance2});
}

}  // namespace hallway::icp
