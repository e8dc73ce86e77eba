// SPDX-License-Identifier: MIT
#include "slam_point/core/moving/motion_watch.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::slam_point {
namespace {

constexpr std::uint32_t kLeastSightings = 3;
constexpr double kMemory = 16.0;          // sightings over which products are averaged
constexpr double kSuspectDeviations = 4;  // of the mean product while the landmark stands
constexpr double kNoiseShare = 0.05;      // of the newest frame in the noise
constexpr double kMostNoises2 =
    9.0;  // an innovation counts at most so much, squared and in units of the noise

}  // namespace

void MotionWatch::begin_frame(std::uint64_t number) {
  if (coordinates_ > 0) variance_ += kNoiseShare * (squares_ / coordinates_ - variance_);
  variance_ = std::max(variance_, least_variance_);
  squares_ = 0.0;
  coordinates_ = 0;
  frame_ = number;
}

MotionWatch::State& MotionWatch::state(Index landmark) {
  if (landmark >= states_.size()) states_.resize(landmark + 1);
  State& state = states_[landmark];
  if (state.last_frame == ~std::uint64_t{0} || frame_ - state.last_frame > kMaxGap) begin_visit(state);
  state.last_frame = frame_;
  return state;
}

void MotionWatch::begin_visit(State& state) const {
  state = State();
  state.since = frame_;
}

bool MotionWatch::add(Index landmark, const Vec3& residual, std::uint32_t count) {
  State& state = this->state(landmark);
  if (state.astray > 0) begin_visit(state);
  state.last_frame = frame_;
  const double n = static_cast<double>(count);
  const Vec3 innovation = std::sqrt(n / (n + 1.0)) * residual;
  squares_ += std::min(innovation.squaredNorm(), 3.0 * kMostNoises2 * variance_);
  coordinates_ += 3;
  ++state.sightings;
  const double product = innovation.dot(state.last);
  state.last = innovation;
  if (state.sightings < 2) return false;
  const double share = 1.0 / std::min(static_cast<double>(state.sightings - 1), kMemory);
  state.product += share * (product - state.product);
  if (state.sightings < kLeastSightings || frame_ < state.free_until) return false;
  // A product of independent innovations has variance 3 variance^2; their running mean share / (2 - share) of it, once
  // it is one, and share of it while it is a plain mean.
  const double of_mean = share > 1.0 / kMemory ? share : share / (2.0 - share);
  const double limit = kSuspectDeviations * variance_ * std::sqrt(3.0 * of_mean);
  return state.product > limit;
}

std::uint32_t MotionWatch::add_astray(Index landmark) {
  State& state = this->state(landmark);
  if (state.astray == 0) begin_visit(state);
  state.last_frame = frame_;
  return ++state.astray;
}

void MotionWatch::acquit(Index landmark, std::uint32_t frames) {
  State& state = states_[landmark];
  state.free_until = frame_ + frames;
  ++state.acquittals;
}

std::uint64_t MotionWatch::since(Index landmark) const {
  return of(landmark).since;
}

void MotionWatch::clear() {
  states_.clear();
  variance_ = least_variance_;
  squares_ = 0.0;
  coordinates_ = 0;
}

}  // namespace hallway::slam_point
