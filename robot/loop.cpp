// SPDX-License-Identifier: MIT
#include "robot/loop.hpp"

#include <algorithm>
#include <utility>

#include "log/observations.hpp"

namespace hallway::robot {
namespace {

/// How long the loop waits for a frame before it looks around. The watchdog does not wait for it.
constexpr std::chrono::milliseconds kLongestWait{50};

/// For as long as `pose` lives.
hw_pose_output_t pose_of(const host::PoseOutput& pose) {
  hw_pose_output_t output{};
  output.size = sizeof output;
  output.status = pose.valid ? HW_POSE_VALID : HW_POSE_LOST;
  output.T_map_body = pose.T_map_body;
  output.covariance = pose.covariance ? pose.covariance->data() : nullptr;
  output.t_ns = pose.t_ns;
  return output;
}

hw_drive_command_t command_of(const host::DriveCommand& command) {
  hw_drive_command_t output{};
  output.size = sizeof output;
  output.linear_m_s = command.linear_m_s;
  output.angular_rad_s = command.angular_rad_s;
  output.lateral_m_s = command.lateral_m_s;
  return output;
}

}  // namespace

Loop::Loop(const Parts& parts, const LoopPlan& plan, LoopHooks hooks)
    : parts_(parts),
      plan_(plan),
      hooks_(std::move(hooks)),
      arrivals_(parts.driver, parts.robot, plan.backlog),
      command_timeout_(plan.command_timeout_ns) {}

LoopEnd Loop::run() {
  struct Stopper {
    Arrivals& arrivals;
    ~Stopper() { arrivals.stop(); }
  } stopper{arrivals_};
  return run_until_end();
}

LoopEnd Loop::run_until_end() {
  const Clock::time_point begin = Clock::now();
  for (;;) {
    if (hooks_.stop()) return LoopEnd::kInterrupt;
    if (plan_.duration && Clock::now() - begin >= *plan_.duration) return LoopEnd::kDuration;
    parts_.gate.check();
    tell();
    if (take_frame()) answer_frame();
    if (!alive_ && plan_.on_failure == host::OnFailure::kStop) return LoopEnd::kPlugin;
    if (arrivals_.ended() || counts_.iterations > log::kMaxIteration) return LoopEnd::kDriver;
  }
}

bool Loop::take_frame() {
  std::chrono::nanoseconds wait = kLongestWait;
  std::optional<Clock::time_point> tick;
  if (schedule_) {
    tick = schedule_->next(Clock::now());
    while (Clock::now() < *tick) {
      if (hooks_.stop()) return false;
      sleep_until(std::min(*tick, Clock::now() + kLongestWait));
    }
    wait = std::chrono::nanoseconds(0);
  }
  std::swap(arrival_.bytes, current_.bytes);
  const bool taken = arrivals_.take(wait, tick.has_value(), arrival_);
  std::swap(arrival_.bytes, current_.bytes);
  if (!taken) return false;
  host::set_frame_sequence(std::as_writable_bytes(std::span(current_.bytes)), counts_.iterations);
  const Clock::time_point now = Clock::now();
  if (plan_.tick && !schedule_) schedule_.emplace(now, *plan_.tick).next(now);
  due_from_ = tick.value_or(arrival_.came);
  parts_.gate.frame_came(arrival_.frame.sequence, arrival_.frame.t_ns, arrival_.came);
  current_.iteration = counts_.iterations;
  current_.t_ns = arrival_.frame.t_ns;
  return true;
}

void Loop::answer_frame() {
  const auto bytes = std::as_bytes(std::span(current_.bytes));
  const hw_frame_t& frame = reader_.read(bytes);
  current_.n_samples = frame.n_samples;
  samples_.add(frame);
  const host::Outputs* outputs = nullptr;
  std::optional<host::Verdict> failure;
  if (alive_) failure = record::catch_failure([&] { outputs = &parts_.pipeline.process(frame, bytes); });
  const Clock::time_point now = Clock::now();
  current_.answered = outputs != nullptr && parts_.pipeline.was_called();
  current_.restarts = failures_.restarts;
  if (outputs != nullptr) {
    hand_on(*outputs, now);
    current_.outputs = *outputs;
    current_.time = parts_.pipeline.last_call();
  } else {
    parts_.gate.fail(failure ? failure->message : "the plugins have failed", now);
    command_timeout_.forget();
  }
  parts_.recorder.add(current_);
  const std::uint32_t iteration = counts_.iterations++;
  if (failure) after_failure(std::move(*failure), iteration);
  if (alive_ && plan_.report_every_ns > 0 && frame.t_ns >= next_report_ns_) {
    next_report_ns_ = frame.t_ns + plan_.report_every_ns;
    ask_for_map();
  }
}

void Loop::hand_on(const host::Outputs& outputs, Clock::time_point now) {
  count(now);
  hw_answer_t answer{};
  answer.size = sizeof answer;
  hw_drive_command_t command{};
  hw_pose_output_t pose{};
  hw_landmarks_t landmarks{};
  hw_counters_t counters{};
  if (outputs.drive_command()) {
    command = command_of(*outputs.drive_command());
    answer.command = &command;
  } else if (command_timeout_.expires(current_.t_ns)) {
    command = command_of({});
    answer.command = &command;
    answer.message = "no new command within command_timeout_s";
  }
  if (outputs.pose()) {
    pose = pose_of(*outputs.pose());
    answer.pose = &pose;
  }
  if (map_) {
    landmarks = {sizeof landmarks, sizeof(hw_landmark_t), map_->size(), map_->data(), nullptr};
    answer.landmarks = &landmarks;
  }
  add_counters(outputs);
  counters = {sizeof counters, sizeof(hw_counter_t), counters_.size(), counters_.data()};
  answer.counters = &counters;
  const bool in_time = parts_.gate.answer(answer, now);
  if (!in_time) command_timeout_.forget();
  if (in_time && outputs.drive_command()) command_timeout_.obey(current_.t_ns);
  map_.reset();
}

void Loop::add_counters(const host::Outputs& outputs) {
  counters_.clear();
  for (const host::Counter& counter : outputs.counters())
    counters_.push_back({counter.name.c_str(), counter.value});
  const GateCounts gate = parts_.gate.counts();
  const IntakeCounts intake = arrivals_.counts();
  counters_.push_back({"hallway_frames_lost", static_cast<double>(intake.lost)});
  counters_.push_back({"hallway_frames_dropped", static_cast<double>(intake.dropped)});
  counters_.push_back({"hallway_deadline_misses", static_cast<double>(counts_.misses)});
  counters_.push_back({"hallway_watchdog_trips", static_cast<double>(gate.trips)});
}

void Loop::count(Clock::time_point now) {
  ++counts_.answered;
  counts_.latency.add(now - due_from_);
  if (plan_.deadline && now > due_from_ + *plan_.deadline) ++counts_.misses;
}

void Loop::after_failure(host::Verdict verdict, std::optional<std::uint32_t> iteration) {
  alive_ = false;
  if (plan_.on_failure != host::OnFailure::kStop) hooks_.notice(verdict.message);
  failures_.note(std::move(verdict), iteration);
  if (plan_.on_failure != host::OnFailure::kRestart) return;
  if (auto again = record::catch_failure([&] { parts_.pipeline.restart(); })) {
    failures_.note(std::move(*again), std::nullopt);
    return;
  }
  ++failures_.restarts;
  alive_ = true;
}

void Loop::ask_for_map() {
  auto failure = record::catch_failure([&] {
    const auto landmarks = parts_.pipeline.report(false).landmarks();
    map_.emplace(landmarks.begin(), landmarks.end());
  });
  if (!failure) return;
  parts_.gate.fail(failure->message, Clock::now());
  command_timeout_.forget();
  after_failure(std::move(*failure), std::nullopt);
}

void Loop::tell() {
  for (const std::string& message : parts_.gate.take_messages()) hooks_.notice(message);
  if (told_refusal_) return;
  const std::string refusal = arrivals_.first_refusal();
  if (refusal.empty()) return;
  told_refusal_ = true;
  hooks_.notice("the driver's frames are refused, the first one: " + refusal);
}

record::FinalMap Loop::final_map() {
  tell();
  record::FinalMap map;
  // First as it stands: where the refined one fails, this is the map.
  for (const bool refine : {false, true}) {
    if (!alive_) break;
    auto failure = record::catch_failure([&] { map = record::copy_map(&parts_.pipeline.report(refine)); });
    if (!failure) continue;
    alive_ = false;
    failures_.note(std::move(*failure), std::nullopt);
  }
  return map;
}

void Loop::close() {
  if (auto failure = record::catch_failure([&] { parts_.pipeline.close(); }))
    failures_.note(std::move(*failure), std::nullopt);
}

}  // namespace hallway::robot
