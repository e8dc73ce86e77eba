// SPDX-License-Identifier: MIT
#include "sim/driven_robot.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "base/text.hpp"
#include "contact/patch.hpp"
#include "sim/recorded_commands.hpp"

namespace hallway::sim {
namespace {

constexpr std::int64_t kSlice_ns = 50'000'000;
constexpr double kVisited_m = 0.1;
constexpr std::size_t kMostCommands = 1000;  // of a table within one period
constexpr double kPathPoint_m = 0.02;        // from point to point of a path that is followed

/// How far back in time readings are taken.
std::int64_t history_of(const Scenario& scenario) {
  std::int64_t kept_ns = 0;
  for (const SensorSpec& sensor : scenario.sensors) {
    const sense::SensorTiming timing = std::visit([](const auto& spec) { return spec.timing; }, sensor);
    const std::int64_t latency_ns = std::llround(timing.latency_s * 1e9);
    kept_ns = std::max(kept_ns, latency_ns + sense::interval_ns(timing, scenario.period_ns));
  }
  return kept_ns + 2 * scenario.period_ns;
}

double wanted_speed(const Scenario& scenario, const map::Path& path) {
  const RobotSpec& robot = scenario.robot;
  if (robot.loop_steps)
    return path.length_m() / (static_cast<double>(*robot.loop_steps) * scenario.period_s());
  return robot.speed_m_s.value_or(0.0);
}

drive::Follower make_follower(const Scenario& scenario, const map::Path& path) {
  std::vector<Vec3> points;
  const auto n = static_cast<std::size_t>(std::ceil(path.length_m() / kPathPoint_m));
  const std::size_t end = path.closed() ? n : n + 1;  // the last one is the first again
  for (std::size_t i = 0; i < end; ++i)
    points.push_back(path.at(path.length_m() * static_cast<double>(i) / static_cast<double>(n)).t);
  const DrivenSpec& driven = *scenario.robot.driven;
  try {
    return {points,
            driven.drive,
            {.look_ahead_m = driven.look_ahead_m,
             .speed_m_s = wanted_speed(scenario, path),
             .period_s = scenario.period_s(),
             .closed = path.closed()}};
  } catch (const Error& error) {
    throw Error(
        ErrorCode::kBadInput, error.what(),
        {.file = printable(scenario.file), .element = "path `" + printable(scenario.robot.path) + "`"});
  }
}

/// Throws Error{kBadInput} for more commands in a period than a robot is moved by.
drive::CommandTable commands_of(const DrivenSpec& spec, std::int64_t period_ns) {
  drive::CommandTable table = read_commands(spec.commands, spec.drive.latency_ns);
  const auto& commands = table.commands();
  for (std::size_t i = kMostCommands; i < commands.size(); ++i) {
    if (commands[i].t_ns - commands[i - kMostCommands].t_ns >= period_ns) continue;
    throw Error(ErrorCode::kBadInput,
                "more than " + std::to_string(kMostCommands) + " commands within one period",
                {.file = printable(spec.commands.string()), .line = static_cast<int>(i) + 2});
  }
  return table;
}

}  // namespace

DrivenRobot::DrivenRobot(const DrivenWorld& world, const Scenario& scenario, const map::Path& path)
    : world_(world),
      spec_(*scenario.robot.driven),
      events_(scenario.events),
      period_ns_(scenario.period_ns),
      kept_ns_(history_of(scenario)),
      has_zones_(!scenario.bump_zones.empty()),
      robot_(world.obstacles(), world.robot()),
      drive_(spec_.drive, scenario.seed),
      wheels_(drive::wheel_count(spec_.drive.kind)) {
  world.put_at_start(robot_);
  if (spec_.by == DrivenBy::kPath) follower_.emplace(make_follower(scenario, path));
  if (spec_.by == DrivenBy::kCommands) table_.emplace(commands_of(spec_, period_ns_));
  happen_until(0);
}

void DrivenRobot::give(std::int64_t t_ns, const drive::Command& command, CommandCause cause) {
  last_ = {drive_.command(t_ns, command), cause};
  given_ns_ = t_ns;
  ++counts_.commands;
  if (last_.obeyed.clamps.any_limit()) ++counts_.clamped;
  if (last_.obeyed.clamps.left_out) ++counts_.left_out;
}

CommandInForce DrivenRobot::follow() {
  give(now_ns(), follower_->next(pose_at(now_ns())).command, CommandCause::kPath);
  return last_;
}

/// Gives the commands of the table until the next frame. @return the one in force now
CommandInForce DrivenRobot::read_table() {
  CommandInForce now{last_.obeyed,
                     last_.cause == CommandCause::kNone ? CommandCause::kNone : CommandCause::kHeld};
  const auto& commands = table_->commands();
  const auto at_time = [](const drive::TimedCommand& command, std::int64_t t_ns) {
    return command.t_ns < t_ns;
  };
  auto next = std::lower_bound(commands.begin(), commands.end(), now_ns(), at_time);
  for (; next != commands.end() && next->t_ns < now_ns() + period_ns_; ++next) {
    give(next->t_ns, next->command, CommandCause::kCommands);
    if (next->t_ns == now_ns()) now = last_;
  }
  return now;
}

/// The plugins drive.
CommandInForce DrivenRobot::hold(const DriveAnswer& answer) {
  if (!answer.failed && answer.command) {
    failed_ns_.reset();
    stopped_by_.reset();
    give(now_ns(), *answer.command, CommandCause::kPlugin);
    return last_;
  }
  if (answer.failed && !failed_ns_) failed_ns_ = now_ns();
  if (last_.cause == CommandCause::kNone) return last_;
  if (stopped_by_) return {last_.obeyed, *stopped_by_};
  constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
  const std::int64_t failure_ns = failed_ns_ ? *failed_ns_ + spec_.watchdog_ns : kNever;
  const std::int64_t timeout_ns =
      spec_.command_timeout_ns > 0 ? given_ns_ + spec_.command_timeout_ns : kNever;
  const std::int64_t stop_ns = std::max(std::min(failure_ns, timeout_ns), now_ns());
  const CommandInForce held{last_.obeyed, failed_ns_ ? CommandCause::kWatchdog : CommandCause::kHeld};
  if (stop_ns >= now_ns() + period_ns_) return held;
  stopped_by_ = failure_ns <= timeout_ns ? CommandCause::kFailure : CommandCause::kTimeout;
  last_.obeyed = drive_.halt(stop_ns);
  ++counts_.stops;
  return stop_ns > now_ns() ? held : CommandInForce{last_.obeyed, *stopped_by_};
}

CommandInForce DrivenRobot::obey(const DriveAnswer& answer) {
  switch (spec_.by) {
    case DrivenBy::kPath:
      return follow();
    case DrivenBy::kCommands:
      return read_table();
    default:
      return hold(answer);
  }
}

/// Of the period that comes: slices of at most 50 ms, which end where an event happens and where one is over.
std::vector<std::int64_t> DrivenRobot::slice_ends() const {
  const std::int64_t begin_ns = now_ns(), end_ns = begin_ns + period_ns_;
  const std::int64_t slices = (period_ns_ + kSlice_ns - 1) / kSlice_ns;
  std::vector<std::int64_t> ends;
  for (std::int64_t i = 1; i <= slices; ++i) ends.push_back(begin_ns + period_ns_ * i / slices);
  const auto cut = [&](std::int64_t t_ns) {
    if (t_ns > begin_ns && t_ns < end_ns) ends.push_back(t_ns);
  };
  cut(blocked_until_ns_);
  for (std::size_t i = next_event_; i < events_.size() && events_[i].t_ns < end_ns; ++i) {
    cut(events_[i].t_ns);
    if (events_[i].kind == EventKind::kWheelsBlocked) cut(events_[i].t_ns + events_[i].duration_ns);
  }
  std::ranges::sort(ends);
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

void DrivenRobot::happen(const EventSpec& event, std::size_t index) {
  switch (event.kind) {
    case EventKind::kKidnap:
      world_.carry(robot_, index);
      drive_.stop();
      break;
    case EventKind::kPush:
      robot_.push(event.twist, event.duration_ns);
      break;
    case EventKind::kWheelsBlocked:
      blocked_until_ns_ = std::max(blocked_until_ns_, event.t_ns + event.duration_ns);
      drive_.stop();
      break;
    default:
      break;  // of sensors, which the simulator switches
  }
}

void DrivenRobot::happen_until(std::int64_t t_ns) {
  for (; next_event_ < events_.size() && events_[next_event_].t_ns <= t_ns; ++next_event_) {
    happen(events_[next_event_], next_event_);
    if (events_[next_event_].kind == EventKind::kKidnap) advance_.touching.clear();
  }
}

/// Goes on to the end of a slice.
void DrivenRobot::move(std::int64_t to_ns, std::vector<TwistRamp>& ramps) {
  ramps.clear();
  if (to_ns <= blocked_until_ns_) {
    const std::int64_t duration_ns = to_ns - drive_.present_ns();
    drive_.advance(to_ns);
    drive_.stop();
    ramps.push_back({{}, {}, duration_ns});
    wheels_.add({.duration_ns = duration_ns});
    return;
  }
  for (const drive::Motion& motion : drive_.advance(to_ns)) {
    ramps.push_back(motion.body);
    wheels_.add(motion.wheels);
  }
}

const contact::Advance& DrivenRobot::advance() {
  advance_ = {};
  std::vector<TwistRamp> ramps;
  for (const std::int64_t end_ns : slice_ends()) {
    move(end_ns, ramps);
    contact::Advance slice = robot_.advance(ramps);
    if (!slice.touching.empty() && !robot_.is_pushed()) drive_.set_twist(robot_.twist());
    note_contacts(slice.begun, true);
    note_contacts(slice.touching, false);
    advance_.begun.insert(advance_.begun.end(), slice.begun.begin(), slice.begun.end());
    advance_.falls.insert(advance_.falls.end(), slice.falls.begin(), slice.falls.end());
    advance_.touching = std::move(slice.touching);
    happen_until(end_ns);
  }
  ++frame_;
  const std::int64_t oldest_ns = now_ns() - kept_ns_;
  robot_.forget_before(oldest_ns);
  wheels_.forget_before(oldest_ns);
  while (!contacts_.empty() && contacts_.front().t_ns < oldest_ns) contacts_.pop_front();
  std::array<std::int32_t, 3> place{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    place.at(axis) =
        static_cast<std::int32_t>(std::lround(robot_.pose().t[static_cast<Eigen::Index>(axis)] / kVisited_m));
  visited_.insert(place);
  return advance_;
}

/// @param at_their_time  they began in the last slice; else they last at its end
void DrivenRobot::note_contacts(const std::vector<contact::Touch>& touches, bool at_their_time) {
  for (const contact::Touch& touch : touches) {
    const std::int64_t t_ns = at_their_time ? touch.t_ns : robot_.now_ns();
    const auto later =
        std::upper_bound(contacts_.begin(), contacts_.end(), t_ns,
                         [](std::int64_t t, const PastContact& past) { return t < past.t_ns; });
    contacts_.insert(later,
                     {t_ns, {touch.point, touch.normal, touch.gap_m, pose_at(t_ns), patch_of(touch, t_ns)}});
  }
}

/// For the zones of a robot file, which may be at some height only.
std::vector<Vec3> DrivenRobot::patch_of(const contact::Touch& touch, std::int64_t t_ns) const {
  if (!has_zones_ || touch.kind != contact::TouchKind::kWall) return {};
  return contact::contact_patch(world_.robot().shape, robot_.history().pose_at(t_ns),
                                world_.obstacles().triangle(touch.obstacle), touch.point, touch.normal);
}

std::vector<sense::BumpContact> DrivenRobot::contacts_in(std::int64_t after_ns, std::int64_t until_ns) const {
  std::vector<sense::BumpContact> contacts;
  for (const PastContact& past : contacts_) {
    if (past.t_ns > after_ns && past.t_ns <= until_ns) contacts.push_back(past.contact);
  }
  return contacts;
}

Pose DrivenRobot::pose_at(std::int64_t t_ns) const {
  return robot_.history().pose_at(t_ns) * world_.T_floor_body();
}

sense::Kinematics DrivenRobot::kinematics_at(std::int64_t t_ns, double after_s, sense::Side side) const {
  const contact::PartMotion floor = robot_.history().motion_at(t_ns, after_s, side == sense::Side::kAfter);
  const Pose& T_floor_body = world_.T_floor_body();
  // Of the floor's frame in world axes; then at the body's origin, in the body's axes.
  const Vec3 arm = floor.pose.q * T_floor_body.t;
  const Vec3 &rate = floor.angular_velocity, &slope = floor.angular_acceleration;
  sense::Kinematics now;
  now.T_world_body = floor.pose * T_floor_body;
  now.velocity = floor.velocity + rate.cross(arm);
  now.acceleration = floor.acceleration + slope.cross(arm) + rate.cross(rate.cross(arm));
  now.angular_velocity = now.T_world_body.q.conjugate() * rate;
  now.angular_acceleration = now.T_world_body.q.conjugate() * slope;
  return now;
}

std::vector<double> DrivenRobot::breaks_in(std::int64_t begin_ns, std::int64_t end_ns) const {
  std::vector<double> breaks;
  for (const std::int64_t t_ns : robot_.history().joints_in(begin_ns, end_ns))
    breaks.push_back(static_cast<double>(t_ns - begin_ns) * 1e-9);
  return breaks;
}

bool DrivenRobot::is_moving() const {
  if (spec_.by != DrivenBy::kPlugin || last_.cause == CommandCause::kNone) return false;
  return !stopped_by_ || now_ns() < last_.obeyed.acts_from_ns || drive_.driven() != PlanarTwist{};
}

DriveCounts DrivenRobot::counts() const {
  DriveCounts counts = counts_;
  counts.distance_m = robot_.counts().distance_m;
  counts.contacts = robot_.counts().contacts;
  counts.falls = robot_.counts().falls;
  counts.stood_s = static_cast<double>(robot_.counts().stood_ns) / 1e9;
  const contact::ReachableFloor& floor = world_.floor();
  std::set<std::uint32_t> cells, rooms;
  for (const auto& place : visited_) {
    const Vec3 at = Vec3(place[0], place[1], place[2]) * kVisited_m;
    if (const auto cell = floor.cell_at(at)) cells.insert(*cell);
    if (const auto room = floor.room_at(at)) rooms.insert(*room);
  }
  counts.floor_cells = floor.n_cells();
  counts.cells_visited = cells.size();
  counts.rooms = floor.n_rooms();
  counts.rooms_entered = rooms.size();
  return counts;
}

}  // namespace hallway::sim
