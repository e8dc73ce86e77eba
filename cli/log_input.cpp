// SPDX-License-Identifier: MIT
#include "log_input.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "console.hpp"
#include "log/landmarks.hpp"
#include "log/observations.hpp"
#include "log/plane_observations.hpp"
#include "log/poses.hpp"
#include "log/true_planes.hpp"
#include "log/unfinished_input.hpp"
#include "record/sensor_json.hpp"
#include "run/pictures/record.hpp"
#include "run/sources/log_source.hpp"
#include "run/sources/recorded_run.hpp"

namespace hallway::cli {
namespace {

constexpr double kDefaultPeriod_s = 0.1;

/// A log of text files and what stands beside it.
struct Files {
  fs::path observations;
  std::optional<Json> manifest;  ///< run.json of its folder
  host::SensorInfo sensor{.name = "log"};
  std::optional<fs::path> true_poses;
  std::optional<fs::path> true_landmarks;
  std::optional<fs::path> true_planes;
};

std::optional<fs::path> if_there(const fs::path& path) {
  std::error_code code;
  return fs::exists(path, code) ? std::optional(path) : std::nullopt;
}

/// "observations.csv" or, of one of several sensors, "observations_NAME.csv".
bool is_observations(const fs::path& file, const fs::path& name) {
  return file.filename() == name || (file.stem().string().starts_with(name.stem().string() + "_") &&
                                     file.extension() == name.extension());
}

/// The file that is meant: in a folder the observations or, where it has none, the MCAP log. In one that a run has left unfinished it is the log, which can be
/// read up to its end; the tables may lack what was not yet written.
fs::path log_file(const std::string& log) {
  std::error_code code;
  const fs::path path = log;
  if (!fs::is_directory(path, code)) return path;
  if (!run::is_run_folder(path) && fs::exists(path / run::files::kLog, code)) return path / run::files::kLog;
  for (const char* name : {run::files::kObservations, run::files::kObservedPlanes, run::files::kLog}) {
    if (fs::exists(path / name, code)) return path / name;
  }
  std::vector<std::string> tables;  // of several sensors
  for (const auto& entry : fs::directory_iterator(path, code)) {
    const fs::path file = entry.path().filename();
    if (is_observations(file, run::files::kObservations) ||
        is_observations(file, run::files::kObservedPlanes))
      tables.push_back(file.string());
  }
  if (tables.empty()) return path / run::files::kObservations;
  std::ranges::sort(tables);
  throw Error(ErrorCode::kUsage,
              fmt::format("the folder has a table for each of several sensors; name one of: {}",
                          fmt::join(tables, ", ")),
              {.file = printable(log)});
}

/// A log is often called obs.csv: the folder says more.
std::string name_of(const fs::path& file) {
  std::error_code code;
  const fs::path absolute = fs::absolute(file, code);
  const std::string folder = absolute.parent_path().filename().string();
  return folder.empty() ? absolute.stem().string() : folder;
}

/// Of a run with several sensors that whose name the file has, else the first.
host::SensorInfo sensor_of(const Json& manifest, const fs::path& observations) {
  if (!manifest.contains("sensors") || manifest.at("sensors").empty()) return {.name = "log"};
  for (const Json& json : manifest.at("sensors")) {
    const host::SensorInfo sensor = record::read_sensor(json);
    if (observations.stem().string().ends_with("_" + sensor.name)) return sensor;
  }
  return record::read_sensor(manifest.at("sensors").front());
}

Files find_files(const LogChoice& choice, const fs::path& observations) {
  Files files;
  files.observations = observations;
  const fs::path folder = observations.parent_path();
  const bool is_named = is_observations(observations, run::files::kObservations) ||
                        is_observations(observations, run::files::kObservedPlanes);
  if (is_named && run::is_run_folder(folder)) {
    files.manifest = run::read_manifest(folder);
    files.sensor = sensor_of(*files.manifest, observations);
    files.true_poses = if_there(folder / run::files::kTruePoses);
    files.true_landmarks = if_there(folder / run::files::kTrueLandmarks);
    files.true_planes = if_there(folder / run::files::kTruePlanes);
  }
  if (!choice.true_poses.empty()) files.true_poses = choice.true_poses;
  if (!choice.true_landmarks.empty()) files.true_landmarks = choice.true_landmarks;
  return files;
}

std::int64_t period_of(const LogChoice& choice, const std::optional<Json>& manifest) {
  if (choice.period_s) return static_cast<std::int64_t>(*choice.period_s * 1e9 + 0.5);
  if (manifest && manifest->contains("period_ns")) return manifest->at("period_ns").get<std::int64_t>();
  return static_cast<std::int64_t>(kDefaultPeriod_s * 1e9);
}

OpenedLog open_csv(const LogChoice& choice, const fs::path& path) {
  const Files files = find_files(choice, path);
  OpenedLog opened;
  opened.manifest = files.manifest;
  opened.name = name_of(path);
  if (files.manifest) opened.name = files.manifest->value("name", "log");
  opened.period_ns = period_of(choice, files.manifest);
  const auto read_input = [&](const fs::path& file) -> const std::string& {
    opened.inputs.push_back({file.filename().string(), read_file(file)});
    return opened.inputs.back().content;
  };
  const std::string text = read_input(path);
  run::LogTruth truth;
  if (files.true_poses)
    truth.poses = log::parse_poses(read_input(*files.true_poses), files.true_poses->string());
  if (files.true_landmarks) {
    truth.landmarks = log::parse_landmarks(read_input(*files.true_landmarks), files.true_landmarks->string());
  }
  if (files.true_planes)
    truth.planes = log::parse_true_planes(read_input(*files.true_planes), files.true_planes->string());
  const auto take = [&](auto read) {
    if (read.damage) print_warning(opened.warnings, log::describe(*read.damage, read.log, path.string()));
    try {
      opened.source = std::make_unique<run::LogSource>(std::move(read.log), std::move(truth), files.sensor,
                                                       opened.period_ns, choice.steps);
    } catch (const Error& error) {
      throw Error(error.code(), error.message(),
                  {.file = printable(path.string()), .element = error.where().element});
    }
  };
  if (log::is_of_planes(text)) {
    take(log::parse_observed_planes(text, path.string()));
  } else {
    take(log::parse_observations(text, path.string()));
  }
  return opened;
}

OpenedLog open_mcap(const LogChoice& choice, const fs::path& path, std::string content) {
  check_no_csv_options(choice);
  OpenedLog opened;
  opened.inputs.push_back({path.filename().string(), std::move(content)});
  run::RecordedRun run;
  try {
    run = run::read_recorded_run(log::MemoryInput(opened.inputs.back().content));
  } catch (const Error& error) {
    throw Error(error.code(), error.message(), {.file = printable(path.string())});
  }
  if (run.damage) {
    print_warning(opened.warnings,
                  fmt::format("{}: byte {}: {}; kept what stands before: {} frames", printable(path.string()),
                              run.damage->offset, run.damage->cause, run.frames.size()));
  }
  opened.manifest = run.manifest;
  opened.name = run.manifest ? plain_name(run.manifest->at("name").get<std::string>()) : name_of(path);
  opened.period_ns = run.period_ns > 0 ? run.period_ns : period_of(choice, {});
  opened.source = std::make_unique<run::RecordedSource>(std::move(run), choice.steps);
  return opened;
}

}  // namespace

std::string plain_name(std::string name) {
  for (char& c : name) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    if (!plain) c = '_';
  }
  constexpr std::size_t kMaxName = 100;
  return name.empty() ? "log" : name.substr(0, kMaxName);
}

OpenedLog open_log(const LogChoice& choice) {
  const fs::path path = log_file(choice.log);
  const bool mcap = choice.form.empty() ? path.extension() == ".mcap" : choice.form == "mcap";
  if (!mcap) return open_csv(choice, path);
  const log::UnfinishedInput input(path);
  if (input.written() == input.size()) return open_mcap(choice, path, read_file(path));
  std::string content;
  input.read(0, input.size(), content);
  return open_mcap(choice, path, std::move(content));
}

void check_no_csv_options(const LogChoice& choice) {
  if (!choice.true_poses.empty() || !choice.true_landmarks.empty() || choice.period_s) {
    refuse(
        "an MCAP log holds its own truth and times: --truth-poses, --truth-landmarks and --period "
        "are for CSV");
  }
}

fs::path mcap_file(const std::string& path) {
  std::error_code code;
  return fs::is_directory(path, code) ? fs::path(path) / run::files::kLog : fs::path(path);
}

}  // namespace hallway::cli
