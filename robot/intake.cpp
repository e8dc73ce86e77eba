// SPDX-License-Identifier: MIT
#include "robot/intake.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "host/samples/sample_kind.hpp"

namespace hallway::robot {

Intake::Intake(host::Driver& driver, const host::RobotInfo& robot) : driver_(driver), robot_(robot) {}

std::optional<TakenFrame> Intake::take(std::chrono::nanoseconds wait, std::string& bytes) {
  if (ended_) return std::nullopt;
  const host::Driver::Reading reading = driver_.read(wait);
  if (reading.found == host::Driver::Found::kEnd) ended_ = true;
  if (reading.found != host::Driver::Found::kFrame) return std::nullopt;
  ++counts_.read;
  return keep(*reading.frame, bytes) ? last_ : std::nullopt;
}

bool Intake::keep(const hw_frame_t& frame, std::string& bytes) {
  try {
    // This also looks at the struct itself, before its samples are looked at.
    const std::size_t size = writer_.measure(frame);
    const std::string problem = problem_of(frame);
    if (!problem.empty()) throw Error(ErrorCode::kBadInput, problem);
    bytes.resize(size);
    writer_.write(std::as_writable_bytes(std::span(bytes)));
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kBadInput) throw;
    refuse(frame.sequence, error.message());
    return false;
  }
  if (last_) counts_.lost += frame.sequence - last_->sequence - 1;
  last_ = {.sequence = frame.sequence, .t_ns = frame.t_ns};
  return true;
}

void Intake::refuse(std::uint64_t sequence, const std::string& reason) {
  const std::string message = fmt::format("frame {}: {}", sequence, reason);
  if (robot_.lock_step) {
    throw Error(ErrorCode::kBadInput, message,
                {driver_.file().string(), 0, fmt::format("driver `{}`", driver_.info().id)});
  }
  if (counts_.refused++ == 0) first_refusal_ = message;
}

std::string Intake::problem_of(const hw_frame_t& frame) const {
  if (frame.t_ns < 0) return "a time below 0";
  if (last_ && frame.sequence <= last_->sequence) return "a number that is not above the one before";
  if (last_ && frame.t_ns < last_->t_ns) return "a time before that of the frame before";
  for (std::uint32_t i = 0; i < frame.n_samples; ++i) {
    std::string problem = problem_of(*frame.samples[i]);
    if (!problem.empty()) return problem;
  }
  return {};
}

std::string Intake::problem_of(const hw_sample_t& sample) const {
  const auto sensor =
      std::ranges::find_if(robot_.sensors, [&](const auto& info) { return info.id == sample.sensor_id; });
  if (sensor == robot_.sensors.end()) return "a sample of a sensor that was not described";
  if (sensor->kind != sample.kind) return "a sample of another kind than its sensor gives";
  return host::find_not_finite(sample);
}

}  // namespace hallway::robot
