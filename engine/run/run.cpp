// SPDX-License-Identifier: MIT
#include "run/run.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/file.hpp"
#include "eval/evaluator.hpp"
#include "eval/metrics_json.hpp"
#include "host/frame_builder.hpp"
#include "log/poses.hpp"
#include "log/tum.hpp"
#include "record/answer_tables.hpp"
#include "record/final_map.hpp"
#include "record/manifest.hpp"
#include "record/output_folder.hpp"
#include "record/sensor_json.hpp"
#include "run/abi_pose.hpp"
#include "run/frame_feed.hpp"
#include "run/log_recorder.hpp"
#include "run/manifest.hpp"
#include "run/pictures.hpp"
#include "run/record.hpp"

namespace hallway::run {
namespace {

namespace fs = std::filesystem;

/// Everything that is collected while a run goes on and written at its end.
struct Collected {
  log::ObservationLog observations{true};
  std::vector<log::IterationPose> true_poses;
  std::vector<log::StampedPose> truth;
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
    iteration.wall_ms = record::milliseconds(answer.time.wall_ns);
    iteration.cpu_ms = record::milliseconds(answer.time.cpu_ns);
    iteration.T_map_body = estimate_of(*answer.outputs);
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

void write_matches(const fs::path& folder, const eval::Evaluator& evaluator) {
  std::vector<log::IdPair> matches;
  for (const auto& [landmark, truth] : evaluator.associations().ownership().owner) {
    matches.push_back({.first = landmark, .second = truth});
  }
  if (evaluator.has_identities()) log::write_id_pairs(folder / files::kMatches, matches, log::kMatchColumns);
}

nlohmann::ordered_json complete_manifest(const RunPlan& plan, const Source& source, const RunResult& result,
                                         std::uint32_t done) {
  nlohmann::ordered_json manifest = plan.manifest;
  manifest["sensors"] = nlohmann::ordered_json::array({record::print_sensor(source.sensor())});
  manifest["iterations"] = done;
  manifest["stopped_early"] = result.stopped;
  record::describe_failures(plan.on_failure, result.failures, manifest);
  return manifest;
}

}  // namespace

RunResult execute(Source& source, host::Pipeline& pipeline, const RunPlan& plan, const RunHooks& hooks) {
  record::OutputFolder output(plan.folder, plan.replace);
  const fs::path& folder = output.working_path();
  log::FileOutput log_file(folder / files::kLog);
  LogRecorder recorder(log_file, source, plan.manifest);
  record::AnswerTables tables(folder);
  host::FrameBuilder builder;
  Tally tally(source, plan.write_observations);
  FrameFeed feed(source, pipeline, plan);
  RunResult result;
  while (feed.has_next() && !(result.stopped && feed.under_way() == 0)) {
    feed.next(result.stopped, [&](const FrameAnswer& answer) {
      recorder.record_input(build_frame(builder, answer.iteration, answer.frame), answer.frame);
      if (answer.outputs != nullptr) {
        recorder.record_answer(*answer.outputs);
        tables.add(answer.iteration, answer.frame.t_ns, *answer.outputs, answer.time);
      }
      tally.add(answer);
    });
    if (hooks.progress) hooks.progress(feed.done());
    result.stopped = result.stopped || (hooks.stop && hooks.stop());
  }
  const record::FinalMap online = record::copy_map(feed.report(false));
  const host::Outputs* refined_outputs = feed.report(true);
  const record::FinalMap refined = refined_outputs != nullptr ? record::copy_map(refined_outputs) : online;
  recorder.record_map(refined);
  recorder.finish();
  tables.close();
  feed.close();
  result.failures = feed.failures();
  result.metrics = tally.evaluator().metrics(online.landmarks, refined.landmarks);
  result.submaps = refined.submaps;

  write_input(folder, plan, source, tally.collected());
  record::write_map(folder, refined);
  write_matches(folder, tally.evaluator());
  record::write_json(folder / files::kMetrics, eval::to_json(result.metrics));
  record::write_json(folder / files::kRun, complete_manifest(plan, source, result, feed.done()));
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
