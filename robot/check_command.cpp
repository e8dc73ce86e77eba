// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>
#include <utility>

#include "base/text.hpp"
#include "console.hpp"
#include "host/isolate/isolated_plugin.hpp"
#include "host/load/plugin_info.hpp"
#include "host/samples/sample_kind.hpp"
#include "record/robot_parts_json.hpp"
#include "robot/command.hpp"
#include "robot/session.hpp"

namespace hallway::robot {
namespace {

using cli::Json;

/// What is found out about a configuration, and all that is wrong with it.
struct Findings {
  std::vector<Error> problems{};
  std::string driver{};
  std::optional<host::RobotInfo> robot{};
  Timing timing{};
  std::vector<std::string> plugins{};
};

void note_problem(Findings& findings, const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& problem) {
    findings.problems.push_back(problem);
  }
}

/// Opens the robot and closes it; no frame is read and nothing written.
void check_driver(Findings& findings, const Config& config, const Surroundings& surroundings) {
  note_problem(findings, [&] {
    host::Driver driver(host::find_driver(config.driver.name, surroundings.driver_folders), surroundings.log);
    findings.driver = driver.info().id + " " + driver.info().version;
    driver.open(config.driver.settings, config.folder());
    host::RobotInfo robot = driver.describe();
    override_parts(config.parts, robot);
    findings.robot = std::move(robot);
    findings.timing = timing_of(config, *findings.robot);
  });
}

/// Loads a plugin, in a process of its own, and gives it its parameters and the sensors.
void check_plugin(Findings& findings, const host::StageSpec& spec, const Surroundings& surroundings) {
  note_problem(findings, [&] {
    const auto isolation = surroundings.isolation.value_or(host::Isolation{});
    if (findings.robot) {
      host::Pipeline pipeline(
          {spec}, surroundings.plugin_folders,
          host::Activation{findings.robot->sensors, findings.robot->drive, findings.robot->body},
          surroundings.log, isolation);
      findings.plugins.push_back(pipeline.stage(0).info().id + " " + pipeline.stage(0).info().version);
      return;
    }
    // What it would say of sensors that nobody knows is not asked for.
    host::IsolatedPlugin plugin(spec.plugin, surroundings.plugin_folders, isolation, surroundings.log);
    for (const host::ParameterSetting& setting : spec.parameters) {
      plugin.set_parameter(setting.name, setting.value, setting.where);
    }
    findings.plugins.push_back(plugin.info().id + " " + plugin.info().version);
  });
}

std::string time_text(const Timing& timing, const host::RobotInfo& robot) {
  if (robot.lock_step) return "lock-step: every frame is answered before the next one is read";
  const std::string period = timing.period_ns > 0
                                 ? fmt::format("{:g} ms", static_cast<double>(timing.period_ns) * 1e-6)
                                 : "not known";
  return fmt::format("real time{}; period {}; watchdog {:g} ms", timing.tick ? ", on a schedule" : "", period,
                     milliseconds(timing.watchdog));
}

/// Its kind and the numbers that are known, a line each.
std::string drive_text(const host::DriveInfo& drive) {
  std::string text(host::kDriveNames.at(drive.kind));
  for (const host::DriveNumber& number : host::drive_numbers()) {
    if (!std::isnan(drive.*number.host))
      text += fmt::format("\n{:13}{} = {:g}", "", number.key, drive.*number.host);
  }
  return text;
}

std::string body_text(const host::BodyInfo& body) {
  const auto number = [](double value) {
    return std::isnan(value) ? std::string("not known") : fmt::format("{:g} m", value);
  };
  return fmt::format("{}, radius {}, from {} to {}",
                     body.corners.empty() ? "round" : fmt::format("{} corners", body.corners.size()),
                     number(host::outer_radius_m(body)), number(body.bottom_m), number(body.top_m));
}

std::string table_of(const Findings& findings) {
  std::string text;
  const cli::Rows row{text, 10};
  if (!findings.driver.empty()) row("driver", findings.driver);
  if (findings.robot) {
    row("robot", findings.robot->name);
    row("time", time_text(findings.timing, *findings.robot));
    for (const host::SensorInfo& sensor : findings.robot->sensors) {
      row("sensor", fmt::format("{}: {} ({})", sensor.id, sensor.name, host::sample_kind_name(sensor.kind)));
    }
  }
  if (findings.robot && findings.robot->drive) row("drive", drive_text(*findings.robot->drive));
  if (findings.robot && findings.robot->body) row("body", body_text(*findings.robot->body));
  for (const std::string& plugin : findings.plugins) row("plugin", plugin);
  return text;
}

Json document_of(const Findings& findings, int status) {
  Json problems = Json::array();
  for (const Error& problem : findings.problems) problems.push_back(problem.what());
  Json sensors = Json::array();
  if (findings.robot) {
    for (const host::SensorInfo& sensor : findings.robot->sensors) {
      sensors.push_back(
          {{"id", sensor.id}, {"name", sensor.name}, {"kind", host::sample_kind_name(sensor.kind)}});
    }
  }
  const bool has_drive = findings.robot && findings.robot->drive;
  const bool has_body = findings.robot && findings.robot->body;
  return {{"schema", "hallway.robot_check/1"},
          {"status", status},
          {"driver", findings.driver},
          {"robot", findings.robot ? Json(findings.robot->name) : Json()},
          {"lock_step", findings.robot ? Json(findings.robot->lock_step) : Json()},
          {"sensors", sensors},
          {"drive", has_drive ? record::print_drive(*findings.robot->drive) : Json()},
          {"body", has_body ? record::print_body(*findings.robot->body) : Json()},
          {"plugins", findings.plugins},
          {"warnings", findings.timing.warnings},
          {"problems", problems}};
}

int check(const ConfigOptions& options) {
  const Config config = load_config(options.config, overrides_of(options));
  const Surroundings surroundings = surroundings_of(options, config.limits);
  Findings findings;
  check_driver(findings, config, surroundings);
  for (const host::StageSpec& spec : config.pipeline) check_plugin(findings, spec, surroundings);
  const int status = findings.problems.empty() ? 0 : exit_status(findings.problems.front().code());
  for (const std::string& warning : findings.timing.warnings) cli::print_warning(warning);
  if (options.json) {
    cli::print_json(document_of(findings, status));
    return status;
  }
  for (const Error& problem : findings.problems) fmt::print(stderr, "hallway: {}\n", problem.what());
  cli::print_result(table_of(findings) + (status == 0 ? "ready to run\n" : ""));
  return status;
}

}  // namespace

void add_check_command(cli::Command& app) {
  cli::Command& command = app.command(
      "check",
      "Say all that is wrong with a configuration: opens the robot, reads no frame and writes no command");
  ConfigOptions& options = command.runs(&check);
  add_config_options(command, options);
  command.footer("Example: hallway-robot check robot.toml");
}

}  // namespace hallway::robot
