// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "console.hpp"
#include "plugin_report.hpp"
#include "robot/command.hpp"
#include "robot/session.hpp"
#include "shared_options.hpp"

namespace hallway::robot {
namespace {

namespace fs = std::filesystem;
using cli::Json;

struct RunOptions {
  ConfigOptions config;
  std::string out;
  std::optional<double> duration_s;
  bool force = false;
  bool quiet = false;
};

int status_of(const SessionResult& result) {
  if (result.driver_failure) return exit_status(result.driver_failure->code());
  if (result.failures.count != 0) return exit_status(ErrorCode::kPluginFault);
  return result.end == LoopEnd::kInterrupt ? cli::interrupt_status() : 0;
}

std::string deadline_text(const Json& timing) {
  if (timing.at("deadline_ms").is_null()) return "none";
  return fmt::format("{} missed ({:.4f} %), {:g} ms each", timing.at("deadline_misses").get<std::uint64_t>(),
                     100.0 * timing.at("deadline_miss_share").get<double>(),
                     timing.at("deadline_ms").get<double>());
}

std::string table_of(const SessionResult& result, const std::string& name, const fs::path& folder) {
  const Json& robot = result.manifest.at("robot");
  const Json& frames = robot.at("frames");
  const Json& timing = robot.at("timing");
  std::string text = fmt::format("{}: {} on {}{}\n", name, fmt::join(result.plugins, " + "),
                                 result.manifest.at("driver").at("id").get<std::string>(),
                                 result.end == LoopEnd::kInterrupt ? " (stopped early)" : "");
  const cli::Rows row{text, 28};
  const auto count = [&](const char* key) { return frames.at(key).get<std::uint64_t>(); };
  row("frames",
      fmt::format("{} given, {} answered; {} lost, {} dropped, {} refused, {} unrecorded", count("given"),
                  count("answered"), count("lost"), count("dropped"), count("refused"), count("unrecorded")));
  row("landmarks mapped",
      fmt::format("{} in {} submap{}", result.landmarks, result.submaps, result.submaps == 1 ? "" : "s"));
  if (result.planes > 0) row("planes mapped", fmt::to_string(result.planes));
  if (const Json& latency = timing.at("latency_ms"); !latency.is_null()) {
    row("latency",
        fmt::format("{:.4f} ms median, {:.4f} p99, {:.4f} worst", latency.at("median").get<double>(),
                    latency.at("p99").get<double>(), latency.at("worst").get<double>()));
  }
  row("deadlines", deadline_text(timing));
  if (!robot.at("watchdog_ms").is_null()) {
    row("watchdog",
        fmt::format("stopped the robot {} times; {:g} ms, {:.1f} ms at the worst; {} late answers",
                    timing.at("watchdog_trips").get<std::uint64_t>(), robot.at("watchdog_ms").get<double>(),
                    timing.at("worst_stop_ms").get<double>(),
                    timing.at("late_answers").get<std::uint64_t>()));
  }
  if (result.failures.count != 0) {
    row("plugin failures", fmt::format("{}, {} restarts", result.failures.count, result.failures.restarts));
  }
  row("written to", cli::path_text(folder));
  return text;
}

Json document_of(const SessionResult& result, const std::string& name, const fs::path& folder) {
  Json document{{"schema", "hallway.robot_result/1"},
                {"status", status_of(result)},
                {"name", name},
                {"plugins", result.plugins},
                {"folder", cli::path_text(folder)},
                {"landmarks", result.landmarks},
                {"mapped_planes", result.planes},
                {"submaps", result.submaps}};
  for (const char* key : {"warnings", "driver", "verdict", "failures", "restarts", "robot"}) {
    document[key] = result.manifest.at(key);
  }
  if (result.driver_failure) document["error"] = result.driver_failure->what();
  return document;
}

int run(const RunOptions& options) {
  const Config config = load_config(options.config.config, overrides_of(options.config));
  SessionPlan plan{.folder = options.out.empty() ? fs::path("out") / config.name() : fs::path(options.out),
                   .replace = options.force};
  if (options.duration_s) {
    plan.duration = std::chrono::nanoseconds(static_cast<std::int64_t>(*options.duration_s * 1e9));
  }
  const SessionResult result =
      run_session(config, surroundings_of(options.config, config.limits), plan,
                  {.started = [](int wake) { cli::catch_interrupts(wake); },
                   .stop = cli::interrupted,
                   .notice = [](const std::string& message) { cli::print_warning(message); }});
  cli::print_failures(result.failures);
  cli::OutputOptions{.json = options.config.json, .quiet = options.quiet}.print(
      document_of(result, config.name(), plan.folder), table_of(result, config.name(), plan.folder));
  if (result.driver_failure) fmt::print(stderr, "hallway: {}\n", result.driver_failure->what());
  return status_of(result);
}

}  // namespace

void add_run_command(cli::Command& app) {
  cli::Command& command = app.command(
      "run", "Run plugins on a robot: its frames in, their commands out, until the robot ends or Ctrl-C");
  RunOptions& options = command.runs(&run);
  add_config_options(command, options.config);
  cli::add_shared(command, cli::Shared::kOutFolder, &options.out).fallback("out/<config>");
  command.option("--duration", &options.duration_s, "Seconds after which to end [until the robot ends]")
      .value("S")
      .range(0.001, 1e9);
  cli::add_shared(command, cli::Shared::kForce, &options.force);
  cli::add_shared(command, cli::Shared::kQuiet, &options.quiet);
  command.footer("Example: hallway-robot run robot.toml --out out/monday");
}

}  // namespace hallway::robot
