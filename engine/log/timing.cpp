// SPDX-License-Identifier: MIT
#include "log/timing.hpp"

#include "base/file.hpp"
#include "log/csv_reader.hpp"

namespace hallway::log {
namespace {

enum Column : std::size_t { kIteration, kWall, kCpu };

double read_time(const CsvReader& row, Column column) {
  const double time_ms = row.number(column);
  if (time_ms < 0.0) throw row.bad_field(column, "a time from 0 on");
  return time_ms;
}

}  // namespace

std::vector<IterationTime> parse_timing(std::string_view text, const std::string& file) {
  CsvReader row(text, file, {{"iteration"}, {"wall_ms"}, {"cpu_ms"}});
  std::vector<IterationTime> times;
  std::int64_t previous = -1;
  while (row.next()) {
    const std::uint32_t iteration = row.later_iteration(kIteration, previous);
    times.push_back({iteration, read_time(row, kWall), read_time(row, kCpu)});
    previous = iteration;
  }
  return times;
}

std::vector<IterationTime> read_timing(const std::filesystem::path& path) {
  return parse_timing(read_file(path), path.string());
}

void add_row(RowWriter& out, const IterationTime& time) {
  out.whole(time.iteration).number(time.wall_ms).number(time.cpu_ms).end_row();
}

std::string print_timing(std::span<const IterationTime> times) {
  RowWriter out(',');
  out.word(kTimingColumns).end_row();
  for (const IterationTime& time : times) add_row(out, time);
  return out.take();
}

}  // namespace hallway::log
