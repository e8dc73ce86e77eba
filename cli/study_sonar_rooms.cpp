// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "base/parallel.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "console.hpp"
#include "maps_folder.hpp"
#include "output_file.hpp"
#include "shared_options.hpp"
#include "study/first_robot/sonar_rooms.hpp"
#include "sweep_rule.hpp"

namespace hallway::cli {
namespace {

struct SonarRoomsOptions : OutputOptions {
  std::uint32_t openings = 400;
  std::uint64_t first_seed = 1;
  bool quick = false;
  std::string out;
  std::string maps;
  unsigned threads = hardware_threads();
};

constexpr std::uint32_t kQuickOpenings = 40;

std::string confusion_text(const std::string& title, const study::Confusion& confusion) {
  std::string text = fmt::format("{}: {} of {} wrong\n  {:<10}{:>10}{:>10}{:>10}\n", title,
                                 confusion.errors(), confusion.total(), "", "covered", "room", "hallway");
  for (const study::OpeningKind truth : study::kOpeningKinds) {
    text += fmt::format("  {:<10}", study::name_of(truth));
    for (const study::OpeningKind said : study::kOpeningKinds)
      text += fmt::format("{:>10}", confusion.of(truth, said));
    text += "\n";
  }
  return text;
}

int run_sonar_rooms(const SonarRoomsOptions& options) {
  const study::Study described = study::sonar_rooms_study();
  const fs::path folder = output_folder(options.out, "study-sonar-rooms");
  check_output_folder(folder, "study.json", options.force);
  study::SonarRoomsRequest request{
      .each = options.quick ? std::min(options.openings, kQuickOpenings) : options.openings,
      .first_seed = options.first_seed,
      .quick = options.quick,
      .maps = maps_folder(options.maps),
      .rule = wall_follower_rule(),
      .present = wall_follower_parameters(),
      .longest_doorway_m = wall_follower_longest_pass_m(),
      .threads = options.threads};
  const study::SonarRoomsResult result = study::study_sonar_rooms(request);
  Json document = study::write_outcome(
      described, {.plugins = {{.plugin = "wall_follower"}}, .seeds = request.each, .quick = options.quick},
      result.outcome, folder);
  document["folder"] = path_text(folder);
  const study::SweepRuleParameters& best = result.calibration.best;
  options.print(document,
                confusion_text("calibrated, on openings that were not fitted on", result.checked) +
                    confusion_text("present parameters, on the same openings", result.present) +
                    fmt::format("--set wall_follower.cover_m={} --set wall_follower.room_depth_m={} --set "
                                "wall_follower.sweep_window_deg={}\nwritten to {}\n",
                                format_double(best.cover_m), format_double(best.room_depth_m),
                                format_double(best.window_deg), path_text(folder)));
  return 0;
}

}  // namespace

void add_sonar_rooms_command(Command& group) {
  Command& command = group.command("sonar-rooms", std::string(study::sonar_rooms_study().about));
  SonarRoomsOptions& options = command.runs(&run_sonar_rooms);
  command
      .option("--openings", &options.openings,
              "How many openings of each kind to fit on, with faults and without; as many more to check")
      .value("N")
      .range(5u, 100'000u)
      .show_default();
  add_shared(command, Shared::kFirstSeed, &options.first_seed).show_default();
  command.flag("--quick", &options.quick, "A small size for trying out");
  add_shared(command, Shared::kOutFolder, &options.out).fallback("out/study-sonar-rooms");
  add_maps_option(command, options.maps);
  add_shared(command, Shared::kThreads, &options.threads).fallback("all processors");
  add_output_options(command, options);
  command.footer(
      "Prints the parameters to set. Writes findings.csv, parameters.csv, confusion.csv, sweeps.csv, charts "
      "as "
      "SVG and PNG, and all of it as study.json.\n"
      "Example: hallway study sonar-rooms --out out/sonar-rooms");
}

}  // namespace hallway::cli
