// SPDX-License-Identifier: MIT
#include "geometry/kd_tree.hpp"

#include <limits>
#include <numeric>

namespace hallway {
namespace {

constexpr std::uint32_t kLeafPoints = 16;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double squared_distance_to_box(const Vec3& p, const Vec3& middle, const Vec3& half) {
  return ((p - middle).cwiseAbs() - half).cwiseMax(0.0).squaredNorm();
}

/// A total order by distance that asks for the order of the list only where two points are the same.
struct Candidate {
  double distance2;
  const Vec3* point;
  std::uint32_t number;

  bool operator<(const Candidate& other) const {
    if (distance2 != other.distance2) return distance2 < other.distance2;
    if (*point != *other.point)
      return std::lexicographical_compare(point->begin(), point->end(), other.point->begin(),
                                          other.point->end());
    return number < other.number;
  }
};

class NearestOne {
 public:
  explicit NearestOne(double most_m) : best_{most_m * most_m, nullptr, 0} {}

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
  explicit NearestSome(std::size_t count) : count_(count) {}

  double bound2() const { return heap_.size() < count_ ? kInfinity : heap_.front().distance2; }
  void take(const Candidate& candidate) {
    if (heap_.size() == count_) {
      if (!(candidate < heap_.front())) return;
      std::pop_heap(heap_.begin(), heap_.end());
      heap_.pop_back();
    }
    heap_.push_back(candidate);
    std::push_heap(heap_.begin(), heap_.end());
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

KdTree::KdTree(std::span<const Vec3> points) : numbers_(points.size()) {
  std::iota(numbers_.begin(), numbers_.end(), 0u);
  if (!points.empty()) build(points, 0, static_cast<std::uint32_t>(points.size()));
  points_.reserve(points.size());
  for (const std::uint32_t number : numbers_) points_.push_back(points[number]);
}

std::uint32_t KdTree::build(std::span<const Vec3> given, std::uint32_t begin, std::uint32_t end) {
  Vec3 low = given[numbers_[begin]], high = low;
  for (std::uint32_t i = begin; i < end; ++i) {
    low = low.cwiseMin(given[numbers_[i]]);
    high = high.cwiseMax(given[numbers_[i]]);
  }
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  Node& node = nodes_.emplace_back();
  node.begin = begin;
  node.end = end;
  node.middle = 0.5 * (low + high);
  node.half = (high - node.middle).cwiseMax(node.middle - low);
  if (end - begin <= kLeafPoints) return index;
  Eigen::Index axis = 0;
  node.half.maxCoeff(&axis);
  const std::uint32_t split = begin + (end - begin) / 2;
  const auto at = [this](std::uint32_t i) { return numbers_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(split), at(end),
                   [&](std::uint32_t a, std::uint32_t b) { return given[a][axis] < given[b][axis]; });
  const std::uint32_t left = build(given, begin, split);  // nodes_ moves: `node` is no more
  const std::uint32_t right = build(given, split, end);
  nodes_[index].left = left;
  nodes_[index].right = right;
  return index;
}

template <typename Found>
void KdTree::search(std::uint32_t index, const Vec3& place, Found& found) const {
  const Node& node = nodes_[index];
  if (node.left == 0) {
    for (std::uint32_t i = node.begin; i < node.end; ++i)
      found.take({(points_[i] - place).squaredNorm(), &points_[i], numbers_[i]});
    return;
  }
  // The nearer half first. A little more than the bound, lest rounding shut out what a look at the point lets in.
  const auto distance2 = [&](std::uint32_t child) {
    return squared_distance_to_box(place, nodes_[child].middle, nodes_[child].half);
  };
  std::uint32_t near = node.left, far = node.right;
  double near2 = distance2(near), far2 = distance2(far);
  if (far2 < near2) {
    std::swap(near, far);
    std::swap(near2, far2);
  }
  if (near2 <= found.bound2() * (1.0 + 1e-9)) search(near, place, found);
  if (far2 <= found.bound2() * (1.0 + 1e-9)) search(far, place, found);
}

std::optional<Neighbour> KdTree::nearest(const Vec3& place, double most_m) const {
  NearestOne found(most_m);
  if (!nodes_.empty()) search(0, place, found);
  if (found.best().point == nullptr) return std::nullopt;
  return Neighbour{found.best().distance2, found.best().number};
}

void KdTree::nearest(const Vec3& place, std::size_t count, std::vector<Neighbour>& found) const {
  found.clear();
  if (count == 0 || nodes_.empty()) return;
  NearestSome some(count);
  search(0, place, some);
  for (const Candidate& candidate : some.sorted()) found.push_back({candidate.distance2, candidate.number});
}

}  // namespace hallway
