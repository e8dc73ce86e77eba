// SPDX-License-Identifier: MIT
#include "import/point_collector.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"

namespace hallway::import {

PointCollector::PointCollector(Frame& frame, std::uint32_t stride, std::vector<std::uint64_t>* rows)
    : frame_(frame), stride_(stride), rows_(rows) {
  if (rows_ != nullptr) rows_->clear();
  frame_.points.clear();
  frame_.image = {};
  frame_.not_finite = 0;
}

void PointCollector::begin_image(std::uint64_t width, std::uint64_t height) {
  if (width == 0 || height == 0 || width > kMaxPixels / height) return;
  frame_.image.width = static_cast<std::uint32_t>(width);
  frame_.image.height = static_cast<std::uint32_t>(height);
}

void PointCollector::add(double x, double y, double z, std::uint64_t pixel) {
  const std::uint64_t row = given_++;
  if (until_next_ > 0) {
    --until_next_;
    return;
  }
  until_next_ = stride_ - 1;
  if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) {
    ++frame_.not_finite;
    return;
  }
  if (frame_.points.size() == kMaxFramePoints) {
    throw Error(ErrorCode::kBadInput,
                fmt::format("has more than {} points, which is what a frame holds; --stride takes each n-th",
                            kMaxFramePoints));
  }
  if (rows_ != nullptr) rows_->push_back(row);
  frame_.points.push_back({x, y, z});
  if (frame_.image.width != 0) frame_.image.pixels.push_back(static_cast<std::uint32_t>(pixel));
}

}  // namespace hallway::import
