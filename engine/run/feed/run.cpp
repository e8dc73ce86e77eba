// SPDX-License-Identifier: MIT
#include "run/feed/run.hpp"

#include <hallway/ext/log.h>
#include <hallway/output.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <map>

#include "base/error.hpp"
#include "base/file.hpp"
#include "eval/evaluator.hpp"
#include "eval/metrics_json.hpp"
#include "eval/topology_json.hpp"
#include "record/answer_tables.hpp"
#include "record/epoch_table.hpp"
#include "record/final_map.hpp"
#include "record/manifest.hpp"
#include "record/output_folder.hpp"
#include "record/plugin_topology.hpp"
#include "record/sensor_json.hpp"
#include "render/renderer.hpp"
#include "run/feed/drive_record.hpp"
#include "run/feed/found_table.hpp"
#include "run/feed/frame_feed.hpp"
#include "run/feed/log_recorder.hpp"
#include "run/feed/manifest.hpp"
#include "run/feed/map_epoch.hpp"
#include "run/feed/observation_tables.hpp"
#include "run/feed/truth_tables.hpp"
#include "run/pictures/pictures.hpp"
#include "run/pictures/record.hpp"
#include "run/scoring/iteration_maker.hpp"
#include "run/scoring/plane_truth.hpp"
#include "run/scoring/topology_scorer.hpp"
#include "run/scoring/truth_of.hpp"

namespace hallway::run {
namespace {

namespace fs = std::filesystem;

bool last_puts(const host::Pipeline& pipeline, std::uint32_t output) {
  if (pipeline.facts().empty()) return false;
  const std::vector<std::uint32_t>& outputs = pipeline.facts().back().info.outputs;
  return std::ranges::find(outputs, output) != outputs.end();
}

/// Takes down what comes back of the frames, and scores it.
class Tally {
 public:
  /// @param folder  where what is scored at the end is kept
  Tally(const Source& source, const host::Pipeline& pipeline, const fs::path& folder)
      : iterations_(source), evaluator_(truth_for(source, pipeline), folder) {
    if (evaluator_.planes() != nullptr) plane_truth_.emplace(source);
    if (last_puts(pipeline, HW_OUTPUT_TOPOLOGY)) topologies_.emplace(source, folder);
  }

  /// @param map_epoch  the part of the map that the answer's pose is in
  void add(const FrameAnswer& answer, std::optional<std::uint64_t> map_epoch) {
    if (topologies_) topologies_->add(answer);
    if (!answer.was_called) return;
    eval::Iteration iteration = iterations_.make(answer);
    iteration.map_epoch = map_epoch;
    if (iteration.T_map_body && answer.outputs->pose()->covariance) {
      using RowMajor = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
      iteration.pose_covariance = Eigen::Map<const RowMajor>(answer.outputs->pose()->covariance->data());
    }
    if (plane_truth_) {
      plane_truth_->read(answer);
      iteration.planes = plane_truth_->planes();
      iteration.true_plane_points = plane_truth_->points();
    }
    evaluator_.add(iteration);
  }

  /// No more frames come. @param joined  parts of the map that are one
  void finish(std::span<const eval::JoinedEpoch> joined) { evaluator_.finish(joined); }
  const eval::Evaluator& evaluator() const { return evaluator_; }

  /// Of the topology that holds at the end; none where it or the truth is not known.
  std::optional<eval::TopologyMetrics> score(const std::optional<log::Topology>& topology) {
    if (!topologies_ || !topology) return std::nullopt;
    topologies_->set_topology(*topology);
    const std::optional<eval::TopologyScore> score = topologies_->score();
    return score ? std::optional(score->metrics) : std::nullopt;
  }

 private:
  static eval::Truth truth_for(const Source& source, const host::Pipeline& pipeline) {
    eval::Truth truth = truth_of(source);
    if (!maps_planes(pipeline)) truth.planes.reset();
    // What a plugin that could not be made would have given is not known.
    truth.gives_poses =
        pipeline.facts().size() < pipeline.specs().size() || last_puts(pipeline, HW_OUTPUT_POSE);
    return truth;
  }

  IterationMaker iterations_;
  eval::Evaluator evaluator_;
  std::optional<PlaneTruth> plane_truth_;     ///< where maps of planes are scored
  std::optional<TopologyScorer> topologies_;  ///< where topologies are
};

/// Writes what is given and what is true, frame by frame.
class InputTables {
 public:
  InputTables(const fs::path& folder, const RunPlan& plan, const Source& source) : truth_(folder) {
    write_attachments(folder, plan.attachments);
    if (plan.write_observations) observations_.emplace(folder, source);
  }

  void add(const FrameAnswer& answer) {
    if (observations_) observations_->add(answer.iteration, answer.frame);
    truth_.add(answer.iteration, answer.frame);
  }
  /// No more frames come.
  void finish(const Source& source) {
    if (observations_) observations_->close();
    truth_.finish(source);
  }

