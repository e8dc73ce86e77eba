// SPDX-License-Identifier: MIT
// What the robot does in each state, and what leads to the next one.
#include <algorithm>
#include <cmath>
#include <limits>

#include "wall_follower/core/follower.hpp"

namespace hallway::wall_follower {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kFrontBrake = 0.35;       // way before a wall ahead in which it slows down [m]
constexpr double kClear = 0.36;            // what is seen ahead nearer to the robot's line is avoided [m]
constexpr double kSteer = 2.5;             // slant for each metre beside the wanted line [rad/m]
constexpr double kMostSlant = 0.55;        // [rad]
constexpr double kBend = 4.5;              // turn for each metre of way and rad of slant
constexpr double kTurnDone = 0.03;         // [rad]
constexpr double kSettleSeconds = 0.45;    // in which the detectors read often enough for their medians
constexpr double kLeastCorrection = 0.07;  // a slant that is turned away before the robot goes on [rad]
constexpr int kMostCorrections = 3;
constexpr double kWallAgain = 0.06;    // way with a wall after which it is there [m]
constexpr double kJamb = 0.1;          // what is not farther behind the wall's line is of the wall [m]
constexpr double kLongestDark = 2.5;   // of what infrared does not see [m]
constexpr double kSweepSeconds = 5.0;  // the sonar that has not swept by then is broken

}  // namespace

Command Follower::start() {
  if (!filters_[kRight].ready() || !filters_[kFront].ready()) return {};
  const Place& here = odometer_.reckoned();
  wall_.expect(here.out(Vec2(0.0, -options_.distance_m)), here.heading);
  last_right_.way_m = odometer_.way_m();
  enter(State::seek);
  return {};
}

Command Follower::seek() {
  if (front_is_blocked()) {
    corner_ahead(false);
    return {};
  }
  if (is_wall_again()) {
    const Place& here = odometer_.reckoned();
    wall_.expect(last_right_.at, here.heading);
    after_turn_ = true;
    enter(State::settle);
    return {};
  }
  return along(options_.speed_m_s);
}

Command Follower::follow() {
  if (front_is_blocked()) {
    corner_ahead(true);
    return {};
  }
  if (!sees_right() && gone_way() > options_.edge_m) {
    wall_ended();
    return along(options_.speed_m_s);
  }
  return along(options_.speed_m_s);
}

/// A wall ahead: the way turns left, along it.
void Follower::corner_ahead(bool charted) {
  const double front = std::isfinite(range_m(kFront)) ? range_m(kFront) : 0.0;
  if (charted) add_node_here(Kind::corner, body_.infrared[kFront].point(front));
  if (state_ == State::done) return;
  const Place& here = odometer_.reckoned();
  const double wall = wall_.direction();
  const Vec2 ahead = here.out(body_.infrared[kFront].point(front));
  settles_ = rounds_ = 0;
  turn_to(wall + kQuarter, State::settle);
  wall_.expect(ahead, wall + kQuarter);
}

/// The wall has ended, or goes on beyond the reach of infrared.
void Follower::wall_ended() {
  wall_.drop_pending();
  edge_at_ = last_right_.at;
  opening_distance_ = std::clamp(wall_.distance(odometer_.reckoned().at), 0.35, options_.distance_m);
  opening_ = Opening::hallway;
  jamb_votes_ = 0;
  edge_node_ = add_node(Kind::discontinuity, last_right_, last_right_.way_m, 1, kInfinite);
  if (state_ != State::done) enter(State::advance);
}

/// The wall is there again behind an opening.
void Follower::wall_again() {
  const double direction = wall_.direction();
  add_opening(Kind::room);
  add_node(Kind::discontinuity, last_right_, right_again_way_, -1, kInfinite);
  opening_ = Opening::hallway;
  wall_.expect(last_right_.at, direction);
  if (state_ != State::done) enter(State::follow);
}

double Follower::past_edge() const {
  return unit(wall_.direction()).dot(odometer_.reckoned().at - edge_at_);
}

bool Follower::is_wall_again() const {
  return is_right_again_ && odometer_.way_m() - right_again_way_ > kWallAgain;
}

/// Before a wall ahead, on the way past an opening: whether the detector between front and right sees the followed wall's line, or nothing at it.
void Follower::look_for_jamb() {
  const double front = range_m(kFront);
  if (front < options_.front_m + 0.09 || front > options_.front_m + 0.22) return;
  const double seen = range_m(kFrontRight);
  const double line = wall_.distance(odometer_.reckoned().at);
  const bool is_jamb = seen < kInfinite && -body_.infrared[kFrontRight].point(seen).y() < line + kJamb;
  jamb_votes_ += is_jamb ? 1 : -1;
}

