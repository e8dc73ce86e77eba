// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <optional>

#include "base/refuse.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "console.hpp"
#include "maps_folder.hpp"
#include "output_file.hpp"
#include "shared_options.hpp"
#include "study/first_robot/office_files.hpp"

namespace hallway::cli {
namespace {

struct FirstRobotOptions : OutputOptions {
  std::optional<std::uint64_t> office_seed;
  std::string out;
  std::string maps;
};

int make_office(const FirstRobotOptions& options) {
  const fs::path map = options.out.empty() ? fmt::format("office_{}.map", *options.office_seed) : options.out;
  if (map.extension() != ".map")
    refuse("--out takes a file that ends in .map, not \"{}\"", printable(map.string()));
  for (const fs::path& file : study::office_files(map)) check_new_file(file, options.force);
  const auto files =
      study::write_office(*options.office_seed, map, maps_folder(options.maps) / "robots/first.map");
  std::string text;
  for (const fs::path& file : files) text += "wrote " + path_text(file) + "\n";
  options.print({{"schema", "hallway.office/1"},
                 {"status", 0},
                 {"seed", *options.office_seed},
                 {"files", path_texts(files)}},
                text);
  return 0;
}

int run_first_robot(const FirstRobotOptions& options) {
  if (!options.office_seed) refuse("--make-office is missing");
  return make_office(options);
}

}  // namespace

void add_first_robot_command(Command& group) {
  Command& command = group.command("first-robot", "Make offices that the first robot of the thesis maps");
  FirstRobotOptions& options = command.runs(&run_first_robot);
  command
      .option("--make-office", &options.office_seed,
              "Write an office with this seed: a block of cubicles, a hallway round it, cubicles on its "
              "other side")
      .value("SEED");
  add_shared(command, Shared::kOutFile, &options.out).fallback("office_SEED.map");
  add_maps_option(command, options.maps);
  add_output_options(command, options);
  command.footer(
      "Writes NAME.map and, beside it, NAME.toml, NAME_faults.toml and NAME_robot.map.\n"
      "Example: hallway study first-robot --make-office 7 --out office.map");
}

}  // namespace hallway::cli
