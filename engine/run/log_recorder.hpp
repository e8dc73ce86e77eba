// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "host/frame_builder.hpp"
#include "host/outputs.hpp"
#include "record/answer_recorder.hpp"
#include "run/source.hpp"

namespace hallway::run {

/// The frame that plugins are given: the points of one instantaneous reading, and nothing of what is true. Valid until the
/// builder is used again.
const hw_frame_t& build_frame(host::FrameBuilder& builder, std::uint32_t iteration, const SourceFrame& frame);

/// Records a run into an MCAP log (docs/formats.md): what the plugins are given, what they answer and, in channels of their
/// own, what is true. Same run, same bytes. All functions throw Error{kIo}.
class LogRecorder {
 public:
  /// Writes the facts of the run. Keeps a reference to `output`.
  /// @param manifest  run.json as known before the first frame; its member `host` is left out
  LogRecorder(log::ByteOutput& output, const Source& source, const nlohmann::ordered_json& manifest);

  /// A frame as the plugins get it, and what is true of it.
  void record_input(const hw_frame_t& given, const SourceFrame& truth);
  /// What the pipeline answered to the frame that was recorded last.
  void record_answer(const host::Outputs& outputs) { recorder_.record_answer(outputs); }
  /// For what else there is to record of the same frames.
  log::RunLogWriter& writer() { return recorder_.writer(); }
  /// The map at the end.
  void record_map(const record::FinalMap& map) { recorder_.record_map(map); }
  /// Writes what is left and the index.
  void finish() { recorder_.finish(); }

 private:
  record::AnswerRecorder recorder_;
  bool has_identities_;
  std::vector<log::LandmarkId> ids_;
};

}  // namespace hallway::run
