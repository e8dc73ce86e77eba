// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <memory>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "console.hpp"
#include "log/landmarks.hpp"
#include "log/plane_observations.hpp"
#include "log/poses.hpp"
#include "log/true_planes.hpp"
#include "log_foxglove.hpp"
#include "log_import.hpp"
#include "log_input.hpp"
#include "log_layouts.hpp"
#include "log_output.hpp"
#include "log_tables.hpp"
#include "output_file.hpp"
#include "record/output_folder.hpp"
#include "record/sensor_json.hpp"
#include "record/version.hpp"
#include "run/feed/log_recorder.hpp"
#include "run/feed/manifest.hpp"
#include "run/feed/observation_tables.hpp"
#include "run/pictures/record.hpp"
#include "shared_options.hpp"

namespace hallway::cli {
namespace {

struct ConvertOptions {
  LogChoice choice;
  std::string from;  ///< kind of the log; empty: what it looks like
  ImportChoice import;
  LayoutChoice layout;
  std::string out;
  bool foxglove = false;
  bool force = false;
  bool json = false;
};

/// What was written.
struct Converted {
  std::uint32_t frames = 0;
  std::vector<std::string> warnings{};
};

/// The facts of the run that wrote the log or, where nobody knows them, those of the log itself.
Json manifest_of(const OpenedLog& opened) {
  if (opened.manifest) return *opened.manifest;
  return {{"schema", "hallway.run/1"}, {"hallway", record::version()}, {"command", "convert"},
          {"name", opened.name},       {"inputs", Json::array()},      {"period_ns", opened.period_ns},
          {"settings", Json::array()}, {"plugins", Json::array()},     {"warnings", opened.warnings}};
}

/// A recording may take its time to read.
void stop_if_interrupted() {
  if (interrupted()) throw Error(ErrorCode::kInterrupted, "interrupted");
}

/// The log and the tables of truth.
std::vector<std::string> inputs_of(const ConvertOptions& options) {
  std::vector<std::string> inputs{options.choice.log};
  for (const std::string& table : {options.choice.true_poses, options.choice.true_landmarks}) {
    if (!table.empty()) inputs.push_back(table);
  }
  return inputs;
}

void write_mcap(OpenedLog& opened, const ConvertOptions& options) {
  NewFile file(options.out, options.force);
  run::LogRecorder recorder(file.output(), *opened.source, manifest_of(opened));
  if (options.foxglove) recorder.add_view(false);
  run::SourceFrame frame;
  Progress progress("convert", opened.source->iterations(), options.json);
  for (std::uint32_t i = 0; i < opened.source->iterations(); ++i) {
    stop_if_interrupted();
    opened.source->read(i, frame);
    recorder.record_input(frame);
    progress.update(i + 1);
  }
  recorder.finish();
  file.commit();
}

log::IterationPose pose_of(std::uint32_t iteration, const run::SourceFrame& frame) {
  const Pose& pose = *frame.T_world_body;
  return {.iteration = iteration,
          .position_m = {pose.t.x(), pose.t.y(), pose.t.z()},
          .orientation = {pose.q.w(), pose.q.x(), pose.q.y(), pose.q.z()},
          .orientation_known = frame.orientation_known};
}

void warn_of_times(std::uint32_t iteration, const run::SourceFrame& frame, std::int64_t period_ns) {
  if (frame.t_ns() == period_ns * static_cast<std::int64_t>(iteration)) return;
  print_warning(
      "frame {} lies at {} ns and not at {} periods of {} ns: CSV files have no times, and those of "
      "the log are lost",
      iteration, frame.t_ns(), iteration, period_ns);
}

void write_folder(OpenedLog& opened, const ConvertOptions& options) {
  record::OutputFolder folder(options.out, options.force);
  run::Source& source = *opened.source;
  run::ObservationTables observations(folder.working_path(), source);
  std::vector<log::IterationPose> poses;
  run::SourceFrame frame;
  bool regular = true;
  for (std::uint32_t i = 0; i < source.iterations(); ++i) {
    stop_if_interrupted();
    source.read(i, frame);
    observations.add(i, frame);
    if (frame.T_world_body) poses.push_back(pose_of(i, frame));
    if (regular) warn_of_times(i, frame, opened.period_ns);
    regular = regular && frame.t_ns() == opened.period_ns * static_cast<std::int64_t>(i);
  }
  Json manifest = manifest_of(opened);
  manifest["sensors"] = record::print_sensors(source.sensors());
  manifest["iterations"] = source.iterations();
  const fs::path& path = folder.working_path();
  observations.close();
  if (!poses.empty()) log::write_poses(path / run::files::kTruePoses, poses);
  if (source.true_landmarks())
    log::write_landmarks(path / run::files::kTrueLandmarks, *source.true_landmarks());
  if (source.true_planes()) log::write_true_planes(path / run::files::kTruePlanes, *source.true_planes());
  write_file_atomically(path / run::files::kRun,
                        manifest.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
  folder.commit();
}

void write_tum(OpenedLog& opened, const ConvertOptions& options) {
  NewFile file(options.out, options.force);
  write_true_trajectory(opened, options.layout, file.output(), options.json);
  file.commit();
}

/// A folder without run.json: it is not one that --force replaces.
void write_new_folder(OpenedLog& opened, Layout layout, const ConvertOptions& options) {
  record::OutputFolder folder(options.out, options.force);
  if (layout == Layout::kTables) {
    write_tables(opened, options.layout.sensor, folder.working_path(), options.json);
  } else {
    write_layout(opened, layout, options.layout, folder.working_path(), options.json);
  }
  folder.commit();
}

std::optional<import::Kind> kind_of(const ConvertOptions& options) {
  if (options.from.empty()) return import::tell_kind(options.choice.log);
  return import::kind_named(options.from);
}

OpenedLog open_input(const ConvertOptions& options) {
  const auto kind = kind_of(options);
  check_import_options(kind, options.choice, options.import);
  if (kind) return open_recording(*kind, options.choice, options.import);
  LogChoice choice = options.choice;
  choice.form = options.from;
  return open_log(choice);
}

/// An MCAP log is not recorded anew for a view of it, but copied: the view shows the answers, too.
Converted copy_with_view(const ConvertOptions& options, const fs::path& log) {
  NewFile file(options.out, options.force);
  Converted converted;
  converted.frames = write_with_foxglove(options.choice, log, file.output(), converted.warnings);
  file.commit();
  return converted;
}

/// What could be told only when everything had been read.
void add_missing(OpenedLog& opened) {
  if (!opened.missing) return;
  for (std::string& line : opened.missing()) {
    print_warning(opened.warnings, std::move(line));
  }
}

Converted convert_input(const ConvertOptions& options) {
  const Layout layout = chosen_layout(options.layout, options.out);
  if (options.foxglove && layout != Layout::kMcap) refuse("--foxglove is for an .mcap file");
  check_replaces_no_input(options.out, inputs_of(options));
  if (options.foxglove && !kind_of(options)) {
    if (const auto log = recorded_log(options.choice.log)) return copy_with_view(options, *log);
  }
  OpenedLog opened = open_input(options);
  if (layout == Layout::kMcap) {
    write_mcap(opened, options);
  } else if (layout == Layout::kReplay) {
    write_folder(opened, options);
  } else if (layout == Layout::kTum) {
    write_tum(opened, options);
  } else {
    write_new_folder(opened, layout, options);
  }
  add_missing(opened);
  return {opened.source->iterations(), opened.warnings};
}

int convert(const ConvertOptions& options) {
  catch_interrupts();
  const Converted converted = convert_input(options);
  if (options.json) {
    print_json({{"schema", "hallway.log_convert/1"},
                {"status", 0},
                {"written", path_text(options.out)},
                {"frames", converted.frames},
                {"warnings", converted.warnings}});
  } else {
    print_result("{}: {} frames\n", path_text(options.out), converted.frames);
  }
  return 0;
}

}  // namespace

void add_log_convert_command(Command& group) {
  Command& command = group.command("convert",
                                   "Turn an MCAP log into the CSV files of replay or a layout of other "
                                   "programs, and those or a recording of other programs into an MCAP log");
  ConvertOptions& options = command.runs(&convert);
  command
      .argument("log", &options.choice.log,
                "An .mcap file, a CSV file of observations, or a run folder; a folder of point clouds "
                "(.ply, .pcd) or one "
                "of them, a TUM RGB-D folder, the folder of Victoria Park, a table of stereo tracks or of "
                "ranges and "
                "bearings, a ROS 1 .bag, a sequence of KITTI odometry, a EuRoC folder, a folder of PCD files "
                "with an imu.csv")
      .required()
      .value("LOG");
  command.option("--from", &options.from, "What it is [what it looks like]")
      .value("KIND")
      .choices({"csv", "mcap", "clouds", "tum", "victoria-park", "stereo-tracks", "range-bearing", "bag",
                "kitti", "euroc", "pcd-imu"});
  add_shared(command, Shared::kOutLog, &options.out).required();
  add_shared(command, Shared::kTruePoses, &options.choice.true_poses).fallback("those of the log");
  add_shared(command, Shared::kTrueLandmarks, &options.choice.true_landmarks).fallback("those of the log");
  add_shared(command, Shared::kPeriod, &options.choice.period_s).fallback("the run's, else 0.1");
  add_shared(command, Shared::kFoxglove, &options.foxglove);
  add_layout_options(command, options.layout);
  add_import_options(command, options.import);
  add_shared(command, Shared::kForce, &options.force);
  add_shared(command, Shared::kJson, &options.json);
  command.footer(
      "Without --foxglove, what plugins answered is not carried over: it is the replay that answers anew.\n"
      "Examples: hallway log convert out/office/run.mcap --out office_csv\n"
      "          hallway log convert obs.csv --truth-poses poses.csv --period 0.05 --out mine.mcap\n"
      "          hallway log convert out/office/run.mcap --foxglove --out office_view.mcap\n"
      "          hallway log convert rgbd_dataset_freiburg1_desk --stride 8 --out desk.mcap\n"
      "          hallway log convert out/office_rig --to kitti --sensor lidar --deskew --out office_kitti");
}

}  // namespace hallway::cli
