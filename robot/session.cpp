// SPDX-License-Identifier: MIT
#include "robot/session.hpp"

#include <algorithm>

#include "record/files.hpp"
#include "record/manifest.hpp"
#include "record/output_folder.hpp"
#include "record/plugin_topology.hpp"
#include "robot/robot_json.hpp"
#include "robot/watchdog.hpp"

namespace hallway::robot {
namespace {

using std::chrono::duration_cast;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr milliseconds kLeastWatchdog{50};
constexpr milliseconds kWatchdogWithoutPeriod{500};

record::ManifestFacts facts_of(const Config& config, const Timing& timing) {
  return {.command = "robot",
          .name = config.name(),
          .inputs = {{std::filesystem::path(config.file).filename().string(), config.content}},
          .settings = config.settings,
          .parameters = record::origins_of(config.pipeline),
          .warnings = timing.warnings,
          .period_ns = timing.period_ns};
}

/// A robot with its plugins, opened and ready for the first frame.
class Session {
 public:
  Session(const Config& config, const Surroundings& surroundings, const SessionPlan& plan)
      : config_(config),
        plan_(plan),
        output_(plan.folder, plan.replace),
        driver_(host::find_driver(config.driver.name, surroundings.driver_folders), surroundings.log) {
    driver_.open(config.driver.settings, config.folder());
    robot_ = driver_.describe();
    override_parts(config.parts, robot_);
    timing_ = timing_of(config, robot_);
    pipeline_.emplace(config.pipeline, surroundings.plugin_folders,
                      host::Activation{robot_.sensors, robot_.drive, robot_.body}, surroundings.log,
                      surroundings.isolation);
    result_.manifest = record::make_manifest(facts_of(config, timing_), *pipeline_);
    result_.manifest["driver"] = print_driver(config, driver_);
    result_.manifest["sensors"] = print_sensors(robot_);
    result_.manifest["limits"] = print_limits(config.limits);
  }

  SessionResult run(const SessionHooks& hooks) {
    for (const std::string& warning : timing_.warnings) hooks.notice(warning);
    Recorder recorder(output_.working_path(), log_facts(), robot_.lock_step);
    Gate gate([&](const hw_answer_t& answer) { driver_.write(answer); }, timing_.watchdog, Clock::now());
    Loop loop({driver_, robot_, *pipeline_, gate, recorder}, loop_plan(), {hooks.stop, hooks.notice});
    {
      Watchdog watchdog(gate, hooks.stop);
      hooks.started(watchdog.wake());
      drive(loop, gate);
      hooks.started(-1);
    }
    const std::vector<host::Counter> driver_counters = driver_.counters();
    driver_.close();
    finish(loop, gate, recorder, driver_counters);
    return std::move(result_);
  }

 private:
  std::optional<record::LogFacts> log_facts() const {
    if (!config_.record) return std::nullopt;
    return record::LogFacts{.manifest = result_.manifest,
                            .activation = {robot_.sensors, robot_.drive, robot_.body},
                            .period_ns = timing_.period_ns,
                            .has_identities = false};
  }

  LoopPlan loop_plan() const {
    return {.tick = timing_.tick,
            .deadline = timing_.deadline,
            .backlog = config_.backlog,
            .report_every_ns = static_cast<std::int64_t>(config_.report_every_s * 1e9),
            .command_timeout_ns = static_cast<std::int64_t>(config_.command_timeout_s * 1e9),
            .duration = plan_.duration,
            .on_failure = config_.limits.on_failure};
  }

  /// Whatever ends the loop: the robot is stopped first.
  void drive(Loop& loop, Gate& gate) {
    try {
      result_.end = loop.run();
      gate.end("the host ends");
    } catch (const Error& failure) {
      // Of the two that may fail, the driver and the recorder, the first is told at the end, when what there is was written.
      result_.driver_failure = failure;
      try {
        gate.end(failure.message());
      } catch (const Error&) {  // it has failed already
      }
    }
  }

  void finish(Loop& loop, const Gate& gate, Recorder& recorder,
              const std::vector<host::Counter>& driver_counters) {
    record::FinalMap map = loop.final_map();
    recorder.finish(map);
    for (std::size_t i = 0; i < pipeline_->size(); ++i) {
      const host::PluginInfo& info = pipeline_->stage(i).info();
      result_.plugins.push_back(info.id + " " + info.version);
    }
    loop.close();
    result_.failures = loop.failures();
    result_.landmarks = static_cast<std::uint64_t>(
        std::ranges::count(map.landmarks, log::LandmarkStatus::kMapped, &log::MapLandmark::status));
    result_.planes = map.planes.size();
    result_.submaps = map.submaps.size();
    record::write_map(output_.working_path(), map);
    result_.manifest["iterations"] = loop.counts().iterations;
    result_.manifest["stopped_early"] = result_.end == LoopEnd::kInterrupt;
    record::describe_failures(config_.limits.on_failure, result_.failures, result_.manifest);
    if (map.topology) result_.manifest["topology"] = record::describe_topology(*map.topology);
    result_.manifest["robot"] = print_robot({.robot = robot_,
                                             .timing = timing_,
                                             .loop = loop,
                                             .gate = gate.counts(),
                                             .unrecorded = recorder.unrecorded(),
                                             .driver_counters = driver_counters,
                                             .command_timeout_s = config_.command_timeout_s,
                                             .end = end_name()});
    record::write_json(output_.working_path() / record::files::kRun, result_.manifest);
    output_.commit();
  }

  std::string end_name() const {
    if (result_.driver_failure) return "failure";
    return loop_end_name(result_.end);
  }

  const Config& config_;
  const SessionPlan& plan_;
  record::OutputFolder output_;
  host::Driver driver_;
  host::RobotInfo robot_;
  Timing timing_;
  std::optional<host::Pipeline> pipeline_;
  SessionResult result_;
};

}  // namespace

Timing timing_of(const Config& config, const host::RobotInfo& robot) {
  Timing timing;
  timing.period_ns = robot.period_ns;
  if (robot.lock_step) {
    if (config.rate_hz) timing.warnings.push_back("robot.rate_hz is not used: the robot is in lock-step");
    if (config.watchdog) {
      timing.warnings.push_back("robot.watchdog_ms is not used: the robot is in lock-step");
    }
    return timing;
  }
  if (config.rate_hz) {
    timing.tick = nanoseconds(static_cast<std::int64_t>(1e9 / *config.rate_hz + 0.5));
    timing.period_ns = duration_cast<nanoseconds>(*timing.tick).count();
  }
  if (timing.period_ns > 0) timing.deadline = nanoseconds(timing.period_ns);
  const Clock::duration by_period =
      timing.period_ns > 0 ? std::max<Clock::duration>(2 * nanoseconds(timing.period_ns), kLeastWatchdog)
                           : Clock::duration(kWatchdogWithoutPeriod);
  timing.watchdog = config.watchdog ? Clock::duration(*config.watchdog) : by_period;
  return timing;
}

SessionResult run_session(const Config& config, const Surroundings& surroundings, const SessionPlan& plan,
                          const SessionHooks& hooks) {
  return Session(config, surroundings, plan).run(hooks);
}

}  // namespace hallway::robot
