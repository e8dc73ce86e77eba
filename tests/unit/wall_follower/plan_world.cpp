// SPDX-License-Identifier: MIT
#include "unit/wall_follower/plan_world.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hallway::wall_follower {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kRadius = 0.18;
constexpr double kReach = 0.8;        // of infrared [m]
constexpr double kSonarReach = 10.0;  // [m]
constexpr double kTick = 0.02;        // [s]
constexpr std::int64_t kTickNs = 20'000'000;
constexpr int kPings = 24;
constexpr std::int64_t kSweepNs = 1'200'000'000;
constexpr std::int64_t kSweepEveryNs = 1'240'000'000;

double approach(double value, double target, double most) {
  return value + std::clamp(target - value, -most, most);
}

Vec2 nearest(const Segment& segment, const Vec2& point) {
  const Vec2 d = segment.b - segment.a;
  const double s = std::clamp((point - segment.a).dot(d) / d.squaredNorm(), 0.0, 1.0);
  return segment.a + s * d;
}

}  // namespace

Plan& Plan::line(const std::vector<Vec2>& points, bool is_dark) {
  for (std::size_t i = 1; i < points.size(); ++i) segments_.push_back({points[i - 1], points[i], is_dark});
  return *this;
}

Plan& Plan::ring(std::vector<Vec2> points, bool is_dark) {
  points.push_back(points.front());
  return line(points, is_dark);
}

