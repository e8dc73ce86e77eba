// SPDX-License-Identifier: MIT
#include "log/observations.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/file.hpp"
#include "log/csv_reader.hpp"
#include "log/row_writer.hpp"

namespace hallway::log {
namespace {

enum Column : std::size_t { kIteration, kLandmark, kX, kY, kZ, kTrack };

/// Collects rows into frames.
class FrameBuilder {
 public:
  FrameBuilder(bool has_identities, bool has_tracks) : log_(has_identities, has_tracks) {}

  void add_row(const CsvReader& row) {
    const auto iteration = static_cast<std::uint32_t>(row.whole(kIteration, kMaxIteration));
    if (begun_ && iteration < iteration_) {
      throw row.bad_field(kIteration, fmt::format("an iteration not below {}", iteration_));
    }
    const bool begins = !begun_ || iteration != iteration_;
    if (is_empty_frame(row)) {
      if (!begins) throw row.error("a row without a point stands beside others of the same iteration");
      begin(iteration);
      empty_ = true;
      return;
    }
    if (!begins && empty_) throw row.error("a point stands in an iteration that was said to have none");
    const Observation observation{row.landmark_or_none(kLandmark), row.vector(kX),
                                  row.landmark_or_none(kTrack)};
    if (begins) begin(iteration);
    frame_.push_back(observation);
  }

  bool nothing_read() const { return !begun_; }

  ObservationLog finish() {
    flush();
    return std::move(log_);
  }

 private:
  /// A row that names its iteration alone says that nothing was seen in it.
  static bool is_empty_frame(const CsvReader& row) {
    return row.text(kX).empty() && row.text(kY).empty() && row.text(kZ).empty() &&
           row.text(kLandmark).empty() && row.text(kTrack).empty();
  }

  void begin(std::uint32_t iteration) {
    flush();
    begun_ = true;
    empty_ = false;
    iteration_ = iteration;
  }

  void flush() {
    if (begun_) log_.add_frame(iteration_, frame_);
    frame_.clear();
  }

  ObservationLog log_;
  std::vector<Observation> frame_;
  std::uint32_t iteration_ = 0;
  bool begun_ = false;
  bool empty_ = false;
};

static_assert(kNoTrack == kNoLandmark);  // both are read and written as ids, -1 for none

void add_id(RowWriter& out, std::uint64_t id) {
  if (id == kNoLandmark) {
    out.word("-1");
  } else {
    out.whole(id);
  }
}

}  // namespace

std::span<const Observation> ObservationLog::frame(std::uint32_t iteration) const {
  const auto found = std::lower_bound(filled_.begin(), filled_.end(), iteration);
  if (found == filled_.end() || *found != iteration) return {};
  const auto place = static_cast<std::size_t>(found - filled_.begin());
  const std::size_t end = place + 1 < begin_.size() ? begin_[place + 1] : observations_.size();
  return std::span(observations_).subspan(begin_[place], end - begin_[place]);
}

void ObservationLog::add_frame(std::uint32_t iteration, std::span<const Observation> observations) {
  if (iteration > kMaxIteration || iteration < iterations_) {
    throw Error(ErrorCode::kInternal,
                fmt::format("an observation log cannot take iteration {} now", iteration));
  }
  iterations_ = iteration + 1;
  if (observations.empty()) return;
  filled_.push_back(iteration);
  begin_.push_back(observations_.size());
  observations_.insert(observations_.end(), observations.begin(), observations.end());
}

ReadLog parse_observations(std::string_view text, const std::string& file) {
  CsvReader row(text, file, {{"iteration"}, {"landmark_id", false}, {"x"}, {"y"}, {"z"}, {"track", false}});
  FrameBuilder frames(row.has(kLandmark), row.has(kTrack));
  std::optional<Damage> damage;
  try {
    while (row.next()) frames.add_row(row);
  } catch (const Error& error) {
    if (frames.nothing_read()) throw;
    const std::string& element = error.where().element;
    damage = Damage{error.where().line, element.empty() ? error.message() : element + ": " + error.message()};
  }
  return {frames.finish(), std::move(damage)};
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
