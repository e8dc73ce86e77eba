// SPDX-License-Identifier: MIT
#include "run/feed/log_recorder.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "geom/arrays.hpp"
#include "host/samples/sample_kind.hpp"
#include "record/plugin_topology.hpp"

namespace hallway::run {
LogRecorder::LogRecorder(log::ByteOutput& output, const Source& source,
                         const nlohmann::ordered_json& manifest)
    : recorder_(output, {.manifest = manifest,
                         .activation = source.activation(),
                         .period_ns = manifest.value("period_ns", std::int64_t{0}),
                         .has_identities = source.has_identities()}),
      source_(source),
      shape_(robot_shape(manifest)) {
  if (source.true_landmarks()) recorder_.writer().add_true_landmarks(*source.true_landmarks());
  if (source.true_planes()) recorder_.writer().add_true_planes(*source.true_planes());
  if (!source.facts().labels.empty()) recorder_.writer().add_labels(source.facts().labels);
}

void LogRecorder::add_view(bool has_answers) {
  view_.emplace(recorder_.writer().file(),
                foxglove::ViewOptions{.first_id = log::kFirstOtherId, .has_answers = has_answers});
  view_->set_sensors(source_.sensors());
  if (shape_) view_->set_body(shape_->corners, shape_->bottom_m, shape_->top_m);
  if (source_.true_landmarks()) view_->set_true_landmarks(*source_.true_landmarks());
}

namespace {

/// Whether elements of a sample may be seen landmarks or planes. A reading without any element still says that it saw none.
bool names_landmarks(const SourceFrame& frame, std::uint32_t k) {
  const host::SampleKind* kind = host::find_sample_kind(frame.sample(k).kind);
  if (kind != nullptr && kind->arrays.empty()) return false;
  const auto ids = frame.identities_of(k);
  return ids.empty() || !std::ranges::all_of(ids, [](log::LandmarkId id) { return id == log::kNoLandmark; });
}

}  // namespace

void LogRecorder::record_input(const SourceFrame& frame) {
  const auto bytes = frame.bytes();
  recorder_.record_frame({static_cast<std::uint32_t>(frame.samples().sequence), frame.t_ns()},
                         frame.n_samples(), {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  log::RunLogWriter& writer = recorder_.writer();
  const log::FrameStamp& stamp = recorder_.stamp();
  if (view_) view_->add_frame(stamp, frame.samples());
  for (std::uint32_t k = 0; source_.has_identities() && k < frame.n_samples(); ++k) {
    if (names_landmarks(frame, k)) writer.add_identities(stamp, k, frame.identities_of(k));
  }
  for (const log::SampleTruth& truth : frame.sample_truths) writer.add_sample_truth(stamp, truth);
  if (!frame.T_world_body) return;
  const Pose& pose = *frame.T_world_body;
  const log::IterationPose true_pose{.iteration = stamp.iteration,
                                     .position_m = to_array(pose.t),
                                     .orientation = to_array(pose.q),
                                     .orientation_known = frame.orientation_known};
  writer.add_true_pose(stamp, true_pose);
  if (view_) view_->add_true_pose(stamp, true_pose);
}

void LogRecorder::keep() {
  recorder_.writer().keep();
}

void LogRecorder::record_answer(const host::Outputs& outputs) {
  recorder_.record_pose(outputs);  // what is shown of a message follows it, as in a log that is copied
  if (view_ && outputs.pose()) view_->add_pose(recorder_.stamp(), record::pose_answer(outputs));
  recorder_.record_topology(outputs);
  if (view_ && outputs.topology() != nullptr)
    view_->add_topology(recorder_.stamp(), record::copy_topology(*outputs.topology()));
  recorder_.record_drawing(outputs);
  if (view_ && outputs.drawing() != nullptr)
    view_->add_drawing(recorder_.stamp(), record::copy_drawing(*outputs.drawing()));
  recorder_.record_the_rest(outputs);
}

void LogRecorder::record_obeyed(const log::ObeyedCommand& command) {
  recorder_.writer().add_obeyed(recorder_.stamp(), command);
  if (view_) view_->add_obeyed(recorder_.stamp(), command);
}

void LogRecorder::record_contact(const log::ContactRow& contact) {
  recorder_.writer().add_contact(recorder_.stamp(), contact);
  if (view_) view_->add_contact(recorder_.stamp(), contact);
}

void LogRecorder::record_event(const log::EventRow& event) {
  recorder_.writer().add_event(recorder_.stamp(), event);
  if (view_) view_->add_event(event);
}

void LogRecorder::record_map(const record::FinalMap& map) {
  log::RunLogWriter& writer = recorder_.writer();  // as in a log that is copied, again
  writer.add_map(stamp(), map);
  if (view_) view_->add_map(stamp(), map);
  if (!map.topology) return;
  writer.add_topology(stamp(), *map.topology);
  if (view_) view_->add_topology(stamp(), *map.topology);
}

void LogRecorder::finish() {
  if (view_) view_->finish();
  recorder_.finish();
}

}  // namespace hallway::run
