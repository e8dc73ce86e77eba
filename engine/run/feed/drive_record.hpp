// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>

#include "host/pipeline.hpp"
#include "log/drive_tables.hpp"
#include "log/row_file.hpp"
#include "run/feed/log_recorder.hpp"
#include "run/sources/source.hpp"
#include "sim/driven_robot.hpp"
#include "sim/simulator.hpp"

namespace hallway::run {

/// Writes what a drive obeys, what its robot touches and what is made to happen into the tables drive.csv, contacts.csv and events.csv and into the log, while
/// the run goes on. A source without a drive leaves nothing of the first two, one without events nothing of the last. All functions throw Error{kIo}.
class DriveRecord {
 public:
  DriveRecord(const std::filesystem::path& folder, const Source& source);

  /// Who is shown what is written; may be empty.
  using Sink = std::function<void(const DriveNotes&, std::span<const log::EventRow>)>;

  /// Takes what is new in the source until the frame that was recorded last.
  void update(Source& source, LogRecorder& recorder, const Sink& sink = {});
  void close();

 private:
  std::optional<log::RowFile> commands_;
  std::optional<log::RowFile> contacts_;
  std::optional<log::RowFile> events_;
  std::size_t next_event_ = 0;
};

/// The member `drive` of metrics.json (docs/metrics.md).
nlohmann::ordered_json to_json(const sim::DriveCounts& counts);

/// The member `robot` of run.json (docs/formats.md): body and drive of a simulated robot with a drive.
nlohmann::ordered_json print_driven(const sim::Scenario& scenario);

/// Whether the last plugin of a pipeline that was started gives drive commands.
bool puts_commands(const host::Pipeline& pipeline);

/// The index of the plugin that drives: the one that the scenario names, or the only one that puts drive commands.
/// Throws Error{kBadInput} where there is none or several.
/// @param pipeline  was started
std::size_t driving_plugin(const host::Pipeline& pipeline, const sim::Scenario& scenario);

}  // namespace hallway::run
