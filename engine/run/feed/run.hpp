// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eval/metrics.hpp"
#include "eval/topology_score.hpp"
#include "host/pipeline.hpp"
#include "record/failures.hpp"
#include "record/manifest.hpp"
#include "render/renderer.hpp"
#include "run/feed/command_comparison.hpp"
#include "run/feed/plugin_log.hpp"
#include "run/sources/source.hpp"
#include "sim/scenario.hpp"

namespace hallway::run {

/// A file that is kept in the run folder as it was read, so that the folder says all of what was run.
using record::Attachment;
using record::Failure;

/// What a run leaves behind, and where.
struct RunPlan {
  std::filesystem::path folder;  ///< final name of the run folder
  bool replace = false;          ///< an earlier run of that name may be replaced
  /// What run.json says beside what the run itself knows: command, settings with their origins, versions, warnings.
  nlohmann::ordered_json manifest;
  std::vector<Attachment> attachments;
  std::vector<sim::PictureSpec> pictures;
  render::Renderer renderer = render::Renderer::kAuto;  ///< of the pictures
  bool write_observations = false;                      ///< also the input, in the form that replay reads
  bool lock_step = true;  ///< one frame at a time; else as many as the pipeline takes are under way
  sim::OnFailure on_failure = sim::OnFailure::kStop;  ///< what becomes of it when a plugin fails
  bool compare_commands = false;                      ///< a replay's drive commands with those in the log
  std::vector<Failure> start_failures{};              ///< what start_plugins() has given
  /// Set: the log shows the run in Foxglove too, with what the plugins have logged here.
  std::shared_ptr<PluginLog> foxglove{};
};

struct FrameAnswer;  // frame_feed.hpp

/// What the caller is told and asked while a run goes on. Nothing that is done in between changes what the run writes.
struct RunHooks {
  std::function<void(std::uint32_t done)> progress;  ///< after each iteration
  std::function<bool()> stop;  ///< true ends the run after the iterations so far, in good order
  std::function<void(const FrameAnswer&)> answered{};  ///< of each iteration, before what follows
  /// Of each iteration: what the drive obeys from it on, and what happened to the robot until then.
  std::function<void(const DriveNotes&, std::span<const log::EventRow>)> driven{};
};

/// A picture that the plan wants and this machine has no renderer for.
struct MissingPicture {
  std::string file;   ///< its name in the run folder
  std::string cause;  ///< render::NoRenderer's message
};

/// How a run went.
struct RunResult {
  eval::Metrics metrics;
  std::optional<sim::DriveCounts> drive;  ///< of a robot that obeys
  /// Where the last plugin charts one and the walls are known.
  std::optional<eval::TopologyMetrics> topology;
  std::optional<CommandComparison> commands;    ///< where the plan wants it and the log has any
  std::uint64_t submaps = 0;                    ///< of the map at the end
  std::vector<std::filesystem::path> pictures;  ///< under their final names
  std::vector<MissingPicture> missing_pictures;
  bool stopped = false;       ///< by RunHooks::stop
  record::Failures failures;  ///< of the pipeline
};

/// [{"file": …, "cause": …}, …]
nlohmann::ordered_json to_json(const std::vector<MissingPicture>& missing);

/// Whether the last plugin of a pipeline that was started maps planes.
bool maps_planes(const host::Pipeline& pipeline);

/// Feeds every frame of the source to the pipeline, scores what it answers and writes the run folder (docs/formats.md).
///
/// The folder appears whole or not at all. Same source, pipeline and plan give the same bytes, but for timing.csv,
/// metrics.json: iteration_ms, iteration_cpu_ms and run.json: host.
/// A plugin that fails ends the run or not, as the plan says; the folder is written in any case, with the verdict in run.json. A pipeline that
/// start_plugins() could not start answers no frame.
/// Where there is no renderer the folder has everything but the pictures that need one, and run.json lists these. A renderer that the plan names is
/// asked for before the first frame, where it wants pictures: throws render::NoRenderer.
/// Throws Error{kIo} if the folder cannot be written, which is checked first.
RunResult execute(Source& source, host::Pipeline& pipeline, const RunPlan& plan, const RunHooks& hooks);

/// Writes files that were read, with the folders in their names. Throws Error{kIo}.
void write_attachments(const std::filesystem::path& folder, const std::vector<Attachment>& attachments);

}  // namespace hallway::run
