// SPDX-License-Identifier: MIT
#include "foxglove/path_line.hpp"

#include <algorithm>

namespace hallway::foxglove {
namespace {

constexpr std::size_t kGrowth = 16;
constexpr std::size_t kFewestNew = 10;

}  // namespace

void PathLine::add(std::uint32_t iteration, const Vec3& position) {
  if (strips_.empty() || iteration != last_ + 1) strips_.emplace_back();
  strips_.back().push_back(position);
  last_ = iteration;
  ++points_;
}

std::vector<Line> PathLine::show(double width_px, const Colour& colour) {
  shown_ = points_;
  due_at_ = points_ + std::max(kFewestNew, points_ / kGrowth);
  std::vector<Line> lines;
  for (const std::vector<Vec3>& strip : strips_) {
    if (strip.size() < 2) continue;
    lines.push_back({.kind = Line::Kind::kStrip, .points = strip, .width_px = width_px, .colour = colour});
  }
  return lines;
}

}  // namespace hallway::foxglove