Command Follower::advance() {
  look_for_jamb();
  if (is_wall_again()) {
    wall_again();
    return along(options_.speed_m_s);
  }
  if (front_is_blocked() || past_edge() >= opening_distance_) {
    enter(State::sweep);
    return {};
  }
  return along(options_.speed_m_s);
}

Command Follower::sweep(const Senses& senses) {
  const bool is_late = seconds_in_state() > kSweepSeconds;
  const bool is_swept = senses.sweep && senses.sweep->begin_ns >= entered_ns_ + 200'000'000;
  if (!is_swept && !is_late) return {};
  ++sweeps_;
  const Place& here = odometer_.reckoned();
  const double wall = wall_.distance(here.at);
  opening_ = Opening::hallway;
  if (is_swept) {
    view_ = view_of(*senses.sweep, -kQuarter - wall_.slant(here), options_);
    opening_ = classify(view_, wall, options_);
  }
  const bool is_door = is_leaving_room_ && opening_ == Opening::room;
  if (is_door) opening_ = Opening::hallway;
  // What the robot touched on the way is too near for the sonar.
  if (odometer_.way_m() < keep_until_ && !is_leaving_room_) opening_ = Opening::covered;
  swept_ =
      WallPoint{here.out(Vec2(0.0, -wall)), odometer_.way_m(), t_ns_, odometer_.charted(), Vec2(0.0, -wall)};
  is_opening_charted_ = false;
  if (is_door) open_door();
  if (opening_ == Opening::covered) hide_edge();
  if (is_swept && !circuit_ && opening_ != Opening::covered && !is_opening_charted_) {
    const double slant = wall_.slant(here);
    explorer_.see_exits(*senses.sweep, odometer_.charted().at, odometer_.quarter(slant), slant,
                        odometer_.way_m(), opening_ == Opening::hallway);
  }
  if (leaves_here()) {
    leave();
    return {};
  }
  if (opening_ == Opening::hallway) {
    add_opening(Kind::junction);
    is_leaving_room_ = false;
    if (state_ != State::done) turn_right();
  } else {
    enter(State::pass);
  }
  return {};
}

/// Charts what was swept last, once it is known what it is.
void Follower::add_opening(Kind kind) {
  if (is_opening_charted_) return;
  is_opening_charted_ = true;
  if (opening_ == Opening::covered) return;
  const std::optional<std::uint32_t> id =
      add_node(kind, swept_, swept_.way_m, 0, std::numeric_limits<double>::quiet_NaN());
  if (id) explorer_.name_exits(id);
}

/// The wall's end was none: something dark stands there.
void Follower::hide_edge() {
  if (!edge_node_) return;
  chart_.node(*edge_node_).is_hidden = true;
  ++chart_.changes;
}

Command Follower::pass() {
  look_for_jamb();
  if (is_wall_again()) {
    wall_again();
    return along(options_.speed_m_s);
  }
  const bool is_dark = opening_ == Opening::covered;
  if (front_is_blocked()) {
    if (is_dark || jamb_votes_ > 0) {
      add_opening(Kind::room);
      if (state_ != State::done) corner_ahead(true);
    } else {
      enter(State::reverse);
    }
    return {};
  }
  if (past_edge() > (is_dark ? kLongestDark : options_.longest_pass_m)) enter(State::reverse);
  return along(options_.speed_m_s);
}

Command Follower::reverse() {
  if (past_edge() > opening_distance_) {
    const double slant = wall_.slant(odometer_.reckoned());
    return {-options_.speed_m_s, std::clamp(-2.0 * slant, -0.5, 0.5)};
  }
  add_opening(Kind::junction);
  if (state_ != State::done) turn_right();
  return {};
}

/// Turns about the end of the wall. What is behind the corner is expected where the wall has ended.
void Follower::turn_right() {
  const double direction = wall_.direction() - kQuarter;
  const Place& here = odometer_.reckoned();
  const double aside = std::max(0.35, past_edge());
  settles_ = 0;
  turn_to(direction, State::round);
  wall_.expect(here.at + aside * unit(direction - kQuarter), direction);
  after_turn_ = true;
}

Command Follower::round() {
  if (front_is_blocked()) {
    corner_ahead(true);
    return {};
  }
  if (is_wall_again()) {
    rounds_ = 0;
    wall_.expect(last_right_.at, wall_.direction());
    enter(State::follow);
    return along(options_.speed_m_s);
  }
  if (in_state() > 2.0 * options_.distance_m + 0.3) {
    if (++rounds_ < 4) {
      const Place& here = odometer_.reckoned();
      edge_at_ = here.at - options_.distance_m * unit(wall_.direction());
      turn_right();
      return {};
    }
    rounds_ = 0;
    enter(State::seek);
  }
  return along(options_.speed_m_s);
}

