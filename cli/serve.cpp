// SPDX-License-Identifier: MIT
#include "run/serving/serve.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <random>

#include "base/file.hpp"
#include "base/parallel.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "console.hpp"
#include "eval/metrics_json.hpp"
#include "link/lossy_wire.hpp"
#include "link/udp_wire.hpp"
#include "log/observations.hpp"
#include "log_input.hpp"
#include "report.hpp"
#include "run/feed/drive_record.hpp"
#include "run/feed/manifest.hpp"
#include "run/pictures/record.hpp"
#include "run/sources/simulated_source.hpp"
#include "scenario_input.hpp"
#include "shared_options.hpp"
#include "sim/scenario.hpp"
#include "sim/simulator.hpp"

namespace hallway::cli {
namespace {

constexpr double kGiveUpSeconds = 10;

struct ServeOptions : OutputOptions {
  std::string input;
  std::string udp;
  bool lock_step = false;
  double rate = 1.0;
  double loss = 0;
  std::uint64_t loss_seed = 1;
  double give_up_s = kGiveUpSeconds;
  std::optional<std::uint32_t> steps;
  std::optional<std::uint64_t> seed;
  std::vector<std::string> settings;
  unsigned threads = hardware_threads();
  std::string out;
  bool strict = false;
};

/// What is served: frames, and what manifest and log have of where they come from.
struct Input {
  OpenedScenario scenario{};  ///< of a log: its facts alone
  std::unique_ptr<run::Source> source{};
};

Input open_simulation(const ServeOptions& options) {
  Input input{.scenario = open_scenario(options.input,
                                        scenario_overrides(options.settings, options.seed, options.steps),
                                        options.threads, options.strict)};
  input.source = std::make_unique<run::SimulatedSource>(*input.scenario.simulator);
  return input;
}

Input open_recording(const ServeOptions& options) {
  if (options.seed || !options.settings.empty()) {
    refuse("--seed and --set are for scenarios, not for logs");
  }
  OpenedLog log = open_log({.log = options.input, .steps = options.steps.value_or(0)});
  Input input;
  input.source = std::move(log.source);
  input.scenario.facts.name = log.name;
  input.scenario.facts.warnings = log.warnings;
  input.scenario.facts.period_ns = log.period_ns;
  input.scenario.facts.inputs = std::move(log.inputs);
  return input;
}

std::string round_trip_text(const std::optional<eval::TimeSummary>& times) {
  if (!times) return "unknown";
  return fmt::format("{:.3f} ms mean, {:.3f} median, {:.3f} p99, {:.3f} worst", times->mean, times->p50,
                     times->p99, times->max);
}

std::string end_text(const run::ServeResult& result, double give_up_s) {
  switch (result.end) {
    case run::ServeResult::End::kAllSent:
      return "";
    case run::ServeResult::End::kLeft:
      return " (the robot program left)";
    case run::ServeResult::End::kSilent:
      return fmt::format(" (nothing was heard from the robot program for {} s)", give_up_s);
    case run::ServeResult::End::kStopped:
      return " (stopped early)";
  }
  return "";
}

std::string rmse_text(const eval::Metrics& metrics) {
  const auto& rmse = metrics.position_rmse_m.aligned;
  const std::uint64_t posed = metrics.iterations - metrics.lost_iterations.value_or(metrics.iterations);
  return fmt::format("{} over {} of {} frames with a pose", rmse ? fmt::format("{:.4f} m", *rmse) : "unknown",
                     posed, metrics.iterations);
}

std::string table_of(const std::string& name, const ServeOptions& options, const run::ServeResult& result) {
  std::string text = fmt::format("{}{}\n", name, end_text(result, options.give_up_s));
  const Rows row{text, 28};
  const link::RobotCounters& counters = result.counters;
  row("frames", fmt::format("{} sent, {} answered, {} with a command", result.frames, result.answered,
                            result.commands));
  row("answers",
      fmt::format("{} late, {} failed, {} repeated", result.late, result.failed, counters.repeated_answers));
  row("datagrams", fmt::format("{} sent, {} sent again; {} malformed, {} foreign", counters.datagrams,
                               counters.resent, counters.malformed, counters.foreign));
  if (!options.lock_step) row("sent late", fmt::format("{} frames", result.sent_late));
  row("round trip", round_trip_text(result.round_trip_ms));
  if (result.frames_alone > 0)
    row("after it had gone", fmt::format("{}, until the robot stood", counted(result.frames_alone, "frame")));
  if (result.drive) add_drive(row, *result.drive);
  if (result.metrics) row("position RMSE, aligned", rmse_text(*result.metrics));
  if (!options.out.empty()) row("written to", path_text(options.out));
  return text;
}

/// 0 if the robot program had all or left of its own will, 1 if it was given up.
int status_of(const run::ServeResult& result) {
  if (result.end == run::ServeResult::End::kSilent) return 1;
  return result.end == run::ServeResult::End::kStopped ? interrupt_status() : 0;
}

int serve(const ServeOptions& options) {
  const link::Address listen = link::parse_address(options.udp);
  const bool is_scenario =
      fs::path(options.input).extension() == ".toml" || fs::path(options.input).extension() == ".map";
  Input input = is_scenario ? open_simulation(options) : open_recording(options);
  run::ManifestFacts& facts = input.scenario.facts;
  facts.command = "serve";
  run::ServePlan plan{.lock_step = options.lock_step, .rate = options.rate, .replace = options.force};
  if (!options.out.empty()) plan.folder = options.out;
  plan.manifest = run::make_manifest(facts);
  if (input.source->is_closed_loop())
    plan.manifest["robot"] = run::print_driven(input.scenario.simulator->scenario());
  plan.attachments = std::move(input.scenario.attachments);

  link::UdpWire socket(listen);
  link::LossyWire lossy(socket, options.loss, options.loss_seed);
  std::random_device random;
  link::RobotEnd robot(lossy, run::describe_robot(*input.source, plan, facts.name), random(),
                       std::chrono::milliseconds(static_cast<std::int64_t>(options.give_up_s * 1000)));
  const std::string address = link::print_address(socket.address());
  catch_interrupts();
  if (!options.quiet) fmt::print(stderr, "hallway: serving {} on {}\n", facts.name, address);
  run::ServeResult result;
  {
    Progress progress(facts.name, input.source->iterations(), options.quiet);
    result =
        run::serve(*input.source, robot, plan,
                   {.progress = [&](std::uint32_t done) { progress.update(done); }, .stop = interrupted});
  }
  if (options.json) {
    Json document{{"schema", "hallway.serve/1"},
                  {"status", status_of(result)},
                  {"name", facts.name},
                  {"address", address},
                  {"lock_step", options.lock_step}};
    document["folder"] = nullptr;
    if (!options.out.empty()) document["folder"] = path_text(options.out);
    document["warnings"] = facts.warnings;
    document["serving"] = run::print_serving(result);
    document["metrics"] = nullptr;
    if (result.metrics) document["metrics"] = eval::to_json(*result.metrics);
    if (result.drive) document["metrics"]["drive"] = run::to_json(*result.drive);
    print_json(document);
  } else if (!options.quiet) {
    print_result(table_of(facts.name, options, result));
  }
  return status_of(result);
}

}  // namespace

void add_serve_command(Command& app) {
  Command& command = app.command("serve", "Serve a simulated or recorded robot over UDP to a robot program");
  ServeOptions& options = command.runs(&serve);
  command
      .argument("input", &options.input,
                "Scenario file (.toml), a .map file, or a log as of `replay`: .mcap, .csv, a run folder")
      .required()
      .value("SCENARIO|MAP|LOG");
  command
      .option("--udp", &options.udp,
              "Address to listen to: 127.0.0.1:7000, [::1]:7000; port 0: any, which is printed")
      .required()
      .value("IP:PORT");
  const Option& lock_step =
      command.flag("--lockstep", &options.lock_step,
                   "Wait for the answer to each frame, and lose nothing; else in real time");
  add_shared(command, Shared::kRate, &options.rate).fallback("1").excludes(lock_step);
  command.option("--loss", &options.loss, "Share of datagrams to lose on purpose [0]")
      .value("P")
      .range(0.0, 1.0);
  command.option("--loss-seed", &options.loss_seed, "Seed of what is lost on purpose [1]").value("N");
  command
      .option(
          "--give-up", &options.give_up_s,
          "Seconds without a datagram, once the robot program has come, after which to stop; 0: never [10]")
      .value("S")
      .range(0.0, 1e6);
  add_shared(command, Shared::kSteps, &options.steps).fallback("the input's");
  add_shared(command, Shared::kSeed, &options.seed).fallback("the scenario's");
  add_shared(command, Shared::kSetScenario, &options.settings).repeatable();
  add_shared(command, Shared::kThreads, &options.threads).fallback("all processors");
  add_shared(command, Shared::kOutFolder, &options.out).fallback("none");
  add_shared(command, Shared::kStrict, &options.strict);
  add_output_options(command, options);
  command.footer("Example: hallway serve maps/office.toml --udp 127.0.0.1:7000 --lockstep --out out/served");
}

}  // namespace hallway::cli
