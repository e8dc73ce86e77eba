// SPDX-License-Identifier: MIT
#include "import/point_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "import/words.hpp"
#include "log/csv_reader.hpp"
#include "log/observations.hpp"

namespace hallway::import {
namespace {

enum Column : std::size_t { kFrame, kId, kFirst, kSecond, kThird, kTime };

std::vector<log::CsvColumn> names_of(PointColumns columns) {
  if (columns == PointColumns::kCamera) {
    return {{"frame"}, {"id"}, {"x_right_m"}, {"y_down_m"}, {"z_fwd_m"}, {"t_s", false}};
  }
  return {{"frame"}, {"id"}, {"range_m"}, {"yaw_rad"}, {"pitch_rad"}, {"t_s", false}};
}

std::array<double, 3> point_of(const log::CsvReader& rows, PointColumns columns) {
  const auto [a, b, c] = rows.vector(kFirst);
  if (columns == PointColumns::kCamera) return {c, -a, -b};
  if (a < 0.0) throw rows.bad_field(kFirst, "a range of 0 or more");
  return {a * std::cos(b) * std::cos(c), a * std::sin(b) * std::cos(c), -a * std::sin(c)};
}

/// Collects lines into frames.
class Collector {
 public:
  Collector(const log::CsvReader& rows, PointColumns columns, std::int64_t period_ns)
      : rows_(rows), columns_(columns), period_ns_(period_ns) {}

  void add_row() {
    const auto frame = static_cast<std::size_t>(rows_.whole(kFrame, log::kMaxIteration));
    if (frame + 1 < table_.t_ns.size()) {
      throw rows_.bad_field(kFrame, fmt::format("a frame not below {}", table_.t_ns.size() - 1));
    }
    const bool begins = frame >= table_.t_ns.size();
    const std::int64_t t_ns = time_of(frame);
    if (begins) begin(frame, t_ns);
    if (t_ns != table_.t_ns.back()) throw rows_.bad_field(kTime, "the time of the frame's other lines");
    const std::uint64_t id = rows_.whole(kId, kMaxId);
    if (!ids_.insert(id).second) throw rows_.bad_field(kId, "an id that the frame does not have yet");
    table_.ids.push_back(id);
    table_.points.push_back(point_of(rows_, columns_));
  }

  PointTable finish() {
    if (table_.points.empty()) throw rows_.error("has no points");
    table_.begin.push_back(table_.points.size());
    return std::move(table_);
  }

 private:
  static constexpr std::uint64_t kMaxId = ~std::uint64_t{0} - 1;
  static constexpr std::int64_t kMaxGap =
      1000;  ///< frames; more is damage, such as a time in the wrong column

  std::int64_t time_of(std::size_t frame) const {
    if (!rows_.has(kTime)) return period_ns_ * static_cast<std::int64_t>(frame);
    const auto t_ns = parse_seconds(rows_.text(kTime));
    if (!t_ns) throw rows_.bad_field(kTime, "a time in seconds below 9e9");
    return *t_ns;
  }

  void begin(std::size_t frame, std::int64_t t_ns) {
    const std::size_t known = table_.t_ns.size();
    const std::int64_t last_ns = known == 0 ? t_ns : table_.t_ns.back();
    if (t_ns < last_ns) throw rows_.bad_field(kTime, "a time not before the last");
    const auto gap = static_cast<std::int64_t>(frame + 1 - known);
    if (gap > kMaxGap)
      throw rows_.bad_field(kFrame, fmt::format("a frame at most {} above the last", kMaxGap));
    for (std::int64_t i = 1; i <= gap; ++i) {
      table_.t_ns.push_back(last_ns + (t_ns - last_ns) / gap * i + (t_ns - last_ns) % gap * i / gap);
      table_.begin.push_back(table_.points.size());
    }
    ids_.clear();
  }

  const log::CsvReader& rows_;
  PointColumns columns_;
  std::int64_t period_ns_;
  PointTable table_;
  std::unordered_set<std::uint64_t> ids_;  ///< of the frame under way
};

/// Whether a line of names has this one.
bool has_name(std::string_view line, std::string_view name) {
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find_first_of(",\r\n", begin), line.size());
    if (line.substr(begin, end - begin) == name) return true;
    begin = end + 1;
  }
  return false;
}

}  // namespace

PointTable parse_point_table(std::string_view text, const std::string& file, PointColumns columns,
                             std::int64_t period_ns) {
  log::CsvReader rows(text, file, names_of(columns));
  Collector collector(rows, columns, period_ns);
  while (rows.next()) collector.add_row();
  return collector.finish();
}

std::optional<PointColumns> point_columns_of(std::string_view first_line) {
  for (const PointColumns columns : {PointColumns::kCamera, PointColumns::kSpherical}) {
    bool all = true;
    for (const log::CsvColumn& column : names_of(columns)) {
      all = all && (!column.required || has_name(first_line, column.name));
    }
    if (all) return columns;
  }
  return std::nullopt;
}

}  // namespace hallway::import
