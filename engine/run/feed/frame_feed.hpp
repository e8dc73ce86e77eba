// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "run/feed/run.hpp"
#include "run/sources/source.hpp"

namespace hallway::run {

/// What the pipeline made of one frame.
struct FrameAnswer {
  std::uint32_t iteration = 0;
  const SourceFrame& frame;
  const host::Outputs* outputs =
      nullptr;  ///< null where there is none: the pipeline failed at it or before it, or was not called
  bool was_called =
      true;  ///< false: the frame has nothing that the last plugin takes, so there is nothing to score
  host::CallTime time{};  ///< where there is an answer
  /// The frame with the planes that plugins found in it; null where none takes such.
  const hw_frame_t* with_planes = nullptr;
};

/// Feeds the frames of a source to a pipeline, in order, and does what the plan says when a plugin fails. The answers are the same however many
/// frames are under way.
class FrameFeed {
 public:
  FrameFeed(Source& source, host::Pipeline& pipeline, const RunPlan& plan);

  /// How many frames have been answered or failed.
  std::uint32_t done() const { return done_; }
  /// Whether there is a next one: not at the end, not after a failure that stops the run; a robot that obeys comes to rest before.
  bool has_next() const;
  /// Whether a frame is submitted only when the one before it has been answered.
  bool one_at_a_time() const { return window_ == 1; }
  /// Submits frames, each shown to `give` before the plugins get it, and waits for the answer to the next one, which is shown to `take`. With `last`,
  /// no frames are submitted that are not yet under way.
  void next(bool last, const std::function<void(const SourceFrame&)>& give,
            const std::function<void(const FrameAnswer&)>& take);
  /// Frames that were submitted and not yet answered.
  std::uint32_t under_way() const { return submitted_ - done_; }

  /// The pipeline's map, or null where it has failed.
  const host::Outputs* report(bool refine);
  /// Ends the pipeline in good order.
  void close();

  /// The failures so far.
  const record::Failures& failures() const { return failures_; }

 private:
  void submit(const std::function<void(const SourceFrame&)>& give);
  void note(host::Verdict verdict, std::optional<std::uint32_t> iteration);
  void obey(bool failed);
  void restart();

  Source& source_;
  host::Pipeline& pipeline_;
  sim::OnFailure policy_;
  std::uint32_t window_;
  bool alive_;
  std::uint32_t submitted_ = 0;
  std::uint32_t done_ = 0;
  std::vector<SourceFrame> frames_;  ///< under way, by iteration modulo window_
  record::Failures failures_;
};

}  // namespace hallway::run
