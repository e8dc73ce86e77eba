// SPDX-License-Identifier: MIT
#include "log/observations.hpp"

#include <fmt/format.h>

#include <utility>

#include "base/error.hpp"
#include "base/file.hpp"
#include "log/csv_reader.hpp"
#include "log/row_writer.hpp"

namespace hallway::log {
namespace {

enum Column : std::size_t { kIteration, kLandmark, kX, kY, kZ, kTrack };

static_assert(kNoTrack == kNoLandmark);  // both are read and written as ids, -1 for none

void add_id(RowWriter& out, std::uint64_t id) {
  if (id == kNoLandmark) {
    out.word("-1");
  } else {
    out.whole(id);
  }
}

}  // namespace

ReadLog parse_observations(std::string_view text, const std::string& file) {
  CsvReader row(text, file, {{"iteration"}, {"landmark_id", false}, {"x"}, {"y"}, {"z"}, {"track", false}});
  FrameRows<ObservationLog, Observation> rows(ObservationLog(row.has(kLandmark), row.has(kTrack)), "a point");
  const auto is_empty = [&] {
    return row.text(kX).empty() && row.text(kY).empty() && row.text(kZ).empty() &&
           row.text(kLandmark).empty() && row.text(kTrack).empty();
  };
  auto damage = rows.read_all(row, kIteration, is_empty, [&] {
    return Observation{row.landmark_or_none(kLandmark), row.vector(kX), row.landmark_or_none(kTrack)};
  });
  return {rows.finish(), std::move(damage)};
}

ReadLog read_observations(const std::filesystem::path& path) {
  return parse_observations(read_file(path), path.string());
}

std::string describe(const Damage& damage, const ObservationLog& kept, const std::string& file) {
  return fmt::format("{}:{}: {}; kept what stands before: {} observations, iterations below {}", file,
                     damage.line, damage.cause, kept.observations().size(), kept.iterations());
}

std::string print_observations(const ObservationLog& log) {
  RowWriter out(',');
  out.word("iteration");
  if (log.has_identities()) out.word("landmark_id");
  out.word("x").word("y").word("z");
  if (log.has_tracks()) out.word("track");
  out.end_row();
  for (const std::uint32_t iteration : log.filled_iterations()) {
    for (const Observation& observation : log.frame(iteration)) {
      out.whole(iteration);
      if (log.has_identities()) add_id(out, observation.landmark);
      out.numbers(observation.point);
      if (log.has_tracks()) add_id(out, observation.track);
      out.end_row();
    }
  }
  // Empty frames need no row but the last one, without which the log would seem to end earlier.
  if (log.iterations() > 0 && log.frame(log.iterations() - 1).empty()) {
    out.whole(log.iterations() - 1);
    if (log.has_identities()) out.word("");
    out.word("").word("").word("");
    if (log.has_tracks()) out.word("");
    out.end_row();
  }
  return out.take();
}

void write_observations(const std::filesystem::path& path, const ObservationLog& log) {
  write_file_atomically(path, print_observations(log));
}

}  // namespace hallway::log
