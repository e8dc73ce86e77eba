// SPDX-License-Identifier: MIT
#include "trace/triangle_groups.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <span>

namespace hallway::trace {
namespace {

constexpr std::size_t kBins = 16;

/// Half of a box's surface.
double half_surface(const Box& box) {
  const Vec3 size = box.sizes();
  return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
}

struct Bin {
  Box box;
  std::size_t count = 0;

  void add(const Bin& other) {
    box.extend(other.box);
    count += other.count;
  }
};

/// Bins along one axis of the box that holds the centres.
struct Axis {
  int axis = 0;
  double low = 0.0;
  double bins_per_m = 0.0;

  std::size_t bin(const Box& box) const {
    const double at = (0.5 * (box.min()[axis] + box.max()[axis]) - low) * bins_per_m;
    return std::min(static_cast<std::size_t>(std::max(at, 0.0)), kBins - 1);
  }
};

/// Boxes in the bins below `first_bin` of an axis go to one side.
struct Split {
  Axis axis;
  std::size_t first_bin = 0;
  double cost = std::numeric_limits<double>::infinity();
};

class Grouping {
 public:
  Grouping(const std::vector<Box>& boxes, std::uint32_t most) : boxes_(boxes), most_(most) {
    groups_.items.resize(boxes.size());
    std::iota(groups_.items.begin(), groups_.items.end(), 0u);
  }

  Groups run() {
    if (!boxes_.empty()) divide(groups_.items);
    groups_.begin.push_back(static_cast<std::uint32_t>(groups_.items.size()));
    return std::move(groups_);
  }

 private:
  using Items = std::span<std::uint32_t>;

  void divide(Items items) {
    if (items.size() <= most_) {
      groups_.begin.push_back(static_cast<std::uint32_t>(items.data() - groups_.items.data()));
      return;
    }
    const std::size_t middle = split(items);
    divide(items.subspan(0, middle));
    divide(items.subspan(middle));
  }

  /// Orders the items into two parts and returns the length of the first; neither is empty.
  std::size_t split(Items items) const {
    Box centres;
    for (const std::uint32_t item : items) centres.extend(Vec3(boxes_[item].center()));
    Split best;
    for (int i = 0; i < 3; ++i) {
      const double size = centres.sizes()[i];
      const double bins_per_m = static_cast<double>(kBins) / size;
      if (size > 0.0 && bins_per_m < std::numeric_limits<double>::infinity()) {
        try_axis({i, centres.min()[i], bins_per_m}, items, best);
      }
    }
    if (best.first_bin == 0) return items.size() / 2;  // all centres are one
    const auto middle = std::stable_partition(items.begin(), items.end(), [&](std::uint32_t item) {
      return best.axis.bin(boxes_[item]) < best.first_bin;
    });
    return static_cast<std::size_t>(middle - items.begin());
  }

  void try_axis(const Axis& axis, Items items, Split& best) const {
    std::array<Bin, kBins> bins;
    for (const std::uint32_t item : items) bins[axis.bin(boxes_[item])].add({boxes_[item], 1});
    std::array<double, kBins> cost_above{};
    Bin above;
    for (std::size_t i = kBins - 1; i > 0; --i) {
      above.add(bins[i]);
      cost_above[i] = above.count == 0 ? std::numeric_limits<double>::infinity() : cost(above);
    }
    Bin below;
    for (std::size_t i = 1; i < kBins; ++i) {
      below.add(bins[i - 1]);
      if (below.count == 0) continue;
      const double total = cost(below) + cost_above[i];
      if (total < best.cost) best = {axis, i, total};
    }
  }

  double cost(const Bin& bin) const {
    return half_surface(bin.box) * static_cast<double>((bin.count + most_ - 1) / most_);
  }

  const std::vector<Box>& boxes_;
  std::uint32_t most_;
  Groups groups_;
};

}  // namespace

Groups group_boxes(const std::vector<Box>& boxes, std::uint32_t most) {
  return Grouping(boxes, most).run();
}

}  // namespace hallway::trace
