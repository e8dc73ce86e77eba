// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "wall_follower/core/chart.hpp"
#include "wall_follower/core/circuits.hpp"
#include "wall_follower/core/explorer.hpp"
#include "wall_follower/core/loop_finder.hpp"
#include "wall_follower/core/median_filter.hpp"
#include "wall_follower/core/odometer.hpp"
#include "wall_follower/core/options.hpp"
#include "wall_follower/core/senses.hpp"
#include "wall_follower/core/sweep_rule.hpp"
#include "wall_follower/core/wall.hpp"

namespace hallway::wall_follower {

/// What the robot does.
enum class State : std::uint8_t {
  start,     ///< stands until the detectors have read enough
  seek,      ///< goes ahead until it meets a wall
  follow,    ///< follows the wall on its right
  turn,      ///< turns on the spot
  settle,    ///< stands, to see how it stands to the wall
  advance,   ///< goes on past the end of the wall, into the middle of the opening
  sweep,     ///< stands until the sonar has swept
  pass,      ///< goes on past an opening to the wall behind it
  reverse,   ///< goes back to an opening behind which there was no wall
  round,     ///< goes on after a turn to the right, to the wall around the corner
  back_off,  ///< goes back from what it touched
  veer,      ///< goes past what it touched
  cross,     ///< goes from an exit to another wall
  retreat,   ///< goes back from a doorway into which it crossed
  done       ///< stands: no exit is left, or the chart is full
};

/// Speeds that the robot is to have.
struct Command {
  double forward_m_s = 0.0;
  double left_rad_s = 0.0;  ///< turn to the left, of the tracks
};

/// How a loop was closed.
struct Closing {
  std::uint32_t node = 0;    ///< id of the landmark that was seen again last
  std::int64_t t_ns = 0;     ///< of the frame in which it was
  Vec2 body = Vec2::Zero();  ///< where it was in the body frame then
};

/// Follows the wall on its right and charts it (thesis 2.2.4): discontinuities by infrared, openings by a sweep of the sonar while it stands. Rooms are passed, into hallways it turns right. It is done when the
/// chart's string of landmarks closes a loop and no exit is left that leads to a wall which is not known.
class Follower {
 public:
  Follower(const Body& body, const Options& options);

  /// One iteration. @return what to do until the next one
  Command step(const Senses& senses);

  const Chart& chart() const { return chart_; }
  State state() const { return state_; }
  const Odometer& odometer() const { return odometer_; }
  const Wall& wall() const { return wall_; }
  /// Range of a detector, free of single false readings; infinite where it sees nothing [m].
  double range_m(Look look) const { return filters_[look].range_m(); }
  /// Of the loop that was closed last.
  const std::optional<Closing>& closing() const { return closing_; }
  const Explorer& explorer() const { return explorer_; }
  /// What has happened in the last iteration that is worth a line in a log.
  const std::vector<std::string>& news() const { return news_; }
  /// Whether the wall on its right is a known one.
  bool is_touring() const { return circuit_.has_value(); }
  int bumps() const { return bumps_; }
  int sweeps() const { return sweeps_; }
  /// What the last sweep saw of an opening, and what it leads to.
  const OpeningView& last_view() const { return view_; }
  Opening last_opening() const { return opening_; }
  /// Scores of the best and the next best place at which the last landmark was seen before.
  double loop_score() const { return verdict_.score; }
  double other_score() const { return verdict_.other; }

 private:
  void sense(const Senses& senses);
  void look_right();
  bool is_straight();
  void align();
  void chart_step(const Step& step);
  Command act(const Senses& senses);

  Command start();
  Command seek();
  Command follow();
  Command turn();
  Command settle();
  Command advance();
  Command sweep(const Senses& senses);
  Command pass();
  Command reverse();
  Command round();
  Command back_off();
  Command veer();
  Command cross();
  Command retreat();
  void arrive();
  bool is_in_doorway() const;

  // What follows a loop (follower_tour.cpp).
  void judge(const Node& node);
  void close();
  void join();
  bool is_side_room() const;
  bool has_turned_round() const;
  void leave_room();
  void take_back_lap(const Node& first_sight, const Node& second_sight, std::size_t kept);
  void open_door();
  void begin_wall();
  void localise(const Node& node);
  void plan();
  void finish(const std::string& note);
  void give_up_wall();
  /// What the note says of walls that were given up.
  std::string left_open() const;
  bool leaves_here() const;
  /// Whether it is between two walls.
  bool is_crossing() const;
  void blocked_after_bump();
  void leave();
  void check_tour();
  void correct(const Correction& by);

