// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>

#include "base/error.hpp"
#include "base/text.hpp"
#include "console.hpp"
#include "eval/metrics_json.hpp"
#include "eval/topology_json.hpp"
#include "run/feed/drive_record.hpp"
#include "run/feed/manifest.hpp"

namespace hallway::cli {

std::string counted(std::uint64_t count, const char* thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

namespace {

using eval::Metrics;

std::string metres(const std::optional<double>& value) {
  return value ? fmt::format("{:.4f} m", *value) : std::string("unknown");
}

/// "98.6 % of landmarks", for the end of a line with errors; empty where the share is not known.
std::string coverage_text(const std::optional<double>& share, const char* of) {
  return share ? fmt::format("; {:.1f} % of {}", 100.0 * *share, of) : std::string();
}

std::string verdict_text(const Metrics& metrics) {
  if (!metrics.lost_iterations) return "none: the plugin gives no poses";
  if (!metrics.verdict) return "unknown: too few true poses";
  std::string text = eval::name_of(*metrics.verdict);
  if (metrics.diverged_at)
    text += fmt::format(", first at iteration {}: position error up to {:.4f} m, limit {:.4f} m",
                        *metrics.diverged_at, metrics.divergence->worst_m, metrics.divergence->limit_m);
  if (metrics.diverged_at && metrics.divergence->worst_deg)
    text += fmt::format("; rotation error up to {:.1f} deg, limit {:.0f} deg", *metrics.divergence->worst_deg,
                        eval::Divergence::kLimit_deg);
  return text;
}

void add_path(const Rows& row, const Metrics& metrics) {
  row("verdict", verdict_text(metrics));
  std::string iterations = fmt::to_string(metrics.iterations);
  if (metrics.lost_iterations) iterations += fmt::format(", {} without a pose", *metrics.lost_iterations);
  row("iterations", iterations);
  if (metrics.parts.count > 1 || metrics.parts.restarts > 0)
    row("parts of the map",
        fmt::format("{} with {}; scored is the one with most poses, {} of {} iterations{}",
                    metrics.parts.count, counted(metrics.parts.restarts, "restart"),
                    metrics.parts.scored_iterations, metrics.iterations,
                    metrics.parts.ends_in_scored ? "" : "; the map at the end is another one"));
}

void add_landmarks(const Rows& row, const Metrics& metrics, std::uint64_t submaps) {
  // Plugins that give a path alone, and associate nothing, have nothing to be missed.
  const bool path_alone = metrics.landmarks_mapped == 0 && metrics.associations_none == metrics.observations;
  if (!metrics.landmarks_true || path_alone) {
    row("landmarks mapped", fmt::format("{} in {}", metrics.landmarks_mapped, counted(submaps, "submap")));
    return;
  }
  row("landmarks mapped",
      fmt::format("{} of {} seen, in {}; {} duplicated, {} missed, {} that are none",
                  *metrics.landmarks_true - metrics.landmarks_missed.value_or(0), *metrics.landmarks_true,
                  counted(submaps, "submap"), metrics.landmarks_duplicated.value_or(0),
                  metrics.landmarks_missed.value_or(0), metrics.landmarks_unmatched.value_or(0)));
}

void add_associations(const Rows& row, const Metrics& metrics) {
  if (!metrics.association_errors) {
    row("observations", fmt::format("{}, {} unassociated", metrics.observations, metrics.associations_none));
    return;
  }
  const double share = metrics.observations == 0 ? 0.0
                                                 : 100.0 * static_cast<double>(*metrics.association_errors) /
                                                       static_cast<double>(metrics.observations);
  row("observations", fmt::format("{}, {} unassociated, {} misassociated ({:.4f} %)", metrics.observations,
                                  metrics.associations_none, *metrics.association_errors, share));
}

std::string errors_text(const std::optional<eval::ErrorSummary>& errors, const char* unit) {
  if (!errors) return "unknown";
  return fmt::format("{:.4f} mean, {:.4f} RMS, {:.4f} worst {}", errors->mean, errors->rms, errors->max,
                     unit);
}

void add_planes(const Rows& row, const Metrics& metrics, std::uint64_t submaps) {
  const eval::PlaneMetrics& planes = *metrics.planes;
  const std::string walls = coverage_text(metrics.wall_coverage(), "walls");
  const std::string poses = coverage_text(metrics.pose_coverage(), "frames");
  const eval::PlaneMapMetrics& map = planes.refined;
  row("planes seen", fmt::format("{}, {} unassociated, {} misassociated", planes.observations,
                                 planes.associations_none, planes.association_errors));
  row("walls mapped",
      fmt::format("{} of {} in {}; {} duplicated, {} in parts, {} that are none", map.walls_mapped,
                  planes.walls_true, counted(submaps, "submap"), map.duplicated, map.parts, map.unmatched));
  if (map.corner_m) row("certain corners", fmt::format("{}", map.corner_m->count));
  row("corner error", errors_text(map.corner_m, "m") + walls);
  row("wall error, across it", errors_text(map.offset_m, "m") + walls);
  row("wall error, direction", errors_text(map.angle_deg, "deg") + walls);
  if (map.extent_iou_mean)
    row("wall extent, IoU",
        fmt::format("{:.4f} mean, {:.4f} least", *map.extent_iou_mean, map.extent_iou_least.value_or(0)));
  row("position error, online", errors_text(planes.position_m, "m") + poses);
  row("position error, re-fitted", errors_text(planes.position_refitted_m, "m"));
  row("heading error, online", errors_text(planes.heading_deg, "deg") + poses);
  row("heading error, re-fitted", errors_text(planes.heading_refitted_deg, "deg"));
}

void add_relative(const Rows& row, const Metrics& metrics) {
  const std::string poses = coverage_text(metrics.pose_coverage(), "frames");
  const auto add = [&](const char* label, const eval::PathError& error) {
    if (!error.translation_m || !error.rotation_deg) return;
    row(label, fmt::format("{:.4f} m, {:.4f} deg RMSE{}", error.translation_m->rmse, error.rotation_deg->rmse,
                           poses));
  };
  add("RPE, per frame", metrics.rpe_frame);
  add("RPE, per metre", metrics.rpe_metre);
  add("RPE, per second", metrics.rpe_second);
}

void add_errors(const Rows& row, const Metrics& metrics) {
  const std::string landmarks = coverage_text(metrics.landmark_coverage(), "landmarks");
  const std::string poses = coverage_text(metrics.pose_coverage(), "frames");
  if (metrics.landmark_rmse_m.aligned) {
    row("landmark RMSE, aligned",
        fmt::format("{} online, {} as re-solved at the end{}", metres(metrics.landmark_rmse_m.aligned),
                    metres(metrics.landmark_rmse_final_aligned_m), landmarks));
    row("landmark RMSE, first pose", metres(metrics.landmark_rmse_m.first_pose) + landmarks);
  }
  if (metrics.position_rmse_m.aligned) {
    row("position RMSE, aligned", fmt::format("{} online, {} as re-fitted to the map at the end{}",
                                              metres(metrics.position_rmse_m.aligned),
                                              metres(metrics.position_rmse_refitted_aligned_m), poses));
  }
  if (metrics.position_rmse_m.first_pose) {
    row("position RMSE, first pose",
        fmt::format("{}, {} at the end{}", metres(metrics.position_rmse_m.first_pose),
                    metres(metrics.position_final_m), poses));
  }
}

void add_scores(const Rows& row, const Metrics& metrics, std::uint64_t submaps) {
  if (metrics.iterations == 0) {
    row("scored", "nothing: no frame went to a plugin");
    return;
  }
  add_path(row, metrics);
  if (metrics.planes) add_planes(row, metrics, submaps);
  if (!metrics.planes || metrics.landmarks_mapped > 0) {
    add_associations(row, metrics);
    add_landmarks(row, metrics, submaps);
    add_errors(row, metrics);
  }
  add_relative(row, metrics);
}

void add_topology(const Rows& row, const eval::TopologyMetrics& topology) {
  row("places charted",
      fmt::format("{} of {}, {} missed, {} of another kind, {} false", topology.found, topology.demanded,
                  topology.missed, topology.wrong_kind, topology.false_nodes + topology.duplicates));
  row("openings", fmt::format("{} of {} found", topology.openings_found, topology.openings));
  row("loop", std::string(eval::loop_verdict_name(topology.loop)));
}

/// The frames of a replay do not depend on its commands.
std::string comparison_text(const run::CommandComparison& commands) {
  const std::string compared = counted(commands.compared(), "frame") + " with one in the log";
  if (!commands.first_different()) return compared + ", all the same";
  return fmt::format("{}; {} different, the first at iteration {}", compared, commands.different(),
                     *commands.first_different());
}

void add_times(const Rows& row, const char* label, const std::optional<eval::TimeSummary>& times) {
  if (!times) return;
  row(label, fmt::format("{:.4f} ms mean, {:.4f} median, {:.4f} p99, {:.4f} worst", times->mean, times->p50,
                         times->p99, times->max));
}

/// What is printed of a run that has ended.
struct Outcome {
  const Report& report;
  std::vector<std::string> plugins;
  fs::path folder;
  const run::RunResult& result;
};

std::string table_of(const Outcome& outcome) {
  const run::RunResult& result = outcome.result;
  const Metrics& metrics = result.metrics;
  std::string text = fmt::format(
      "{}: {}{}\n", outcome.report.name,
      outcome.plugins.empty() ? "no plugin" : fmt::format("{}", fmt::join(outcome.plugins, " + ")),
      result.stopped ? " (stopped early)" : "");
  const Rows row{text, 28};
  add_scores(row, metrics, result.submaps);
  if (result.drive) add_drive(row, *result.drive);
  if (result.topology) add_topology(row, *result.topology);
  if (result.commands) row("commands, open loop", comparison_text(*result.commands));
  add_times(row, "iteration, wall clock", metrics.iteration_ms);
  add_times(row, "iteration, thread CPU", metrics.iteration_cpu_ms);
  row("written to", path_text(outcome.folder));
  for (const auto& picture : result.pictures) row("picture", path_text(picture));
  if (!result.missing_pictures.empty())
    row("pictures not drawn", fmt::to_string(result.missing_pictures.size()));
  if (result.failures.count != 0) {
    row("plugin failures", fmt::format("{}, {} restarts", result.failures.count, result.failures.restarts));
  }
  return text;
}

/// 5 where a plugin failed, whatever became of the run then.
int status_of(const run::RunResult& result) {
  if (result.failures.count != 0) return exit_status(ErrorCode::kPluginFault);
  return result.stopped ? interrupt_status() : 0;
}

Json print_first(const record::Failures& failures) {
  if (failures.verdicts.empty()) return nullptr;
  return record::print_verdict(failures.verdicts.front().verdict, failures.verdicts.front().iteration);
}

Json metrics_of(const run::RunResult& result) {
  Json metrics = eval::to_json(result.metrics);
  if (result.drive) metrics["drive"] = run::to_json(*result.drive);
  if (result.topology) metrics["topology"] = eval::to_json(*result.topology);
  return metrics;
}

Json document_of(const Outcome& outcome) {
  return {{"schema", "hallway.result/1"},
          {"status", status_of(outcome.result)},
          {"name", outcome.report.name},
          {"plugins", outcome.plugins},
          {"folder", path_text(outcome.folder)},
          {"pictures", path_texts(outcome.result.pictures)},
          {"missing_pictures", run::to_json(outcome.result.missing_pictures)},
          {"warnings", outcome.report.warnings},
          {"verdict", print_first(outcome.result.failures)},
          {"failures", outcome.result.failures.count},
          {"restarts", outcome.result.failures.restarts},
          {"submaps", outcome.result.submaps},
          {"metrics", metrics_of(outcome.result)}};
}

/// One warning for the pictures of one cause, which is the same for all as a rule.
void warn_of_missing(const std::vector<run::MissingPicture>& missing) {
  std::string files;
  for (std::size_t i = 0; i < missing.size(); ++i) {
    files += (files.empty() ? "" : ", ") + printable(missing[i].file);
    if (i + 1 < missing.size() && missing[i + 1].cause == missing[i].cause) continue;
    print_warning(files + ": " + missing[i].cause);
    files.clear();
  }
}

}  // namespace

void add_drive(const Rows& row, const sim::DriveCounts& drive) {
  row("commands", fmt::format("{}, {} clamped, {} with a part left out; {} by watchdog or time-out",
                              drive.commands, drive.clamped, drive.left_out, counted(drive.stops, "stop")));
  row("driven", fmt::format("{:.2f} m; {}, {}, stood {:.1f} s against something", drive.distance_m,
                            counted(drive.contacts, "contact"), counted(drive.falls, "fall"), drive.stood_s));
  if (drive.floor_cells > 0)
    row("floor", fmt::format("{} of {} cells of 0.5 m, {} of {}", drive.cells_visited, drive.floor_cells,
                             drive.rooms_entered, counted(drive.rooms, "room")));
}

int execute_and_report(run::Source& source, host::Pipeline& pipeline, const run::RunPlan& plan,
                       const Report& report, const OutputOptions& output, Watcher* watcher) {
  catch_interrupts();
  run::RunHooks hooks;
  hooks.stop = interrupted;
  std::optional<Progress> progress;
  if (watcher != nullptr) {
    watcher->add_to(hooks);
  } else {
    progress.emplace(report.name, source.iterations(), output.quiet);
    hooks.progress = [&](std::uint32_t done) { progress->update(done); };
  }
  const run::RunResult result = run::execute(source, pipeline, plan, hooks);
  progress.reset();
  if (watcher != nullptr) watcher->finish(plan.folder);
  print_failures(result.failures);
  warn_of_missing(result.missing_pictures);
  const Outcome outcome{report, plugin_names(plan.manifest), plan.folder, result};
  output.print(document_of(outcome), table_of(outcome));
  return status_of(result);
}

}  // namespace hallway::cli
