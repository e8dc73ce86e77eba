// SPDX-License-Identifier: MIT
#include "shared_options.hpp"

#include <algorithm>
#include <iterator>

#include "base/error.hpp"
#include "host/plugin_limits.hpp"

namespace hallway::cli {
namespace {

struct Row {
  Shared which;
  const char* names;
  const char* value;  ///< empty: a flag
  const char* help;
  double least = 0.0;  ///< with `most`: the numbers allowed, where there are limits
  double most = 0.0;
};

/// The largest double below 2^63: seeds of files are TOML's integers, which end there.
constexpr double kMostSeed = 9223372036854774784.0;
/// Seeds that follow the first are allowed, too.
constexpr double kMostFirstSeed = 9e18;

constexpr Row kRows[] = {
    {Shared::kPlugin, "--plugin", "NAME|FILE[:KEY=VALUE,...]",
     "Plugin to run, an id or a .so file, and values of its parameters"},
    {Shared::kSet, "--set", "KEY=VALUE",
     "Set a plugin's parameter (slam_point.noise_m=0.1, or noise_m=0.1 where one plugin runs) or another "
     "value of the input file (TABLE.KEY=VALUE)"},
    {Shared::kSetPlugin, "--set", "KEY=VALUE",
     "Set a plugin's parameter (slam_point.noise_m=0.1, or noise_m=0.1 where one plugin runs)"},
    {Shared::kSetScenario, "--set", "KEY=VALUE", "Set a value of the input file (sensor.eyes.noise_m=0.1)"},
    {Shared::kPluginPath, "--plugin-path", "DIR",
     "Folder to look for plugins in, before those of HALLWAY_PLUGIN_PATH and Hallway's own"},
    {Shared::kInProcess, "--in-process", "",
     "Run plugins in this process, for debuggers and benchmarks: there are no limits, and a plugin crash "
     "ends the "
     "program"},
    {Shared::kCallTimeout, "--call-timeout", "S", "Seconds that one call of a plugin may take", 0.01, 1e6},
    {Shared::kMemoryLimit, "--memory-limit", "MIB", "MiB of memory that a plugin's process may hold", 16,
     1u << 24},
    {Shared::kOnFailure, "--on-failure", "WHAT",
     "When a plugin fails: stop (write what there is), continue (without answers) or restart (a new instance "
     "with an "
     "empty map); the exit status is 5 in any case"},
    {Shared::kOutFolder, "--out", "DIR", "Folder to write"},
    {Shared::kOutFile, "--out", "FILE", "File to write"},
    {Shared::kOutLog, "--out", "FILE|DIR", "File to write if it ends in .mcap or --to is tum, else a folder"},
    {Shared::kForce, "--force", "", "Replace earlier output"},
    {Shared::kSeed, "--seed", "N", "Seed of all random numbers", 0, kMostSeed},
    {Shared::kFirstSeed, "--first-seed", "S", "The first seed", 0, kMostFirstSeed},
    {Shared::kSteps, "--steps", "N", "Number of frames", 1, 99'999'999},
    {Shared::kThreads, "--threads", "N", "Number of threads; results do not depend on it", 1, 1024},
    {Shared::kJobs, "--jobs", "N", "Number of parallel runs; times are comparable with 1", 1, 1024},
    {Shared::kRepeat, "--repeat", "N", "Runs of the plugin; the time reported is the median", 1, 10'000},
    {Shared::kStrict, "--strict", "", "Refuse a map that has warnings"},
    {Shared::kRenderer, "--renderer", "NAME",
     "Software renderer that draws faces; auto is osmesa, or egl where that is not installed"},
    {Shared::kFoxglove, "--foxglove", "", "Add channels to the .mcap log that show it in Foxglove"},
    {Shared::kView, "--view", "VIEW", "View of the picture"},
    {Shared::kPicture, "--picture", "FILE", "PNG picture to write"},
    {Shared::kLevel, "--level", "LEVEL", "Effort for the potentially visible sets"},
    {Shared::kRate, "--rate", "X", "Speed of time: 1 as recorded, 2 twice as fast", 1e-3, 1e3},
    {Shared::kPeriod, "--period", "S", "Seconds from frame to frame, where the input has no times", 1e-6,
     1e6},
    {Shared::kTruePoses, "--truth-poses", "FILE",
     "True poses: a CSV file with the columns iteration,x,y,z and perhaps qw,qx,qy,qz"},
    {Shared::kTrueLandmarks, "--truth-landmarks", "FILE",
     "True landmarks: a CSV file with the columns landmark_id,x,y,z"},
    {Shared::kJson, "--json", "", "Print one JSON document"},
    {Shared::kQuiet, "--quiet", "", "Print no progress and no result"},
};

const Row& row_of(Shared which) {
  const auto* row =
      std::find_if(std::begin(kRows), std::end(kRows), [&](const Row& each) { return each.which == which; });
  if (row == std::end(kRows)) throw Error(ErrorCode::kInternal, "an option without a row in the table");
  return *row;
}

}  // namespace

Option& add_shared(Command& command, Shared which, Target target) {
  const Row& row = row_of(which);
  Option& option = command.option(row.names, target, row.help).shared();
  if (*row.value != '\0') option.value(row.value);
  if (row.least < row.most) option.range(row.least, row.most);
  if (which == Shared::kOnFailure) option.choices(host::kOnFailure);
  if (which == Shared::kLevel) option.choices({"fast", "full"}).show_default();
  return option;
}

void add_output_options(Command& command, OutputOptions& options) {
  add_shared(command, Shared::kForce, &options.force);
  add_shared(command, Shared::kJson, &options.json);
  add_shared(command, Shared::kQuiet, &options.quiet);
}

}  // namespace hallway::cli