Plan& Plan::box(double x0, double y0, double x1, double y1, bool is_dark) {
  return ring({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, is_dark);
}

Faults stated_faults() {
  Faults faults;
  faults.false_share = 0.02;
  faults.missed_share = 0.02;
  faults.range_sigma = 0.05;
  faults.slip_sigma = 0.1;
  faults.lost_pings = 0.05;
  return faults;
}

PlanWorld::PlanWorld(const Plan& plan, const Place& start, const Faults& faults, std::uint64_t seed)
    : segments_(plan.segments()),
      truth_(start),
      faults_(faults),
      random_(seed, stream_id("plan_world")),
      slip_(faults.slip) {
  track_[0] = truth_;
}

Body PlanWorld::body() {
  Body body;
  body.infrared[kLeft] = {{0.0, 0.14}, radians(90)};
  body.infrared[kFrontLeft] = {{0.13, 0.11}, radians(45)};
  body.infrared[kFront] = {{0.16, 0.0}, 0.0};
  body.infrared[kFrontRight] = {{0.13, -0.11}, radians(-45)};
  body.infrared[kRight] = {{0.0, -0.14}, radians(-90)};
  body.wheel_base_m = 0.24;
  return body;
}

double PlanWorld::hit(const Vec2& from, const Vec2& direction, const Segment** met, double reach) const {
  double best = reach;
  for (const Segment& segment : segments_) {
    const Vec2 d = segment.b - segment.a, o = segment.a - from;
    const double det = direction.y() * d.x() - direction.x() * d.y();
    if (std::abs(det) < 1e-12) continue;
    const double t = (d.x() * o.y() - d.y() * o.x()) / det;
    const double s = (direction.x() * o.y() - direction.y() * o.x()) / det;
    if (s < 0.0 || s > 1.0 || t < 0.0 || t >= best) continue;
    best = t;
    *met = &segment;
  }
  return best;
}

double PlanWorld::infrared(const Mount& mount) {
  const bool is_false = chance() < faults_.false_share;
  const double false_range = 0.1 + 0.7 * chance();
  const bool is_missed = chance() < faults_.missed_share;
  const double noise = 1.0 + faults_.range_sigma * normal();
  if (is_false) return false_range;
  const Segment* met = nullptr;
  const double range = hit(truth_.out(mount.place), unit(truth_.heading + mount.direction), &met, kReach);
  if (met == nullptr || met->is_dark || is_missed) return kInfinite;
  if (range < 0.1) return std::nan("");
  return range * noise < kReach ? range * noise : kInfinite;
}

double PlanWorld::ping(double direction) {
  if (chance() < faults_.lost_pings) return kInfinite;
  double best = kInfinite;
  for (double off = -15.0; off <= 15.0; off += 2.5) {
    const Segment* met = nullptr;
    const Vec2 ray = unit(truth_.heading + direction + radians(off));
    const double range = hit(truth_.at, ray, &met, kSonarReach);
    if (met == nullptr || range < 0.27) continue;
    const Vec2 d = (met->b - met->a).normalized();
    const double upright = std::abs(d.x() * ray.y() - d.y() * ray.x());
    if (upright > std::cos(radians(35.0))) best = std::min(best, range);
  }
  return best;
}

void PlanWorld::slide(const Vec2& step) {
  Vec2 at = truth_.at + step;
  for (int round = 0; round < 4; ++round) {
    for (const Segment& segment : segments_) {
      const Vec2 off = at - nearest(segment, at);
      const double distance = off.norm();
      if (distance >= kRadius || distance < 1e-9) continue;
      at += (kRadius - distance) * off / distance;
      const double side = wrapped(std::atan2(-off.y(), -off.x()) - truth_.heading);
      if (side >= 0.0 && side <= radians(60)) senses_.bump.left = true;
      if (side <= 0.0 && side >= radians(-60)) senses_.bump.right = true;
    }
  }
  truth_.at = at;
}

void PlanWorld::move(const Command& command) {
  for (auto& readings : senses_.infrared) readings.clear();
  senses_.sweep.reset();
  senses_.bump = {};
  const bool turns = std::abs(command.left_rad_s) > 0.3;
  if (turns && !is_turning_) slip_ = std::clamp(faults_.slip + faults_.slip_sigma * normal(), 0.0, 0.7);
  is_turning_ = turns;
  const Body robot = body();
  for (int i = 0; i < 5; ++i) {
    speed_ = approach(speed_, std::clamp(command.forward_m_s, -0.4, 0.4), 1.0 * kTick);
    rate_ = approach(rate_, std::clamp(command.left_rad_s, -3.3, 3.3), 4.0 * kTick);
    t_ns_ += kTickNs;
    ++tick_;
    senses_.left_m += (speed_ - 0.5 * robot.wheel_base_m * rate_) * kTick;
    senses_.right_m += (speed_ + 0.5 * robot.wheel_base_m * rate_) * kTick;
    const double turn = rate_ * (1.0 - slip_) * kTick;
    slide(speed_ * kTick * unit(truth_.heading + 0.5 * turn));
    truth_.heading += turn;
    if (tick_ % 2 == 0) {
      for (std::size_t look = 0; look < kLooks; ++look)
        senses_.infrared[look].push_back(infrared(robot.infrared[look]));
    }
    const std::int64_t begin = t_ns_ / kSweepEveryNs * kSweepEveryNs;
    if (sweeping_.begin_ns != begin) sweeping_ = {begin, {}};
    while (static_cast<int>(sweeping_.pings.size()) < kPings &&
           begin + static_cast<std::int64_t>(sweeping_.pings.size()) * kSweepNs / kPings <= t_ns_) {
      const double direction = radians(15.0 * static_cast<double>(sweeping_.pings.size()));
      sweeping_.pings.push_back({direction, ping(direction)});
      if (static_cast<int>(sweeping_.pings.size()) == kPings) senses_.sweep = sweeping_;
    }
  }
  senses_.t_ns = t_ns_;
  track_[t_ns_] = truth_;
}

Drive::Drive(const Plan& plan, const Place& start, const Faults& faults, std::uint64_t seed,
             const Options& options)
    : world(plan, start, faults, seed), follower(PlanWorld::body(), options) {}

void Drive::run(double seconds, const std::function<void()>& each) {
  const double end = world.seconds() + seconds;
  while (world.seconds() < end && follower.state() != State::done) {
    world.move(follower.step(world.senses()));
    if (each) each();
  }
}

double Drive::closing_error() const {
  if (!follower.closing()) return std::nan("");
  const Node& node = follower.chart().node(follower.closing()->node);
  return (world.truth_at(follower.closing()->t_ns).out(follower.closing()->body) - place_of(node)).norm();
}

}  // namespace hallway::wall_follower