  void enter(State state);
  void turn_to(double heading, State next);
  void corner_ahead(bool charted);
  void wall_ended();
  void wall_again();
  void turn_right();
  bool is_wall_again() const;
  /// How far the robot is past the end of the wall, along the wall [m].
  double past_edge() const;
  void look_for_jamb();
  void add_opening(Kind kind);
  void hide_edge();
  void bumped(const Bump& bump);
  void scraped(const Bump& bump);
  /// @return the id of the landmark; empty where it is of a known wall
  std::optional<std::uint32_t> add_node(Kind kind, const WallPoint& at, double way_m, int direction,
                                        double size_m);
  void add_node_here(Kind kind, const Vec2& body);

  /// Along the wall's line at the distance asked for.
  Command along(double speed_m_s) const;
  Command turn_by(double rate_rad_s) const;
  bool front_is_blocked() const { return range_m(kFront) < options_.front_m; }
  bool sees_right() const { return range_m(kRight) < options_.gone_m; }
  double gone_way() const { return odometer_.way_m() - last_right_.way_m; }
  double in_state() const { return odometer_.way_m() - entered_way_; }
  double seconds_in_state() const { return 1e-9 * static_cast<double>(t_ns_ - entered_ns_); }
  double middle_distance() const;

  Body body_;
  Options options_;
  Odometer odometer_;
  std::array<MedianFilter, kLooks> filters_;
  Wall wall_;
  Chart chart_;
  LoopFinder loops_;
  LoopVerdict verdict_;
  std::optional<Closing> closing_;
  std::vector<std::string> news_;
  Explorer explorer_;
  std::optional<std::size_t> circuit_;  // the known wall that is followed
  double station_m_ = 0.0;              // on it, where the last landmark was
  double station_way_ = 0.0;            // way then
  bool is_leaving_room_ = false;        // through the next opening
  int given_up_ = 0;                    // walls whose landmarks did not repeat themselves
  double landing_error_m_ = 0.0;        // of the station, until a landmark is known
  double matched_way_ = 0.0;            // way where a landmark was a known one last
  double exit_way_ = 0.0;               // way at which the exit is expected
  std::optional<Route> route_;
  bool is_through_ = false;       // the crossing leads through an opening
  std::optional<Edge> crossing_;  // that leads to the next landmark
  double crossing_way_ = 0.0;     // where it began
  int crossing_quarter_ = 0;

  State state_ = State::start;
  State next_ = State::follow;  // after a turn
  std::int64_t t_ns_ = 0, entered_ns_ = 0;
  double entered_way_ = 0.0;
  bool is_charting_ = false;      // since the first wall
  WallPoint last_right_;          // where the wall was seen last
  double right_again_way_ = 0.0;  // where it is seen again
  bool is_right_again_ = false;
  double target_ = 0.0;               // heading of a turn [rad]
  bool after_turn_ = false;           // the next alignment may correct a large error
  double straight_direction_ = 10.0;  // of the wall, since some way
  double straight_from_ = 0.0;
  int settles_ = 0;                // turns to align since the last corner
  int rounds_ = 0;                 // turns to the right in which no wall was found
  Vec2 edge_at_ = Vec2::Zero();    // where the wall ended
  double opening_distance_ = 0.0;  // of the robot from the wall's line there
  WallPoint swept_;                // the middle of the opening that was swept last
  bool is_opening_charted_ = true;
  std::optional<std::uint32_t> edge_node_;  // the end of the wall before it
  int jamb_votes_ = 0;                      // above 0: the wall goes on before a wall ahead
  OpeningView view_;
  Opening opening_ = Opening::hallway;
  double confidence_ = 1.0;     // of the way since the last node
  double keep_m_ = 0.0;         // distance from the wall that a bump asks for
  double keep_until_ = 0.0;     // way until which it does
  double scraped_ = 0.0;        // side on which the body touched something last: 1 left, -1 right
  double scraped_until_ = 0.0;  // way until which it keeps off
  double back_m_ = 0.0;
  bool back_is_forward_ = false;
  State interrupted_ = State::follow;
  double veer_ = 0.0;
  double bump_way_ = -1e9;
  int bumps_in_row_ = 0;
  int bumps_ = 0, sweeps_ = 0;
};

}  // namespace hallway::wall_follower
