// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "foxglove/view.hpp"
#include "host/output/outputs.hpp"
#include "record/answer_recorder.hpp"
#include "run/pictures/robot_shape.hpp"
#include "run/sources/source.hpp"

namespace hallway::run {

/// Records a run into an MCAP log (docs/formats.md): what the plugins are given, what they answer and, in channels of their
/// own, what is true. Same run, same bytes. All functions throw Error{kIo}.
class LogRecorder {
 public:
  /// Writes the facts of the run. Keeps references to `output` and `source`.
  /// @param manifest  run.json as known before the first frame; its member `host` is left out
  LogRecorder(log::ByteOutput& output, const Source& source, const nlohmann::ordered_json& manifest);

  /// Shows the run in Foxglove too, in channels beside its own; before the first frame.
  /// @param has_answers  whether record_answer() will be called
  void add_view(bool has_answers);
  /// What add_view() made, for what is shown and not recorded; null without it.
  foxglove::View* view() { return view_ ? &*view_ : nullptr; }

  /// Makes sure that what was recorded survives the end of the program, however it ends.
  void keep();
  /// A frame as the plugins get it, and what is true of it.
  void record_input(const SourceFrame& frame);
  /// What the pipeline answered to the frame that was recorded last.
  void record_answer(const host::Outputs& outputs);
  /// For what else there is to record of the same frames.
  log::RunLogWriter& writer() { return recorder_.writer(); }
  /// Of the frame that was recorded last.
  const log::FrameStamp& stamp() const { return recorder_.stamp(); }
  /// What the drive obeys from the frame that was recorded last on, and what the body touched and what happened to the robot until then.
  void record_obeyed(const log::ObeyedCommand& command);
  void record_contact(const log::ContactRow& contact);
  void record_event(const log::EventRow& event);
  /// The map at the end.
  void record_map(const record::FinalMap& map);
  /// Writes what is left and the index.
  void finish();

 private:
  record::AnswerRecorder recorder_;
  const Source& source_;
  std::optional<RobotShape> shape_;  ///< of the robot, for the view
  std::optional<foxglove::View> view_;
};

}  // namespace hallway::run
