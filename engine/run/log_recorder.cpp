// SPDX-License-Identifier: MIT
#include "run/log_recorder.hpp"

namespace hallway::run {
namespace {

constexpr std::uint32_t kSensorId = 0;

}  // namespace

const hw_frame_t& build_frame(host::FrameBuilder& builder, std::uint32_t iteration,
                              const SourceFrame& frame) {
  builder.begin(iteration, frame.t_ns);
  std::vector<hw_point3_t>& points = builder.add_points(kSensorId);
  for (const log::Observation& seen : frame.observations) {
    points.push_back({seen.point[0], seen.point[1], seen.point[2]});
  }
  if (frame.is_tracked) {
    std::vector<std::uint64_t>& tracks = builder.add_tracks();
    for (const log::Observation& seen : frame.observations) tracks.push_back(seen.track);
  }
  return builder.finish();
}

LogRecorder::LogRecorder(log::ByteOutput& output, const Source& source,
                         const nlohmann::ordered_json& manifest)
    : recorder_(output, {.manifest = manifest,
                         .sensors = std::span(&source.sensor(), 1),
                         .period_ns = manifest.value("period_ns", std::int64_t{0}),
                         .has_identities = source.has_identities()}),
      source_(source) {
  if (source.true_landmarks()) recorder_.writer().add_true_landmarks(*source.true_landmarks());
}

void LogRecorder::add_view(bool has_answers) {
  view_.emplace(recorder_.writer().file(),
                foxglove::ViewOptions{.first_id = log::kFirstOtherId, .has_answers = has_answers});
  view_->set_sensors({&source_.sensor(), 1});
  if (source_.true_landmarks()) view_->set_true_landmarks(*source_.true_landmarks());
}

void LogRecorder::record_input(const hw_frame_t& given, const SourceFrame& truth) {
  recorder_.record_frame(given);
  log::RunLogWriter& writer = recorder_.writer();
  const log::FrameStamp& stamp = recorder_.stamp();
  if (view_) view_->add_frame(stamp, given);
  if (source_.has_identities()) {
    ids_.clear();
    for (const log::Observation& seen : truth.observations) ids_.push_back(seen.landmark);
    writer.add_identities(stamp, ids_);
  }
  if (!truth.T_world_body) return;
  const Pose& pose = *truth.T_world_body;
  const log::IterationPose true_pose{.iteration = stamp.iteration,
                                     .position_m = {pose.t.x(), pose.t.y(), pose.t.z()},
                                     .orientation = {pose.q.w(), pose.q.x(), pose.q.y(), pose.q.z()},
                                     .orientation_known = truth.orientation_known};
  writer.add_true_pose(stamp, true_pose);
  if (view_) view_->add_true_pose(stamp, true_pose);
}

void LogRecorder::keep() {
  recorder_.writer().keep();
}

void LogRecorder::record_answer(const host::Outputs& outputs) {
  recorder_.record_pose(outputs);  // what is shown of a message follows it, as in a log that is copied
  if (view_ && outputs.pose()) view_->add_pose(recorder_.stamp(), record::pose_answer(*outputs.pose()));
  recorder_.record_the_rest(outputs);
}

void LogRecorder::record_map(const record::FinalMap& map) {
  recorder_.record_map(map);
  if (view_) view_->add_map(recorder_.stamp(), map.landmarks, map.submap_members);
}

void LogRecorder::finish() {
  if (view_) view_->finish();
  recorder_.finish();
}

}  // namespace hallway::run
