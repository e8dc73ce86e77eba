// SPDX-License-Identifier: MIT
#include "run/run.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/file.hpp"
#include "eval/evaluator.hpp"
#include "eval/metrics_json.hpp"
#include "host/frame_builder.hpp"
#include "log/poses.hpp"
#include "log/timing.hpp"
#include "run/frame_feed.hpp"
#include "run/log_recorder.hpp"
#include "run/manifest.hpp"
#include "run/output_folder.hpp"
#include "run/pictures.hpp"
#include "run/record.hpp"
#include "run/sensor_json.hpp"

namespace hallway::run {
namespace {

namespace fs = std::filesystem;

constexpr double kMillisecondsPerNanosecond = 1e-6;

/// Everything that is collected while a run goes on and written at its end.
struct Collected {
  log::ObservationLog observations{true};
  std::vector<log::IterationPose> true_poses;
  std::vector<log::StampedPose> truth;
  std::vector<log::StampedPose> trajectory;
  std::vector<log::IterationTime> times;
};

/// The pipeline's map, copied out of buffers that the next call uses again.
struct FinalMap {
  std::vector<log::MapLandmark> landmarks;
  std::vector<log::IdPair> submap_members;
  std::uint64_t submaps = 0;
};

log::StampedPose stamped(std::int64_t t_ns, const Pose& pose) {
  return {.t_s = static_cast<double>(t_ns) / 1e9,
          .position_m = {pose.t.x(), pose.t.y(), pose.t.z()},
          .orientation = {pose.q.w(), pose.q.x(), pose.q.y(), pose.q.z()}};
}

std::optional<Pose> estimate_of(const host::Outputs& outputs) {
  if (!outputs.pose() || !outputs.pose()->valid) return std::nullopt;
  return pose_of(outputs.pose()->T_map_body);
}

log::LandmarkStatus status_of(std::uint32_t status) {
  switch (status) {
    case HW_LANDMARK_MAPPED:
      return log::LandmarkStatus::kMapped;
    case HW_LANDMARK_DYNAMIC:
      return log::LandmarkStatus::kDynamic;
    default:
      return log::LandmarkStatus::kTemporary;
  }
}

/// @param answer  null where there is none: nothing is known of the map
FinalMap copy_map(const host::Outputs* answer) {
  FinalMap map;
  if (answer == nullptr) return map;
  const host::Outputs& outputs = *answer;
  for (const hw_landmark_t& landmark : outputs.landmarks()) {
    map.landmarks.push_back({.id = landmark.id,
                             .position_m = {landmark.position[0], landmark.position[1], landmark.position[2]},
                             .observations = landmark.observations,
                             .status = status_of(landmark.status)});
  }
  for (const hw_submap_t& submap : outputs.submaps()) {
    for (const std::uint64_t member : outputs.members(submap))
      map.submap_members.push_back({submap.id, member});
  }
  map.submaps = outputs.submaps().size();
  return map;
}

/// Takes down what comes back of the frames, and scores it.
class Tally {
 public:
  Tally(const Source& source, bool keep_observations)
      : source_(source),
        keep_observations_(keep_observations),
        evaluator_({.has_identities = source.has_identities(), .landmarks = source.true_landmarks()}) {}

  void add(const FrameAnswer& answer) {
    const SourceFrame& frame = answer.frame;
    identities_.clear();
    if (source_.has_identities()) {
      for (const log::Observation& seen : frame.observations) identities_.push_back(seen.landmark);
    }
    eval::Iteration iteration{.T_world_body = frame.T_world_body,
                              .orientation_known = frame.orientation_known,
                              .T_map_body = {},
                              .associations = associations(answer),
                              .identities = identities_,
                              .wall_ms = {},
                              .cpu_ms = {}};
    if (answer.outputs != nullptr) add_answer(answer, iteration);
    evaluator_.add(iteration);
    keep_truth(answer.iteration, frame);
  }

  const eval::Evaluator& evaluator() const { return evaluator_; }
  const Collected& collected() const { return collected_; }

 private:
  void add_answer(const FrameAnswer& answer, eval::Iteration& iteration) {
    iteration.wall_ms = static_cast<double>(answer.time.wall_ns) * kMillisecondsPerNanosecond;
    iteration.cpu_ms = static_cast<double>(answer.time.cpu_ns) * kMillisecondsPerNanosecond;
    iteration.T_map_body = estimate_of(*answer.outputs);
    collected_.times.push_back(
        {.iteration = answer.iteration, .wall_ms = *iteration.wall_ms, .cpu_ms = *iteration.cpu_ms});
    if (iteration.T_map_body)
      collected_.trajectory.push_back(stamped(answer.frame.t_ns, *iteration.T_map_body));
  }

  std::span<const log::LandmarkId> associations(const FrameAnswer& answer) {
    if (answer.outputs != nullptr) {
      if (const auto given = answer.outputs->associations(0)) return *given;
    }
    none_.assign(answer.frame.observations.size(), log::kNoLandmark);
    return none_;
  }

