// SPDX-License-Identifier: MIT
#include "run/log_recorder.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "geom/arrays.hpp"

namespace hallway::run {
namespace {

constexpr std::uint32_t kSensorId = 0;

void copy(const std::array<double, 3>& from, double (&to)[3]) {
  std::copy(from.begin(), from.end(), to);
}

void add_planes(host::FrameBuilder& builder, std::span<const log::PlaneObservation> planes) {
  host::FrameBuilder::Planes& reading = builder.add_planes(kSensorId);
  for (const log::PlaneObservation& seen : planes) {
    hw_plane_t& plane = reading.planes.emplace_back();
    plane.id = seen.id;
    copy(seen.normal, plane.normal);
    plane.offset_m = seen.offset_m;
    copy(seen.centroid_m, plane.centroid);
    for (std::size_t i = 0; i < 4; ++i) copy(seen.corners_m[i], plane.corners[i]);
    plane.n_points = seen.points;
    plane.rms_m = seen.rms_m;
    plane.exclusive_share = seen.exclusive_share;
    plane.first_hull = seen.hull_m.empty() ? 0 : reading.hull_points.size();
    plane.n_hull = seen.hull_m.size();
    for (const auto& point : seen.hull_m) reading.hull_points.push_back({point[0], point[1], point[2]});
  }
}

}  // namespace

const hw_frame_t& build_frame(host::FrameBuilder& builder, std::uint32_t iteration,
                              const SourceFrame& frame) {
  builder.begin(iteration, frame.t_ns);
  if (frame.is_of_planes) {
    add_planes(builder, frame.planes);
    return builder.finish();
  }
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
  if (source.true_planes()) recorder_.writer().add_true_planes(*source.true_planes());
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
    truth.identities(ids_);
    writer.add_identities(stamp, ids_);
  }
  if (!truth.T_world_body) return;
  const Pose& pose = *truth.T_world_body;
  const log::IterationPose true_pose{.iteration = stamp.iteration,
                                     .position_m = to_array(pose.t),
                                     .orientation = to_array(pose.q),
                                     .orientation_known = truth.orientation_known};
  writer.add_true_pose(stamp, true_pose);
  if (view_) view_->add_true_pose(stamp, true_pose);
}

void LogRecorder::keep() {
  recorder_.writer().keep();
}

void LogRecorder::record_answer(const host::Outputs& outputs) {
  recorder_.record_pose(outputs);  // what is shown of a message follows it, as in a log that is copied
  if (view_ && outputs.pose()) view_->add_pose(recorder_.stamp(), record::pose_answer(outputs));
  recorder_.record_the_rest(outputs);
}

void LogRecorder::record_map(const record::FinalMap& map) {
  recorder_.record_map(map);
  if (view_) view_->add_map(recorder_.stamp(), map);
}

void LogRecorder::finish() {
  if (view_) view_->finish();
  recorder_.finish();
}

}  // namespace hallway::run
