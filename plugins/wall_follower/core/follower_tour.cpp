// SPDX-License-Identifier: MIT
// What the robot does when its landmarks have closed a loop: it goes along the known wall to an exit that leads to one which is not known, and across.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "wall_follower/core/follower.hpp"

namespace hallway::wall_follower {
namespace {

constexpr double kSameLandmark =
    0.75;  // a landmark of a known wall is within this of where it is expected, along the wall [m]
constexpr double kWayError = 0.05;     // of a way along a wall
constexpr double kLandingError = 1.0;  // of the place where a crossing meets a wall [m]
constexpr double kAtExit = 0.8;        // the robot is at an exit within this along the wall [m]
constexpr double kNearExit = 2.0;      // and within this by the reckoned way [m]
constexpr double kPassed = 1.5;        // behind an exit by this, the robot has missed it [m]
constexpr double kLost = 10.0;  // way without a known landmark after which the wall is not the known one [m]
constexpr double kLeastCrossing = 0.8;  // way before a wall on the right is followed [m]
constexpr double kLeastDoorway = 0.5;   // way before a doorway is one of the other wall [m]
constexpr double kIsWall = 0.35;        // a wall on the right is longer than a door frame [m]
constexpr int kMostTurns = 12;          // of 90 degrees: three times round without a loop
constexpr int kMostGivenUp = 4;         // walls

double longest_gap(const Chart& chart, const Circuit& circuit) {
  double gap = 0.0, last = circuit.begin_m + circuit.length_m;
  for (auto id = circuit.lap.rbegin(); id != circuit.lap.rend(); ++id) {
    gap = std::max(gap, last - chart.node(*id).way_m);
    last = chart.node(*id).way_m;
  }
  return gap;
}

}  // namespace

/// What the last landmark of the wall says of a loop.
void Follower::judge(const Node& node) {
  if (crossing_) {
    crossing_->to = node.id;
    crossing_->length_m = node.way_m - crossing_way_;
    crossing_->confidence = confidence_;
    crossing_->quarter_turns = node.quarter - crossing_quarter_;
    if (chart_.has(crossing_->from)) chart_.edges.push_back(*crossing_);
    crossing_.reset();
  }
  verdict_ = loops_.add(node);
  if (chart_.circuits.empty()) chart_.loop = verdict_.loop;
  chart_.note = verdict_.loop == Loop::uncertain
                    ? "the wall reads like an earlier part of it, and it may be another one"
                    : "";
  if (verdict_.loop != Loop::closed) {
    if (!is_leaving_room_ && has_turned_round()) {
      is_leaving_room_ = true;
      news_.push_back("the wall has turned round on a short way, and the robot leaves");
    }
    return;
  }
  if (is_side_room()) {
    leave_room();
    return;
  }
  if (verdict_.circuit) {
    join();
  } else {
    close();
  }
  plan();
}

/// The wall leads back to its beginning.
void Follower::close() {
  const std::span<const Node> wall = chart_.wall();
  const std::vector<SameLandmark> same = from_surest(chart_, verdict_.same);
  const Node& first = wall[first_sight(same, same.back().again)];
  const double from = wall[same.front().first].way_m, to = wall[same.front().again].way_m;
  closing_ = Closing{first.id, wall.back().t_ns, wall.back().body};
  station_m_ = first.way_m - from;
  const int turns = wall[same.front().again].quarter - wall[same.front().first].quarter;
  const Vec2 correction = close_loop(chart_, verdict_.same, options_);
  explorer_.close(from, to, correction, turns > 0);
  circuit_ = chart_.circuits.size() - 1;
  news_.push_back("wall " + std::to_string(*circuit_) +
                  " is closed: " + std::to_string(chart_.circuits.back().lap.size()) + " landmarks on " +
                  std::to_string(chart_.circuits.back().length_m) + " m");
  correct({Vec2::Zero(), correction, 0});
}

/// The wall is a known one.
void Follower::join() {
  circuit_ = verdict_.circuit;
  const Circuit& circuit = chart_.circuits[*circuit_];
  station_m_ = chart_.node(circuit.lap[verdict_.same.back().first]).way_m - circuit.begin_m;
  correct(join_circuit(chart_, *circuit_, verdict_.same));
  explorer_.begin();
  news_.push_back("the wall is wall " + std::to_string(*circuit_));
}

void Follower::correct(const Correction& by) {
  const double turn = by.turns * kQuarter;
  const auto corrected = [&](const Place& place) { return Place{by.of(place.at), place.heading + turn}; };
  const Place here = corrected(odometer_.charted());
  odometer_.place(here.at, here.heading);
  last_right_.from = corrected(last_right_.from);
  swept_.from = corrected(swept_.from);
  station_way_ = matched_way_ = odometer_.way_m();
}

void Follower::begin_wall() {
  is_leaving_room_ = false;
  circuit_.reset();
  route_.reset();
  chart_.wall_begin = chart_.nodes.size();
  loops_.begin(chart_);
  explorer_.begin();
  is_opening_charted_ = true;
  edge_node_.reset();
}

/// A landmark of a known wall says where the robot is on it.
void Follower::localise(const Node& node) {
  const Circuit& circuit = chart_.circuits[*circuit_];
  const double way = node.way_m - station_way_;
  const double within = kSameLandmark + kWayError * std::abs(way) + landing_error_m_;
  const auto index = landmark_at(chart_, circuit, node, station_m_ + way, within);
  if (!index) return;
  landing_error_m_ = 0.0;
  Node& known = chart_.node(circuit.lap[*index]);
  ++known.visits;
  ++chart_.changes;
  station_m_ = known.way_m - circuit.begin_m;
  correct({node.at, known.at, 0});
  station_way_ = node.way_m;
}

void Follower::plan() {
  const double station = station_m_ + odometer_.way_m() - station_way_;
  route_ = explorer_.next(*circuit_, station, static_cast<Exploration>(options_.exploration));
  if (!route_) {
    finish(left_open());
    return;
  }
  const Exit& exit = explorer_.exits()[route_->exit];
  exit_way_ = odometer_.way_m() + route_->way_m;
  news_.push_back("next is the exit at landmark " + (exit.node ? std::to_string(*exit.node) : "?") +
                  " of wall " + std::to_string(*circuit_) +
                  (exit.turn > 0   ? " to the left"
                   : exit.turn < 0 ? " to the right"
                                   : " ahead") +
                  (route_->landing ? ", on the way to a farther one" : ""));
  chart_.note = "exits that are not explored: " + std::to_string(explorer_.left());
}

void Follower::finish(const std::string& note) {
  chart_.note = note;
  ++chart_.changes;
  news_.push_back(note.empty() ? "no exit is left" : note);
  enter(State::done);
}

/// On the way to an exit: whether the robot has missed it, or follows another wall than it thinks.
void Follower::check_tour() {
  if (state_ == State::done) return;
  if (chart_.nodes.size() >= static_cast<std::size_t>(options_.most_nodes)) {
    finish("the chart is full");
    return;
  }
  if (!circuit_) {
    const std::span<const Node> wall = chart_.wall();
    if (!chart_.circuits.empty() && !wall.empty() &&
        std::abs(wall.back().quarter - wall.front().quarter) >= kMostTurns)
      give_up_wall();
    return;
  }
  if (is_crossing()) return;
  const double lost = std::max(kLost, 1.5 * longest_gap(chart_, chart_.circuits[*circuit_]));
  if (odometer_.way_m() - matched_way_ > lost) {
    if (route_) explorer_.miss_exit(route_->exit);
    begin_wall();
    news_.push_back("this is not the wall that was expected");
    return;
  }
  if (odometer_.way_m() > exit_way_ + kPassed + 0.05 * (exit_way_ - station_way_)) {
    explorer_.miss_exit(route_->exit);
    plan();
  }
}

/// A wall that turns round and round, and whose landmarks do not repeat themselves, is one of a room in which the robot was lost. It leaves through the next opening.
void Follower::give_up_wall() {
  if (++given_up_ > kMostGivenUp) {
    finish(left_open());
    return;
  }
  begin_wall();
  is_leaving_room_ = true;
  news_.push_back(
      "the wall has turned round three times, and does not read like an earlier part of it: the robot "
      "leaves");
}

std::string Follower::left_open() const {
  return given_up_ == 0
             ? ""
             : "walls that turned round three times and did not read like an earlier part of themselves: " +
                   std::to_string(given_up_);
}

bool Follower::is_crossing() const {
  const auto is_one = [](State state) { return state == State::cross || state == State::retreat; };
  const bool is_bumped =
      state_ == State::back_off || state_ == State::veer || (state_ == State::turn && next_ == State::veer);
  return is_one(state_) || (state_ == State::turn && is_one(next_)) || (is_bumped && is_one(interrupted_));
}

/// Whether the robot stands at the exit that it wants to leave by.
bool Follower::leaves_here() const {
  if (!circuit_ || !route_) return false;
  const Exit& exit = explorer_.exits()[route_->exit];
  const int quarter = odometer_.quarter(wall_.slant(odometer_.reckoned()));
  if ((quarter - exit.quarter) % kWholeTurn != 0) return false;
  const double station = station_m_ + odometer_.way_m() - station_way_;
  const double ahead =
      std::remainder(explorer_.station_m(exit) - station, chart_.circuits[*circuit_].length_m);
  return std::abs(ahead) < kAtExit && (odometer_.charted().at - exit.from).norm() < kNearExit;
}

void Follower::leave() {
  const Exit& exit = explorer_.exits()[route_->exit];
  if (!route_->landing) {
    if (exit.node) crossing_ = Edge{*exit.node, 0, 0.0, 1.0, 0, true};
    crossing_way_ = odometer_.way_m();
    crossing_quarter_ = exit.quarter;
    confidence_ = 1.0;
  }
  is_opening_charted_ = true;
  opening_ = Opening::hallway;
  is_through_ = exit.turn < 0;
  const double direction = wall_.direction() + exit.turn * kQuarter;
  const Place& here = odometer_.reckoned();
  settles_ = rounds_ = 0;
  if (exit.turn != 0) {
    turn_to(direction, State::cross);
  } else {
    enter(State::cross);
  }
  wall_.expect(here.at + options_.distance_m * unit(direction - kQuarter), direction);
  if (!route_->landing) explorer_.try_exit(route_->exit);
}

/// Whether there are walls to the left and to the right that are not farther from each other than a doorway is wide.
bool Follower::is_in_doorway() const {
  const Mount& left = body_.infrared[kLeft];
  const Mount& right = body_.infrared[kRight];
  const double width = left.point(range_m(kLeft)).y() - right.point(range_m(kRight)).y();
  return width < options_.longest_pass_m;
}

/// The robot is at the other wall.
void Follower::arrive() {
  if (!route_ || !route_->landing) {
    begin_wall();
    return;
  }
  circuit_ = route_->landing->circuit;
  station_m_ = route_->landing->station_m;
  landing_error_m_ = kLandingError;
  station_way_ = matched_way_ = odometer_.way_m();
  plan();
}

Command Follower::cross() {
  if (front_is_blocked()) {
    arrive();
    corner_ahead(false);
    return {};
  }
  if (in_state() > kLeastDoorway && is_in_doorway() && !is_through_) {
    enter(State::retreat);
    return {};
  }
  if (in_state() > kLeastCrossing && is_right_again_ && odometer_.way_m() - right_again_way_ > kIsWall) {
    arrive();
    if (state_ == State::done) return {};
    wall_.expect(last_right_.at, odometer_.reckoned().heading);
    after_turn_ = true;
    enter(State::settle);
    return {};
  }
  return along(options_.speed_m_s);
}

/// Rooms are not entered: the wall that the doorway is in is followed from the doorway on.
Command Follower::retreat() {
  if (-in_state() < options_.distance_m && seconds_in_state() < 6.0) return {-0.7 * options_.speed_m_s, 0.0};
  arrive();
  if (state_ == State::done) return {};
  const Place& here = odometer_.reckoned();
  const double direction = wall_.direction() + kQuarter;
  turn_to(direction, State::seek);
  wall_.expect(here.at + options_.distance_m * unit(direction - kQuarter), direction);
  return {};
}

}  // namespace hallway::wall_follower
