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

/// Of a table as it is written.
struct PointColumns {
  bool identities = false;
  bool tracks = false;

  std::string header() const {
    return std::string("iteration") + (identities ? ",landmark_id" : "") + ",x,y,z" +
           (tracks ? ",track" : "");
  }
  void add_row(RowWriter& out, std::uint32_t iteration, const Observation& observation) const {
    out.whole(iteration);
    if (identities) add_id(out, observation.landmark);
    out.numbers(observation.point);
    if (tracks) add_id(out, observation.track);
    out.end_row();
  }
  /// Empty frames need no row but the last one, without which the log would seem to end earlier.
  void add_empty_row(RowWriter& out, std::uint32_t iteration) const {
    out.whole(iteration);
    if (identities) out.word("");
    out.word("").word("").word("");
    if (tracks) out.word("");
    out.end_row();
  }
};

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
  const PointColumns columns{log.has_identities(), log.has_tracks()};
  RowWriter out(',');
  out.word(columns.header()).end_row();
  for (const std::uint32_t iteration : log.filled_iterations()) {
    for (const Observation& observation : log.frame(iteration)) columns.add_row(out, iteration, observation);
  }
  if (log.iterations() > 0 && log.frame(log.iterations() - 1).empty())
    columns.add_empty_row(out, log.iterations() - 1);
  return out.take();
}

ObservationFile::ObservationFile(const std::filesystem::path& path, bool has_identities, bool has_tracks)
    : has_identities_(has_identities),
      has_tracks_(has_tracks),
      rows_(path, ',', PointColumns{has_identities, has_tracks}.header()) {}

void ObservationFile::add_frame(std::uint32_t iteration, std::span<const Observation> observations) {
  last_empty_.reset();
  if (observations.empty()) last_empty_ = iteration;
  const PointColumns columns{has_identities_, has_tracks_};
  for (const Observation& observation : observations)
    columns.add_row(rows_.next_row(), iteration, observation);
}

void ObservationFile::close() {
  if (last_empty_) PointColumns{has_identities_, has_tracks_}.add_empty_row(rows_.next_row(), *last_empty_);
  rows_.close();
}

void write_observations(const std::filesystem::path& path, const ObservationLog& log) {
  write_file_atomically(path, print_observations(log));
}

}  // namespace hallway::log