void Follower::turn_to(double heading, State next) {
  target_ = heading;
  next_ = next;
  enter(State::turn);
}

Command Follower::turn() {
  const double left = target_ - odometer_.reckoned().heading;
  if (std::abs(left) > kTurnDone && seconds_in_state() < 12.0) return turn_by(left);
  after_turn_ = true;
  for (MedianFilter& filter : filters_) filter.clear();
  last_right_.way_m = odometer_.way_m();
  enter(next_);
  return {};
}

Command Follower::turn_by(double left) const {
  const double rate = std::clamp(3.0 * left, -options_.turn_rad_s, options_.turn_rad_s);
  return {0.0, std::copysign(std::max(std::abs(rate), 0.35), left)};
}

/// After a turn the robot is nearly never at 90 degrees (thesis 2.2.4): it reorients by two detectors that see the wall.
Command Follower::settle() {
  if (seconds_in_state() < kSettleSeconds) return {};
  const double side = range_m(kRight), ahead = range_m(kFrontRight);
  const Place& here = odometer_.reckoned();
  if (side < kInfinite && ahead < kInfinite) {
    const Vec2 a = body_.infrared[kRight].point(side), b = body_.infrared[kFrontRight].point(ahead);
    const double slant = -std::atan2(b.y() - a.y(), b.x() - a.x());
    if (std::abs(slant) < 0.8) {
      wall_.expect(here.out(a), here.heading - slant);
      if (std::abs(slant) > kLeastCorrection && settles_ < kMostCorrections) {
        ++settles_;
        turn_to(here.heading - slant, State::settle);
        return {};
      }
    }
  } else if (side < kInfinite) {
    wall_.expect(here.out(body_.infrared[kRight].point(side)), wall_.direction());
  }
  settles_ = 0;
  if (!is_charting_) {
    is_charting_ = true;
    chart_.note = "";
    odometer_.align_first(wall_.slant(here));
    after_turn_ = false;
  }
  last_right_.way_m = odometer_.way_m();
  enter(State::follow);
  return {};
}

double Follower::middle_distance() const {
  return odometer_.way_m() < keep_until_ ? keep_m_ : options_.distance_m;
}

Command Follower::along(double speed_m_s) const {
  const Place& here = odometer_.reckoned();
  const double beside = wall_.distance(here.at) - middle_distance();
  const double wanted = std::clamp(-kSteer * beside, -kMostSlant, kMostSlant);
  double bend = kBend * (wanted - wall_.slant(here));
  double speed = speed_m_s * std::clamp((range_m(kFront) - options_.front_m) / kFrontBrake, 0.35, 1.0);
  const double front_right = range_m(kFrontRight);
  double left = speed * bend;
  if (front_right < kInfinite) {
    const double near = kClear + body_.infrared[kFrontRight].point(front_right).y();
    const double danger = std::clamp(near / 0.2, 0.0, 1.2);
    speed *= 1.0 - 0.6 * std::min(danger, 1.0);
    left = danger > 0.0 ? std::max(speed * bend, 1.6 * danger) : speed * bend;
  }
  if (odometer_.way_m() < scraped_until_) left -= 0.5 * scraped_;
  left = std::clamp(left / (1.0 - odometer_.turn_slip()), -options_.turn_rad_s, options_.turn_rad_s);
  return {speed, left};
}

void Follower::add_node_here(Kind kind, const Vec2& body) {
  const WallPoint here{odometer_.reckoned().out(body), odometer_.way_m(), t_ns_, odometer_.charted(), body};
  add_node(kind, here, here.way_m, 0, std::numeric_limits<double>::quiet_NaN());
}

std::optional<std::uint32_t> Follower::add_node(Kind kind, const WallPoint& at, double way_m, int direction,
                                                double size_m) {
  if (!is_charting_ || state_ == State::done) return std::nullopt;
  Node node;
  node.kind = kind;
  node.direction = direction;
  node.size_m = size_m;
  node.t_ns = at.t_ns;
  node.body = at.body;
  node.at = at.from.out(at.body);
  node.is_hidden = opening_ == Opening::covered && (state_ == State::pass || state_ == State::sweep);
  node.way_m = way_m;
  node.quarter = odometer_.quarter(wall_.slant(odometer_.reckoned()));
  if (circuit_) {
    localise(node);
    return std::nullopt;
  }
  chart_.add(node, confidence_);
  const std::uint32_t id = chart_.nodes.back().id;
  judge(chart_.nodes.back());
  confidence_ = 1.0;
  return circuit_ || !chart_.has(id) ? std::nullopt : std::optional(id);
}

}  // namespace hallway::wall_follower
