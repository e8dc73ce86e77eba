// SPDX-License-Identifier: MIT
#include "wall_follower/core/follower.hpp"

#include <algorithm>
#include <cmath>

namespace hallway::wall_follower {
namespace {

constexpr double kStraight = 0.08;    // change of direction of a wall that is straight [rad]
constexpr double kStraightWay = 0.3;  // on which it has been so [m]
constexpr double kNearest = 0.08;     // range of what is nearer than a detector can measure [m]

}  // namespace

Follower::Follower(const Body& body, const Options& options)
    : body_(body),
      options_(options),
      odometer_(body.wheel_base_m, options.turn_slip),
      wall_(options),
      loops_(options),
      explorer_(options) {
  chart_.note = "no wall yet";
  loops_.begin(chart_);
}

Command Follower::step(const Senses& senses) {
  news_.clear();
  sense(senses);
  if (senses.bump.in_the_way()) bumped(senses.bump);
  if (senses.bump.left_side || senses.bump.right_side) scraped(senses.bump);
  const Command command = act(senses);
  check_tour();
  return state_ == State::done ? Command() : command;
}

void Follower::sense(const Senses& senses) {
  t_ns_ = senses.t_ns;
  odometer_.update(senses.left_m, senses.right_m);
  std::size_t most = 0;
  for (const auto& readings : senses.infrared) most = std::max(most, readings.size());
  for (std::size_t i = 0; i < most; ++i) {
    for (std::size_t look = 0; look < kLooks; ++look) {
      if (i >= senses.infrared[look].size()) continue;
      const double range = senses.infrared[look][i];
      filters_[look].add(std::isnan(range) ? kNearest : range, odometer_.reckoned());
    }
    look_right();
  }
}

/// Takes the point that the detector to the right sees into the wall's line, and charts a discontinuity behind which enough of the wall was seen.
void Follower::look_right() {
  if (!sees_right()) {
    is_right_again_ = false;
    return;
  }
  if (!is_right_again_) right_again_way_ = odometer_.way_m();
  is_right_again_ = true;
  if (state_ == State::start || state_ == State::turn || state_ == State::back_off || state_ == State::veer ||
      state_ == State::reverse || state_ == State::retreat)
    return;
  WallPoint point;
  point.body = body_.infrared[kRight].point(range_m(kRight));
  point.at = filters_[kRight].from().out(point.body);
  point.way_m = odometer_.way_m();
  point.t_ns = t_ns_;
  point.from = odometer_.charted();
  last_right_ = point;
  if (is_charting_ && !circuit_ && !is_crossing())
    explorer_.see_wall(point.from.out(point.body), point.way_m);
  if (state_ != State::follow) return;
  const std::optional<Step> step = wall_.add(point);
  if (step) chart_step(*step);
  if (!step && wall_.is_measured() && is_straight()) align();
}

/// Whether the wall has had one direction for a while: along a curved one the heading is not aligned.
bool Follower::is_straight() {
  if (std::abs(wrapped(wall_.direction() - straight_direction_)) > kStraight) {
    straight_direction_ = wall_.direction();
    straight_from_ = odometer_.way_m();
  }
  return odometer_.way_m() - straight_from_ > kStraightWay;
}

void Follower::align() {
  const double slant = wall_.slant(odometer_.reckoned());
  if (after_turn_) {
    odometer_.align_after_turn(slant);
    after_turn_ = false;
  } else {
    odometer_.align_on_way(slant);
  }
}

void Follower::chart_step(const Step& step) {
  add_node(Kind::discontinuity, step.at, step.at.way_m, step.direction, step.size_m);
}

Command Follower::act(const Senses& senses) {
  switch (state_) {
    case State::start:
      return start();
    case State::seek:
      return seek();
    case State::follow:
      return follow();
    case State::turn:
      return turn();
    case State::settle:
      return settle();
    case State::advance:
      return advance();
    case State::sweep:
      return sweep(senses);
    case State::pass:
      return pass();
    case State::reverse:
      return reverse();
    case State::round:
      return round();
    case State::back_off:
      return back_off();
    case State::veer:
      return veer();
    case State::cross:
      return cross();
    case State::retreat:
      return retreat();
    case State::done:
      break;
  }
  return {};
}

void Follower::enter(State state) {
  state_ = state;
  entered_ns_ = t_ns_;
  entered_way_ = odometer_.way_m();
  is_right_again_ = false;
}

}  // namespace hallway::wall_follower
