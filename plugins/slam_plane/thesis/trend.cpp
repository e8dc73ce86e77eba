// SPDX-License-Identifier: MIT
#include "slam_plane/thesis/trend.hpp"

#include <algorithm>

namespace hallway::slam_plane::thesis {
namespace {

constexpr double kEqual_m = 1e-9;  // the last one of a plateau is sought

}  // namespace

std::optional<Iteration> TrendDetector::add(double average, Iteration peak, Iteration dip,
                                            double hysteresis) {
  if (empty_) {
    empty_ = false;
    highest_ = lowest_ = average;
    peak_ = peak;
    dip_ = dip;
    return std::nullopt;
  }
  if (average >= highest_ - kEqual_m) {
    highest_ = std::max(highest_, average);
    peak_ = peak;
  }
  if (average <= lowest_ + kEqual_m) {
    lowest_ = std::min(lowest_, average);
    dip_ = dip;
  }
  const bool grew = average > lowest_ + hysteresis;
  const bool shrank = average < highest_ - hysteresis;
  if (trend_ == Trend::steady) {
    if (shrank) trend_ = Trend::shrinking;
    if (grew) trend_ = Trend::growing;
    return std::nullopt;
  }
  if (trend_ == Trend::growing ? !shrank : !grew) return std::nullopt;
  const Iteration end = trend_ == Trend::growing ? peak_ : dip_;
  trend_ = trend_ == Trend::growing ? Trend::shrinking : Trend::growing;
  highest_ = lowest_ = average;
  peak_ = peak;
  dip_ = dip;
  return end;
}

}  // namespace hallway::slam_plane::thesis