 private:
  std::optional<ObservationTables> observations_;  ///< where the plan wants them
  TruthTables truth_;
};

void write_matches(const fs::path& folder, const eval::Evaluator& evaluator) {
  if (!evaluator.has_identities()) return;
  const eval::PlaneScore* planes = evaluator.planes();
  const eval::AssociationScore& score = planes != nullptr ? planes->associations() : evaluator.associations();
  std::vector<log::IdPair> matches;
  for (const auto& [landmark, truth] : score.ownership().owner)
    matches.push_back({.first = landmark, .second = truth});
  log::write_id_pairs(folder / files::kMatches, matches, log::kMatchColumns);
}

nlohmann::ordered_json complete_manifest(const RunPlan& plan, const Source& source, const RunResult& result,
                                         std::uint32_t done) {
  nlohmann::ordered_json manifest = plan.manifest;
  manifest["sensors"] = record::print_sensors(source.sensors());
  manifest["iterations"] = done;
  manifest["stopped_early"] = result.stopped;
  if (result.commands) manifest["replayed_commands"] = to_json(*result.commands);
  record::describe_failures(plan.on_failure, result.failures, manifest);
  return manifest;
}

/// Shows in Foxglove what plugins log and how they fail, where the plan wants that.
class EventView {
 public:
  /// @param has_answers  whether there are plugins that answer
  EventView(const RunPlan& plan, const FrameFeed& feed, LogRecorder& recorder, bool has_answers)
      : log_(plan.foxglove.get()), feed_(feed), recorder_(recorder) {
    if (log_ != nullptr) recorder.add_view(has_answers);
  }

  /// What is new since the last call, at the time of the last frame.
  void update() {
    if (log_ == nullptr) return;
    foxglove::View& view = *recorder_.view();
    for (const foxglove::LogLine& line : log_->take()) view.add_log(line);
    for (; shown_ < feed_.failures().verdicts.size(); ++shown_) {
      const host::Verdict& verdict = feed_.failures().verdicts[shown_].verdict;
      view.add_log({HW_LOG_ERROR, verdict.plugin, verdict.message});
    }
  }

  /// By name, which is the order in which `hallway log convert` finds them.
  void add_pictures(const std::map<std::string, std::string>& pictures) {
    if (log_ == nullptr) return;
    for (const auto& [name, png] : pictures) recorder_.view()->add_picture(name, png);
  }

 private:
  PluginLog* log_;
  const FrameFeed& feed_;
  LogRecorder& recorder_;
  std::size_t shown_ = 0;  ///< failures
};

bool is_of_iterations(const sim::PictureSpec& picture) {
  return picture.iteration || picture.every > 0 || picture.view == sim::PictureView::kCamera;
}

/// One for each iteration that a picture is wanted of.
std::vector<sim::PictureSpec> single_pictures(sim::PictureSpec picture, const Record& record) {
  if (picture.every == 0) {
    if (picture.view == sim::PictureView::kCamera && !picture.iteration)
      picture.iteration = last_iteration(record);
    return {picture};
  }
  std::vector<sim::PictureSpec> single;
  for (const std::uint32_t iteration : record.history->iterations) {
    if (iteration % picture.every == 0) single.push_back(picture.at(iteration));
  }
  return single;
}

/// Draws the pictures that the plan wants. Foxglove does not get those of `every`: their bytes would stay in memory. @return their content, by name; `result` gets what was drawn and what could not be
std::map<std::string, std::string> draw_pictures(const record::OutputFolder& output, const RunPlan& plan,
                                                 RunResult& result) {
  std::map<std::string, std::string> pictures;
  if (plan.pictures.empty()) return pictures;
  Record record = read_record(output.working_path());
  if (std::ranges::any_of(plan.pictures, is_of_iterations)) read_history(record);
  for (const sim::PictureSpec& wanted : plan.pictures) {
    for (const sim::PictureSpec& picture : single_pictures(wanted, record)) {
      if (picture.iteration && *picture.iteration > last_iteration(record)) {
        result.missing_pictures.push_back({picture.file, "the run ended before this iteration"});
        continue;
      }
      std::string png;
      try {
        png = draw_run_picture(record, picture, {}, {.renderer = plan.renderer});
      } catch (const render::NoRenderer& missing) {
        result.missing_pictures.push_back({picture.file, missing.message()});
        continue;
      }
      write_file_atomically(output.working_path() / picture.file, png);
      result.pictures.push_back(output.path() / picture.file);
      if (wanted.every == 0) pictures[picture.file] = std::move(png);
    }
  }
  return pictures;
}

}  // namespace

void write_attachments(const std::filesystem::path& folder, const std::vector<Attachment>& attachments) {
  for (const Attachment& attachment : attachments) {
    make_folder((folder / attachment.name).parent_path());
    write_file_atomically(folder / attachment.name, attachment.content);
  }
}

bool maps_planes(const host::Pipeline& pipeline) {
  return last_puts(pipeline, HW_OUTPUT_MAPPED_PLANES);
}

nlohmann::ordered_json to_json(const std::vector<MissingPicture>& missing) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const MissingPicture& picture : missing)
    list.push_back({{"file", picture.file}, {"cause", picture.cause}});
  return list;
}

