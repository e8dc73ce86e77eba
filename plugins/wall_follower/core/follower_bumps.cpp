// SPDX-License-Identifier: MIT
// What the robot does when it has touched something: it goes back, past it, and on with what it did.
#include <algorithm>

#include "wall_follower/core/follower.hpp"

namespace hallway::wall_follower {
namespace {

constexpr double kVeer = 0.6;       // [rad]
constexpr double kVeerWay = 0.22;   // [m]
constexpr double kBumpRow = 0.9;    // way in which bumps are of one thing [m]
constexpr double kBumpKeeps = 1.0;  // way for which a bump asks for another distance [m]

}  // namespace

void Follower::bumped(const Bump& bump) {
  if (state_ == State::back_off || state_ == State::done || state_ == State::start) return;
  ++bumps_;
  confidence_ *= 0.8;
  interrupted_ = state_;
  back_is_forward_ = bump.behind && !bump.left && !bump.right;
  if (state_ == State::turn || state_ == State::settle) {
    bumps_in_row_ = 0;
    veer_ = 0.0;
    back_m_ = 0.06;
  } else {
    bumps_in_row_ = odometer_.way_m() - bump_way_ < kBumpRow ? bumps_in_row_ + 1 : 1;
    bump_way_ = odometer_.way_m();
    veer_ = bump.left && !bump.right ? -0.6 * kVeer : kVeer;
    back_m_ = options_.bump_back_m;
  }
  enter(State::back_off);
}

/// Something beside the robot: it keeps off for a while.
void Follower::scraped(const Bump& bump) {
  scraped_ = bump.right_side ? -1.0 : 1.0;
  scraped_until_ = odometer_.way_m() + 0.15;
}

Command Follower::back_off() {
  const double way = back_is_forward_ ? in_state() : -in_state();
  if (way < back_m_ && seconds_in_state() < 3.0) {
    return {back_is_forward_ ? 0.5 * options_.speed_m_s : -0.5 * options_.speed_m_s, 0.0};
  }
  if (interrupted_ == State::turn) {
    enter(State::turn);
    return {};
  }
  if (veer_ == 0.0 || interrupted_ == State::veer) veer_ = veer_ == 0.0 ? kVeer : veer_;
  if (bumps_in_row_ >= 3) {
    bumps_in_row_ = 0;
    blocked_after_bump();
    return {};
  }
  turn_to(wall_.direction() + veer_, State::veer);
  return {};
}

/// A wall ahead, after a bump.
void Follower::blocked_after_bump() {
  if (!is_crossing()) {
    corner_ahead(is_charting_);
    return;
  }
  interrupted_ = State::follow;
  arrive();
  corner_ahead(false);
}

Command Follower::veer() {
  if (front_is_blocked()) {
    blocked_after_bump();
    return {};
  }
  if (in_state() < kVeerWay) return {0.7 * options_.speed_m_s, 0.0};
  keep_m_ = std::clamp(wall_.distance(odometer_.reckoned().at), 0.3, 1.2);
  keep_until_ = odometer_.way_m() + kBumpKeeps;
  last_right_.way_m = odometer_.way_m();
  switch (interrupted_) {
    case State::advance:
    case State::pass:
    case State::round:
    case State::seek:
    case State::cross:
    case State::retreat:
      enter(interrupted_);
      break;
    default:
      enter(State::follow);
  }
  return {};
}

}  // namespace hallway::wall_follower
