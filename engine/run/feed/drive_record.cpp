// SPDX-License-Identifier: MIT
#include "run/feed/drive_record.hpp"

#include <fmt/format.h>
#include <hallway/output.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "base/text.hpp"
#include "log/drive_tables.hpp"
#include "record/files.hpp"
#include "sim/robot_body.hpp"

namespace hallway::run {
namespace {

namespace files = record::files;

bool puts_commands(const host::StageFacts& plugin) {
  return std::ranges::count(plugin.info.outputs, std::uint32_t{HW_OUTPUT_DRIVE_COMMAND}) > 0;
}

nlohmann::ordered_json print_body(const sim::RobotSpec& robot) {
  const auto [bottom_m, top_m] = sim::height_of(robot);
  const std::vector<Vec2> outline = sim::outline_of(robot);
  if (outline.empty()) {
    const double radius_m = std::get<bsp::Cylinder>(*robot.body).radius_m;
    return {{"radius_m", radius_m}, {"middle_m", {0.0, 0.0}}, {"bottom_m", bottom_m}, {"top_m", top_m}};
  }
  nlohmann::ordered_json corners = nlohmann::ordered_json::array();
  for (const Vec2& corner : outline) corners.push_back({corner.x(), corner.y()});
  return {{"corners_m", corners}, {"bottom_m", bottom_m}, {"top_m", top_m}};
}

}  // namespace

DriveRecord::DriveRecord(const std::filesystem::path& folder, const Source& source) {
  if (!source.facts().events.empty()) events_.emplace(folder / files::kEvents, ',', log::kEventColumns);
  if (!source.is_closed_loop()) return;
  commands_.emplace(folder / files::kObeyedCommands, ',', log::kObeyedColumns);
  contacts_.emplace(folder / files::kContacts, ',', log::kContactColumns);
}

void DriveRecord::update(Source& source, LogRecorder& recorder, const Sink& sink) {
  const std::vector<log::EventRow>& events = source.facts().events;
  const std::size_t first_event = next_event_;
  for (; next_event_ < events.size() && events[next_event_].t_ns <= recorder.stamp().t_ns; ++next_event_) {
    log::add_row(events_->next_row(), events[next_event_]);
    recorder.record_event(events[next_event_]);
  }
  const DriveNotes notes = commands_ ? source.take_drive_notes() : DriveNotes();
  if (sink) sink(notes, std::span(events).subspan(first_event, next_event_ - first_event));
  if (!commands_) return;
  for (const log::ContactRow& contact : notes.contacts) {
    log::add_row(contacts_->next_row(), contact);
    recorder.record_contact(contact);
  }
  for (const log::ObeyedCommand& command : notes.commands) {
    log::add_row(commands_->next_row(), command);
    recorder.record_obeyed(command);
  }
}

void DriveRecord::close() {
  if (events_) events_->close();
  if (!commands_) return;
  commands_->close();
  contacts_->close();
}

nlohmann::ordered_json to_json(const sim::DriveCounts& counts) {
  return {{"commands", counts.commands},
          {"commands_clamped", counts.clamped},
          {"commands_left_out", counts.left_out},
          {"stops", counts.stops},
          {"distance_m", counts.distance_m},
          {"contacts", counts.contacts},
          {"falls", counts.falls},
          {"stood_s", counts.stood_s},
          {"floor_cells", counts.floor_cells},
          {"cells_visited", counts.cells_visited},
          {"rooms", counts.rooms},
          {"rooms_entered", counts.rooms_entered}};
}

nlohmann::ordered_json print_driven(const sim::Scenario& scenario) {
  static constexpr std::array kDrivers{"plugin", "path", "commands"};  // in the order of DrivenBy
  const sim::DrivenSpec& driven = *scenario.robot.driven;
  return {{"closed_loop", true},
          {"driven_by", kDrivers.at(static_cast<std::size_t>(driven.by))},
          {"body", print_body(scenario.robot)},
          {"drive", {{"kind", drive::name_of(driven.drive.kind)}}}};
}

bool puts_commands(const host::Pipeline& pipeline) {
  return !pipeline.facts().empty() && puts_commands(pipeline.facts().back());
}

std::size_t driving_plugin(const host::Pipeline& pipeline, const sim::Scenario& scenario) {
  const std::string& wanted = scenario.robot.driven->plugin;
  const std::vector<host::StageFacts>& plugins = pipeline.facts();
  const Where where{printable(scenario.file), 0, "table `robot`"};
  std::vector<std::size_t> able;
  for (std::size_t i = 0; i < plugins.size(); ++i) {
    if (!wanted.empty() && plugins[i].info.id != wanted) continue;
    if (!wanted.empty() && !puts_commands(plugins[i]))
      throw Error(ErrorCode::kBadInput, "the plugin `" + printable(wanted) + "` gives no drive commands",
                  where);
    if (puts_commands(plugins[i])) able.push_back(i);
  }
  if (able.size() == 1) return able.front();
  if (!wanted.empty() && able.empty())
    throw Error(ErrorCode::kBadInput,
                "driving_plugin = \"" + printable(wanted) + "\" is no plugin of the scenario", where);
  if (able.empty())
    throw Error(
        ErrorCode::kBadInput,
        "a plugin is to drive the robot, and none of the scenario's gives drive commands; `driven_by` may be "
        "\"path\" or \"commands\"",
        where);
  throw Error(ErrorCode::kBadInput,
              "several plugins give drive commands; `driving_plugin` says which one drives", where);
}

}  // namespace hallway::run
