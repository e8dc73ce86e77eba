// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/refuse.hpp"
#include "base/toml_reader.hpp"
#include "command.hpp"
#include "console.hpp"
#include "run/pictures/record.hpp"
#include "scenario_run.hpp"
#include "sim/scenario.hpp"
#include "watch/log_moments.hpp"
#include "watch/make_scene.hpp"
#include "watch_screen.hpp"
#include "watcher.hpp"

namespace hallway::cli {
namespace {

struct WatchOptions : RunOptions {
  std::optional<double> speed;
  std::optional<std::string> dots;
  bool lines = false;
};

WatchStyle style_of(const WatchOptions& options) {
  return {.speed = options.speed.value_or(0.0),
          .lines = options.lines,
          .dots = options.dots.value_or(""),
          .to_stderr = options.json,
          .quiet = options.quiet};
}

/// A run that is over takes none of the options of a run.
void refuse_run_options(const WatchOptions& options) {
  const bool any = !options.out.empty() || !options.settings.empty() || options.seed || options.steps ||
                   !options.plugin.empty() || !options.plugin_path.empty() || options.renderer ||
                   options.strict || options.foxglove || options.force || options.json;
  if (any)
    refuse("the folder of a run takes --speed, --dots, --lines and --quiet; other options are of a scenario");
}

int play(const WatchOptions& options) {
  refuse_run_options(options);
  const fs::path folder = options.scenario;
  if (!run::is_run_folder(folder))
    throw Error(ErrorCode::kBadInput,
                "is no folder of a run: it has no run.json; `hallway run` makes such a folder",
                {.file = path_text(folder)});
  const fs::path log = folder / run::files::kLog;
  if (!fs::exists(log))
    throw Error(ErrorCode::kBadInput, "has no log (run.mcap), from which a run is shown",
                {.file = path_text(folder)});
  const run::Record record = run::read_record(folder);
  watch::LogMoments moments(log);
  std::optional<watch::Moment> first = moments.next();
  if (!first) throw Error(ErrorCode::kBadInput, "has no frames", {.file = path_text(log)});
  catch_interrupts();
  {
    Screen screen(watch::scene_of(record), style_of(options), true);
    screen.add(*first);
    for (Screen::Next next = screen.next(); next != Screen::Next::kLeave; next = screen.next()) {
      if (next == Screen::Next::kOlder) {
        moments.restart();
        screen.restart();
      }
      if (const std::optional<watch::Moment> moment = moments.next()) {
        screen.add(*moment);
      } else {
        screen.end();
      }
    }
  }
  if (const auto damage = moments.damage())
    print_warning("{}: damaged at byte {}: {}", path_text(log), damage->offset, damage->cause);
  return interrupted() ? interrupt_status() : 0;
}

/// Whether its reader says best what is wrong: a file that is called a scenario and is no TOML, or TOML that names a map.
bool is_like_scenario(const fs::path& file, const WatchOptions& options) {
  if (fs::file_size(file) > sim::kMaxScenarioBytes) return false;
  const std::string text = read_file(file);
  try {
    const TomlTable top = parse_toml(text, path_text(file));
    return find(top, "map") != nullptr || find(top, "schema") != nullptr ||
           std::ranges::any_of(options.settings,
                               [](const std::string& setting) { return setting.starts_with("map="); });
  } catch (const Error&) {
    return file.extension() == ".toml";
  }
}

/// Throws Error{kBadInput} for what can be neither played nor run.
void require_watchable(const fs::path& input, const WatchOptions& options) {
  std::error_code code;
  const fs::file_status status = fs::status(input, code);
  if (status.type() == fs::file_type::not_found)
    throw Error(ErrorCode::kBadInput,
                "does not exist; the folder of a run, a scenario (.toml) or a map (.map) is wanted",
                {.file = path_text(input)});
  if (code || input.extension() == ".map") return;
  if (!fs::is_regular_file(status) || !is_like_scenario(input, options))
    throw Error(ErrorCode::kBadInput, "is neither the folder of a run nor a scenario (.toml) or a map (.map)",
                {.file = path_text(input)});
}

int watch_run(const WatchOptions& options) {
  std::error_code code;
  const fs::path input = options.scenario;
  if (fs::is_directory(input, code)) return play(options);
  if (input.extension() == ".mcap")
    throw Error(ErrorCode::kBadInput, "is a log; the folder of its run is what can be watched",
                {.file = path_text(input)});
  require_watchable(input, options);
  Watcher watcher(style_of(options));
  return run_scenario(options, &watcher);
}

}  // namespace

void add_watch_command(Command& app) {
  Command& command = app.command("watch", "Show a run in the terminal, while it goes on or from its folder");
  WatchOptions& options = command.runs(&watch_run);
  command
      .argument("input", &options.scenario,
                "The folder of a run; or a scenario or a .map file, which is run as `hallway run` does")
      .required()
      .value("RUN|SCENARIO|MAP");
  command
      .option("--speed", &options.speed,
              "Seconds of the robot's time in a second [1 in a terminal, as fast as possible in lines]")
      .value("X")
      .range(1.0 / 16.0, 4096.0);
  command
      .option("--dots", &options.dots,
              "What the plan is drawn with [braille, or ascii where the locale has no UTF-8]")
      .value("KIND")
      .choices({"braille", "blocks", "ascii"});
  command.flag("--lines", &options.lines, "Print lines, as without a terminal, and draw nothing");
  add_run_options(command, options);
  command.footer(
      "Keys: SPACE pauses, . and , step, + and - change the speed, f follows the robot, z and Z zoom, arrows "
      "move, 0 to 9, t and w show and "
      "hide layers, ? lists all, q closes the view; a run then goes on without it. Ctrl-C ends the run.\n"
      "A run that is watched writes the same folder as one that is not. Without a terminal, or with "
      "TERM=dumb, lines are printed.\n"
      "Examples: hallway watch maps/office_drive.toml --out out/office_drive\n"
      "          hallway watch out/office_drive --speed 4\n"
      "          ssh robot hallway watch out/office_drive --lines");
}

}  // namespace hallway::cli
