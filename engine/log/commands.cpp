// SPDX-License-Identifier: MIT
#include "log/commands.hpp"

#include "base/file.hpp"
#include "log/csv_reader.hpp"

namespace hallway::log {
namespace {

enum Column : std::size_t { kIteration, kLinear, kAngular };

}  // namespace

std::vector<IterationCommand> parse_commands(std::string_view text, const std::string& file) {
  CsvReader row(text, file, {{"iteration"}, {"linear_m_s"}, {"angular_rad_s"}});
  std::vector<IterationCommand> commands;
  std::int64_t previous = -1;
  while (row.next()) {
    const std::uint32_t iteration = row.later_iteration(kIteration, previous);
    commands.push_back({iteration, row.number(kLinear), row.number(kAngular)});
    previous = iteration;
  }
  return commands;
}

std::vector<IterationCommand> read_commands(const std::filesystem::path& path) {
  return parse_commands(read_file(path), path.string());
}

void add_row(RowWriter& out, const IterationCommand& command) {
  out.whole(command.iteration).number(command.linear_m_s).number(command.angular_rad_s).end_row();
}

std::string print_commands(std::span<const IterationCommand> commands) {
  RowWriter out(',');
  out.word(kCommandColumns).end_row();
  for (const IterationCommand& command : commands) add_row(out, command);
  return out.take();
}

}  // namespace hallway::log
