// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "log/commands.hpp"
#include "log/csv_reader.hpp"
#include "log/pose_covariances.hpp"
#include "log/timing.hpp"

namespace hallway::test {

// Tables that the program writes and does not read, for tests that look at them. Columns may stand in any order; iterations increase.

/// The rows that `read` makes of the fields behind the iteration. Throws Error{kBadInput} with the line of the first thing that is wrong.
template <typename Row, typename Read>
std::vector<Row> parse_rows(std::string_view text, const std::string& file,
                            std::vector<log::CsvColumn> columns, Read&& read) {
  log::CsvReader row(text, file, std::move(columns));
  std::vector<Row> rows;
  while (row.next()) {
    const std::int64_t previous = rows.empty() ? -1 : std::int64_t{rows.back().iteration};
    rows.push_back({row.later_iteration(0, previous)});
    read(row, rows.back());
  }
  return rows;
}

inline std::vector<log::IterationTime> parse_timing(std::string_view text, const std::string& file) {
  return parse_rows<log::IterationTime>(text, file, {{"iteration"}, {"wall_ms"}, {"cpu_ms"}},
                                        [](const auto& row, auto& time) {
                                          for (double* milliseconds : {&time.wall_ms, &time.cpu_ms}) {
                                            const std::size_t column = milliseconds == &time.wall_ms ? 1 : 2;
                                            *milliseconds = row.number(column);
                                            if (*milliseconds < 0.0)
                                              throw row.bad_field(column, "a time from 0 on");
                                          }
                                        });
}

inline std::vector<log::IterationCommand> parse_commands(std::string_view text, const std::string& file) {
  std::vector<log::CsvColumn> columns{{"iteration"}, {"linear_m_s"}, {"angular_rad_s"}};
  const bool is_wide = text.starts_with(log::kLateralCommandColumns);
  if (is_wide) columns.push_back({"lateral_m_s"});
  return parse_rows<log::IterationCommand>(text, file, columns, [&](const auto& row, auto& command) {
    command.linear_m_s = row.number(1);
    command.angular_rad_s = row.number(2);
    if (is_wide) command.lateral_m_s = row.number(3);
  });
}

inline std::vector<log::IterationCovariance> parse_pose_covariances(std::string_view text,
                                                                    const std::string& file) {
  return parse_rows<log::IterationCovariance>(
      text, file,
      {{"iteration"}, {"xx"}, {"xy"}, {"xz"}, {"xa"}, {"xb"}, {"xc"}, {"yy"}, {"yz"}, {"ya"}, {"yb"},
       {"yc"},        {"zz"}, {"za"}, {"zb"}, {"zc"}, {"aa"}, {"ab"}, {"ac"}, {"bb"}, {"bc"}, {"cc"}},
      [](const auto& row, auto& covariance) {
        for (std::size_t i = 0; i < covariance.covariance.size(); ++i)
          covariance.covariance[i] = row.number(1 + i);
      });
}

}  // namespace hallway::test
