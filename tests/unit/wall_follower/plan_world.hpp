// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "base/random.hpp"
#include "wall_follower/core/follower.hpp"

namespace hallway::wall_follower {

/// A wall of a plan.
struct Segment {
  Vec2 a, b;
  bool is_dark = false;  ///< infrared does not see it
};

/// A plan of walls, by lines that go on from point to point.
class Plan {
 public:
  /// Walls from each point to the next one.
  Plan& line(const std::vector<Vec2>& points, bool is_dark = false);
  /// Likewise, and from the last one to the first.
  Plan& ring(std::vector<Vec2> points, bool is_dark = false);
  /// The sides of a rectangle.
  Plan& box(double x0, double y0, double x1, double y1, bool is_dark = false);

  const std::vector<Segment>& segments() const { return segments_; }

 private:
  std::vector<Segment> segments_;
};

/// What is wrong with the robot.
struct Faults {
  double false_share = 0.0;   ///< of infrared readings: something where there is nothing
  double missed_share = 0.0;  ///< of infrared readings: nothing where there is something
  double range_sigma = 0.0;   ///< share of an infrared range
  double slip = 0.25;         ///< share of a turn that the tracks lose
  double slip_sigma = 0.0;    ///< what it differs by from turn to turn
  double lost_pings = 0.0;    ///< share of pings without an echo
};

/// The stated rates.
Faults stated_faults();

/// The first robot (thesis 2.2.3) as a disc in a plan: five infrared detectors at 25 Hz, a sonar of 24 pings a sweep, bump zones and encoders. Frames are 0.1 s apart.
class PlanWorld {
 public:
  PlanWorld(const Plan& plan, const Place& start, const Faults& faults, std::uint64_t seed);

  static Body body();
  /// What the robot knows at the present frame.
  const Senses& senses() const { return senses_; }
  /// Obeys a command for 0.1 s.
  void move(const Command& command);

  const Place& truth() const { return truth_; }
  /// Where the robot was in a frame.
  Place truth_at(std::int64_t t_ns) const { return track_.at(t_ns); }
  double seconds() const { return 1e-9 * static_cast<double>(senses_.t_ns); }

 private:
  double hit(const Vec2& from, const Vec2& direction, const Segment** met, double reach) const;
  double infrared(const Mount& mount);
  double ping(double direction);
  void slide(const Vec2& step);
  double chance() { return random_.uniform(0, drawn_++); }
  double normal() { return random_.normal(1, drawn_++); }

  std::vector<Segment> segments_;
  Place truth_;
  Faults faults_;
  Random random_;
  std::uint64_t drawn_ = 0;
  Senses senses_;
  Sweep sweeping_;
  std::map<std::int64_t, Place> track_;
  std::int64_t t_ns_ = 0;
  std::int64_t tick_ = 0;
  double speed_ = 0.0, rate_ = 0.0;
  double slip_ = 0.25;
  bool is_turning_ = false;
};

/// A follower that has driven in a world.
struct Drive {
  PlanWorld world;
  Follower follower;

  Drive(const Plan& plan, const Place& start, const Faults& faults = {}, std::uint64_t seed = 1,
        const Options& options = {});
  /// Drives until it is done or the time is over.
  void run(double seconds, const std::function<void()>& each = nullptr);
  /// Where a node truly is.
  Vec2 place_of(const Node& node) const { return world.truth_at(node.t_ns).out(node.body); }
  /// How far what closed the loop is from what it was taken as [m]; NaN where no loop was closed.
  double closing_error() const;
};

}  // namespace hallway::wall_follower
