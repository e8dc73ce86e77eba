// SPDX-License-Identifier: MIT
#include "wall_follower/core/odometer.hpp"

#include <algorithm>

namespace hallway::wall_follower {
namespace {

constexpr double kSnap = 0.26;         // a wall farther from the axes is not along one [rad]
constexpr double kSnapAtTurn = 0.75;   // likewise after a turn, whose error is large [rad]
constexpr double kSnapPerTurn = 0.25;  // what the former grows by along a curved wall, for each radian of it
constexpr double kAligned = 0.05;      // [rad]
constexpr double kShare = 0.06;        // of an error on the way, for each reading
constexpr double kLearnt = 0.15;       // least share of what a turn tells of the slip
constexpr double kTurn = 1.0;          // a smaller turn of the tracks tells little of it [rad]
constexpr double kMostSlip = 0.6;

void move(Place& place, double way_m, double turn) {
  place.at += way_m * unit(place.heading + 0.5 * turn);
  place.heading += turn;
}

}  // namespace

Odometer::Odometer(double wheel_base_m, double turn_slip) : wheel_base_m_(wheel_base_m), slip_(turn_slip) {}

void Odometer::update(double left_m, double right_m) {
  if (begun_) {
    const double way = 0.5 * (left_m - left_m_ + right_m - right_m_);
    const double turn = ((right_m - right_m_) - (left_m - left_m_)) / wheel_base_m_;
    track_turn_ += turn;
    curve_ += std::abs(turn);
    way_m_ += way;
    move(reckoned_, way, turn * (1.0 - slip_));
    move(charted_, way, turn * (1.0 - slip_));
  }
  begun_ = true;
  left_m_ = left_m;
  right_m_ = right_m;
}

double Odometer::heading_error(double slant) const {
  const double wall = charted_.heading - slant;
  return std::round(wall / kQuarter) * kQuarter - wall;
}

void Odometer::correct(double slant, double share) {
  const double error = heading_error(slant);
  charted_.heading += share * error;
}

void Odometer::align_first(double slant) {
  charted_.heading = slant;
  track_turn_ = 0.0;
}

void Odometer::align_after_turn(double slant) {
  const double error = heading_error(slant);
  if (std::abs(error) > kSnapAtTurn) return;
  if (std::abs(track_turn_) > kTurn)
    slip_ = std::clamp(slip_ - std::max(kLearnt, 1.0 / ++turns_) * error / track_turn_, 0.0, kMostSlip);
  correct(slant, 1.0);
  track_turn_ = 0.0;
}

void Odometer::align_on_way(double slant) {
  const double error = std::abs(heading_error(slant));
  if (error > std::min(kSnap + kSnapPerTurn * curve_, kSnapAtTurn)) return;
  if (error < kAligned) curve_ = 0.0;
  correct(slant, kShare);
  track_turn_ = 0.0;
}

}  // namespace hallway::wall_follower
