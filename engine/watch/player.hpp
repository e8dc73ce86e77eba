// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "watch/moment.hpp"

namespace hallway::watch {

/// Shows moments one after the other in the robot's time, faster or slower, and stops, steps and jumps among them. It keeps the last kKept; older ones
/// come again from a log. Times `now_ns` are of any steady clock.
class Player {
 public:
  /// What a player lacks to go on.
  enum class Need {
    kNothing,
    kNewer,  ///< add() the moment after the last, or end()
    kOlder,  ///< restart(), and all moments again from the first one
  };

  /// @param speed      seconds of the robot's time in a second, above 0
  /// @param can_restart  false: of a run that goes on, older moments do not come again
  Player(double speed, bool can_restart) : speed_(speed), can_restart_(can_restart) {}

  /// Takes the moment after the last one.
  void add(Moment moment);
  /// No more moments come.
  void end() { ended_ = true; }
  void restart();

  /// Goes on as far as it is time. The first moment is shown at once.
  Need advance(std::int64_t now_ns);
  /// How long advance() has nothing to do, from 0 on; nothing: until a key is pressed.
  std::optional<std::int64_t> wait_ns(std::int64_t now_ns) const;

  /// Null before the first one.
  const Moment* shown() const { return moments_.empty() ? nullptr : &moments_[index_]; }
  bool paused() const { return paused_; }
  /// Whether the last moment is shown.
  bool at_end() const { return ended_ && index_ + 1 >= moments_.size(); }
  double speed() const { return speed_; }

  void toggle_pause();
  /// One moment ahead (1) or back (-1), and a pause there.
  void step(int direction);
  /// Seconds of the robot's time ahead or back.
  void skip(double seconds);
  void go_to_first();
  void go_to_last();
  /// Twice or half as fast, between 1/16 and 4096.
  void change_speed(double factor);

  static constexpr std::size_t kKept = 1000;

 private:
  std::uint64_t number() const { return first_ + index_; }
  /// Where a jump leads among the moments that are kept; nothing where it is behind them.
  std::optional<std::size_t> index_of_goal() const;
  bool goal_is_older() const;
  std::int64_t due_ns(std::size_t index) const;
  void jump_to(std::size_t index);

  /// Where to jump: to the moment of a number, or the first one at a time or after it.
  struct Goal {
    std::optional<std::uint64_t> number{};
    std::int64_t t_ns = 0;
  };

  std::deque<Moment> moments_;
  std::uint64_t first_ = 0;  ///< number of the first one that is kept
  std::size_t index_ = 0;    ///< that is shown
  double speed_;
  bool can_restart_;
  bool paused_ = false;
  bool ended_ = false;
  std::optional<Goal> goal_;
  std::optional<std::int64_t> shown_at_ns_;  ///< when the moment of `anchor_ns_` was shown
  std::int64_t anchor_ns_ = 0;
};

}  // namespace hallway::watch