RunResult execute(Source& source, host::Pipeline& pipeline, const RunPlan& plan, const RunHooks& hooks) {
  if (!plan.pictures.empty()) render::demand(plan.renderer);
  record::OutputFolder output(plan.folder, plan.replace);
  const fs::path& folder = output.working_path();
  log::FileOutput log_file(folder / files::kLog);
  LogRecorder recorder(log_file, source, plan.manifest);
  record::AnswerTables tables(folder);
  record::EpochTable epochs(folder);
  FoundTable found(folder);
  DriveRecord drive(folder, source);
  CommandComparison commands;
  InputTables inputs(folder, plan, source);
  Tally tally(source, pipeline, folder);
  FrameFeed feed(source, pipeline, plan);
  const bool has_plugins = !pipeline.specs().empty();
  EventView events(plan, feed, recorder, has_plugins);
  RunResult result;
  while (feed.has_next() && !(result.stopped && feed.under_way() == 0)) {
    const auto give = [&](const SourceFrame& frame) {
      if (!feed.one_at_a_time()) return;
      recorder.record_input(frame);
      recorder.keep();  // a plugin in this process may end it
    };
    const auto take = [&](const FrameAnswer& answer) {
      if (!feed.one_at_a_time()) recorder.record_input(answer.frame);
      std::optional<std::uint64_t> epoch;
      if (answer.outputs != nullptr) {
        recorder.record_answer(*answer.outputs);
        tables.add({answer.iteration, answer.frame.t_ns(), answer.frame.n_samples()}, *answer.outputs,
                   answer.time);
        epoch = epochs.add(answer.iteration, *answer.outputs);
      }
      found.add(answer);
      if (plan.compare_commands && answer.was_called)
        commands.add(answer.iteration, answer.frame.recorded_command, answer.outputs);
      inputs.add(answer);
      tally.add(answer, epoch);
      if (hooks.answered) hooks.answered(answer);
    };
    const std::uint64_t restarts = feed.failures().restarts;
    feed.next(result.stopped, give, take);
    drive.update(source, recorder, hooks.driven);
    if (feed.failures().restarts != restarts) epochs.restart();
    events.update();
    if (hooks.progress) hooks.progress(feed.done());
    result.stopped = result.stopped || (hooks.stop && hooks.stop());
  }
  const host::Outputs* online_outputs = feed.report(false);
  const record::FinalMap online = record::copy_map(online_outputs);
  const std::vector<eval::JoinedEpoch> joined = joined_epochs_of(online_outputs, epochs.first());
  const host::Outputs* refined_outputs = feed.report(true);
  record::FinalMap refined = refined_outputs != nullptr ? record::copy_map(refined_outputs) : online;
  if (has_plugins) recorder.record_map(refined);
  if (!refined.topology) refined.topology = tables.topology();
  tables.close();
  epochs.write(folder, online.joined_epochs);
  found.close();
  drive.close();
  feed.close();
  result.failures = feed.failures();
  events.update();
  tally.finish(joined);
  result.metrics = tally.evaluator().metrics(online.landmarks, refined.landmarks, joined);
  if (const eval::PlaneScore* planes = tally.evaluator().planes()) {
    result.metrics.planes = planes->metrics(online.planes, refined.planes);
    log::write_pose_errors(folder / files::kPoseErrors, planes->pose_errors(online.planes));
  }
  result.submaps = refined.submaps.size();

  inputs.finish(source);
  record::write_map(folder, refined);
  write_matches(folder, tally.evaluator());
  nlohmann::ordered_json metrics = eval::to_json(result.metrics);
  result.drive = source.drive_counts();
  if (result.drive) metrics["drive"] = to_json(*result.drive);
  result.topology = tally.score(refined.topology);
  if (result.topology) metrics["topology"] = eval::to_json(*result.topology);
  record::write_json(folder / files::kMetrics, metrics);
  if (commands.compared() > 0) result.commands = commands;
  nlohmann::ordered_json manifest = complete_manifest(plan, source, result, feed.done());
  if (refined.topology) manifest["topology"] = record::describe_topology(*refined.topology);
  record::write_json(folder / files::kRun, manifest);
  const bool shows_pictures = plan.foxglove != nullptr;
  if (!shows_pictures) recorder.finish();  // a whole log is read by its index
  events.add_pictures(draw_pictures(output, plan, result));
  if (!result.missing_pictures.empty()) {
    manifest["missing_pictures"] = to_json(result.missing_pictures);
    record::write_json(folder / files::kRun, manifest);
  }
  if (shows_pictures) recorder.finish();
  output.commit();
  return result;
}

}  // namespace hallway::run