  void keep_truth(std::uint32_t iteration, const SourceFrame& frame) {
    if (keep_observations_) collected_.observations.add_frame(iteration, frame.observations);
    if (!frame.T_world_body) return;
    const log::StampedPose pose = stamped(frame.t_ns, *frame.T_world_body);
    collected_.truth.push_back(pose);
    collected_.true_poses.push_back({.iteration = iteration,
                                     .position_m = pose.position_m,
                                     .orientation = pose.orientation,
                                     .orientation_known = frame.orientation_known});
  }

  const Source& source_;
  bool keep_observations_;
  eval::Evaluator evaluator_;
  std::vector<log::LandmarkId> identities_;
  std::vector<log::LandmarkId> none_;
  Collected collected_;
};

void write_json(const fs::path& path, const nlohmann::ordered_json& document) {
  write_file_atomically(path, document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

void write_input(const fs::path& folder, const RunPlan& plan, const Source& source,
                 const Collected& collected) {
  for (const Attachment& attachment : plan.attachments) {
    make_folder((folder / attachment.name).parent_path());
    write_file_atomically(folder / attachment.name, attachment.content);
  }
  if (!collected.truth.empty()) {
    log::write_tum(folder / files::kTrueTrajectory, collected.truth);
    log::write_poses(folder / files::kTruePoses, collected.true_poses);
  }
  if (source.true_landmarks()) log::write_landmarks(folder / files::kTrueLandmarks, *source.true_landmarks());
  if (plan.write_observations) log::write_observations(folder / files::kObservations, collected.observations);
}

void write_map(const fs::path& folder, const FinalMap& map, const eval::Evaluator& evaluator) {
  log::write_map_landmarks(folder / files::kLandmarks, map.landmarks);
  log::write_landmarks_ply(folder / files::kLandmarksPly, map.landmarks);
  log::write_id_pairs(folder / files::kSubmaps, map.submap_members, log::kSubmapColumns);
  std::vector<log::IdPair> matches;
  for (const auto& [landmark, truth] : evaluator.associations().ownership().owner) {
    matches.push_back({.first = landmark, .second = truth});
  }
  if (evaluator.has_identities()) log::write_id_pairs(folder / files::kMatches, matches, log::kMatchColumns);
}

nlohmann::ordered_json complete_manifest(const RunPlan& plan, const Source& source, const RunResult& result,
                                         std::uint32_t done) {
  nlohmann::ordered_json manifest = plan.manifest;
  manifest["sensors"] = nlohmann::ordered_json::array({print_sensor(source.sensor())});
  manifest["iterations"] = done;
  manifest["stopped_early"] = result.stopped;
  describe_failures(plan.on_failure, result, manifest);
  return manifest;
}

}  // namespace

RunResult execute(Source& source, host::Pipeline& pipeline, const RunPlan& plan, const RunHooks& hooks) {
  OutputFolder output(plan.folder, plan.replace);
  const fs::path& folder = output.working_path();
  log::FileOutput log_file(folder / files::kLog);
  LogRecorder recorder(log_file, source, plan.manifest);
  host::FrameBuilder builder;
  Tally tally(source, plan.write_observations);
  FrameFeed feed(source, pipeline, plan);
  RunResult result;
  while (feed.has_next() && !(result.stopped && feed.under_way() == 0)) {
    const auto give = [&](const hw_frame_t& frame, const SourceFrame& truth) {
      if (!feed.one_at_a_time()) return;
      recorder.record_input(frame, truth);
      recorder.keep();  // a plugin in this process may end it
    };
    const auto take = [&](const FrameAnswer& answer) {
      if (!feed.one_at_a_time())
        recorder.record_input(build_frame(builder, answer.iteration, answer.frame), answer.frame);
      if (answer.outputs != nullptr) recorder.record_answer(*answer.outputs);
      tally.add(answer);
    };
    feed.next(result.stopped, give, take);
    if (hooks.progress) hooks.progress(feed.done());
    result.stopped = result.stopped || (hooks.stop && hooks.stop());
  }
  const FinalMap online = copy_map(feed.report(false));
  const host::Outputs* refined_outputs = feed.report(true);
  const FinalMap refined = refined_outputs != nullptr ? copy_map(refined_outputs) : online;
  recorder.record_map(refined.landmarks, refined.submap_members);
  recorder.finish();
  feed.close();
  feed.tell(result);
  result.metrics = tally.evaluator().metrics(online.landmarks, refined.landmarks);
  result.submaps = refined.submaps;

  write_input(folder, plan, source, tally.collected());
  log::write_tum(folder / files::kTrajectory, tally.collected().trajectory);
  write_map(folder, refined, tally.evaluator());
  log::write_timing(folder / files::kTiming, tally.collected().times);
  write_json(folder / files::kMetrics, eval::to_json(result.metrics));
  write_json(folder / files::kRun, complete_manifest(plan, source, result, feed.done()));
  if (!plan.pictures.empty()) {
    const Record record = read_record(folder);
    for (const sim::PictureSpec& picture : plan.pictures) {
      write_file_atomically(folder / picture.file, draw_run_picture(record, picture));
      result.pictures.push_back(output.path() / picture.file);
    }
  }
  output.commit();
  return result;
}

}  // namespace hallway::run
