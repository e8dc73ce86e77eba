// SPDX-License-Identifier: MIT
#include "run/feed/frame_feed.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace hallway::run {

FrameFeed::FrameFeed(Source& source, host::Pipeline& pipeline, const RunPlan& plan)
    : source_(source),
      pipeline_(pipeline),
      policy_(plan.on_failure),
      window_(plan.lock_step || source.is_closed_loop() || !pipeline.started()
                  ? 1
                  : static_cast<std::uint32_t>(pipeline.capacity())),
      alive_(pipeline.started()),
      frames_(window_) {
  failures_.verdicts = plan.start_failures;
  failures_.count = plan.start_failures.size();
  failures_.restarts = alive_ && failures_.count != 0 ? 1 : 0;
}

bool FrameFeed::has_next() const {
  const bool ended = !alive_ && policy_ == sim::OnFailure::kStop && !source_.is_moving();
  return !ended && done_ < source_.iterations();
}

void FrameFeed::submit(const std::function<void(const SourceFrame&)>& give) {
  SourceFrame& frame = frames_[submitted_ % window_];
  source_.read(submitted_, frame);
  give(frame);
  ++submitted_;
  if (alive_)
    pipeline_.submit(frame.samples(), pipeline_.isolated() ? frame.bytes() : std::span<const std::byte>());
}

void FrameFeed::next(bool last, const std::function<void(const SourceFrame&)>& give,
                     const std::function<void(const FrameAnswer&)>& take) {
  const std::uint32_t end = last ? done_ + 1 : std::min(source_.iterations() - done_, window_) + done_;
  FrameAnswer answer{.iteration = done_, .frame = frames_[done_ % window_]};
  std::optional<host::Verdict> failure = record::catch_failure([&] {
    while (submitted_ < end) submit(give);
    if (!alive_) return;
    const host::Outputs& outputs = pipeline_.collect();
    answer.was_called = pipeline_.was_called();
    if (answer.was_called) answer.outputs = &outputs;
    answer.time = pipeline_.last_call();
    answer.with_planes = pipeline_.frame_with_planes();
  });
  take(answer);
  if (source_.is_closed_loop()) obey(failure.has_value());
  const std::uint32_t iteration = done_++;
  if (failure) {
    note(std::move(*failure), iteration);
    submitted_ = done_;  // those under way are lost with the plugin; a frame can be read again
    if (policy_ == sim::OnFailure::kRestart) restart();
  }
}

/// What was answered to the frame that was read last.
void FrameFeed::obey(bool failed) {
  sim::DriveAnswer answer{.failed = failed || !alive_};
  if (const auto& command = pipeline_.drive_command(); command && !answer.failed)
    answer.command = drive::Command{.forward_m_s = command->linear_m_s,
                                    .lateral_m_s = command->lateral_m_s,
                                    .angular_rad_s = command->angular_rad_s};
  source_.obey(answer);
}

void FrameFeed::restart() {
  std::vector<record::Failure> failures;
  try {
    failures = record::start_plugins(pipeline_, policy_);
  } catch (const Error& error) {  // its file is another one now, or it refuses what it took before
    failures.push_back({{.call = "load", .message = error.what()}, std::nullopt});
  }
  for (record::Failure& failure : failures) note(std::move(failure.verdict), std::nullopt);
  alive_ = pipeline_.started();
  if (alive_) ++failures_.restarts;
}

void FrameFeed::note(host::Verdict verdict, std::optional<std::uint32_t> iteration) {
  alive_ = false;
  failures_.note(std::move(verdict), iteration);
}

const host::Outputs* FrameFeed::report(bool refine) {
  if (!alive_) return nullptr;
  const host::Outputs* outputs = nullptr;
  if (auto failure = record::catch_failure([&] { outputs = &pipeline_.report(refine); }))
    note(std::move(*failure), std::nullopt);
  return outputs;
}

void FrameFeed::close() {
  if (auto failure = record::catch_failure([&] { pipeline_.close(); }))
    note(std::move(*failure), std::nullopt);
}

}  // namespace hallway::run
