// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

#include "host/output/outputs.hpp"
#include "host/stage.hpp"
#include "log/run_log.hpp"
#include "record/final_map.hpp"

namespace hallway::record {

/// What stands in a log once, for those who read it.
struct LogFacts {
  nlohmann::ordered_json
      manifest;                   ///< run.json as known before the first frame; its member `host` is left out
  host::Activation activation{};  ///< what plugins are given once
  std::int64_t period_ns = 0;     ///< from frame to frame; 0 where it is not regular
  bool has_identities = false;    ///< whether the observations' true landmarks are recorded too
};

/// The pose that was put, with the part of the map that it is in, as logs have them. There must be one.
log::PoseAnswer pose_answer(const host::Outputs& outputs);

/// Records into an MCAP log (docs/formats.md) what plugins are given and what they answer. Same calls, same bytes. All functions
/// throw Error{kIo}.
class AnswerRecorder {
 public:
  /// Keeps a reference to `output`.
  AnswerRecorder(log::ByteOutput& output, const LogFacts& facts);

  /// A frame as the plugins get it, of `n_samples`, in the form of host/samples/frame_bytes.hpp.
  void record_frame(const log::FrameStamp& stamp, std::uint32_t n_samples, std::string_view bytes);
  /// What the pipeline answered to the frame that was recorded last: record_pose(), record_topology(), record_drawing() and record_the_rest().
  void record_answer(const host::Outputs& outputs);
  void record_pose(const host::Outputs& outputs);
  void record_topology(const host::Outputs& outputs);
  void record_drawing(const host::Outputs& outputs);
  void record_the_rest(const host::Outputs& outputs);
  /// The map at the end.
  void record_map(const FinalMap& map);
  /// Writes what is left and the index.
  void finish() { writer_.finish(); }

  /// For what else there is to record of the same frames.
  log::RunLogWriter& writer() { return writer_; }
  /// Of the frame that was recorded last.
  const log::FrameStamp& stamp() const { return stamp_; }

 private:
  log::RunLogWriter writer_;
  log::FrameStamp stamp_;
  std::uint32_t n_samples_ = 0;  ///< of that frame
};

}  // namespace hallway::record
