// SPDX-License-Identifier: MIT
#include "import/imu_table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "base/error.hpp"
#include "log/csv_reader.hpp"

namespace hallway::import {
namespace {

double imu_number(const log::CsvReader& rows, std::size_t column) {
  const double value = rows.number(column);
  if (std::abs(value) > kMaxImuNumber)
    throw rows.bad_field(column, fmt::format("a number within {:g}", kMaxImuNumber));
  return value;
}

}  // namespace

std::vector<ImuSample> parse_imu_table(std::string_view text, const std::string& file,
                                       const ImuColumns& columns) {
  std::vector<log::CsvColumn> needed;
  for (const std::string_view column : columns) needed.push_back({column});
  log::CsvReader rows(text, file, std::move(needed));
  std::vector<ImuSample> samples;
  while (rows.next()) {
    ImuSample sample;
    sample.t_ns = static_cast<std::int64_t>(rows.whole(0, std::numeric_limits<std::int64_t>::max()));
    if (!samples.empty() && sample.t_ns <= samples.back().t_ns) {
      throw rows.bad_field(0, fmt::format("a time after {}", samples.back().t_ns));
    }
    for (std::size_t i = 0; i < 3; ++i) {
      sample.angular_rad_s[i] = imu_number(rows, 1 + i);
      sample.force_m_s2[i] = imu_number(rows, 4 + i);
    }
    samples.push_back(sample);
  }
  if (samples.empty()) throw Error(ErrorCode::kBadInput, "has no samples", {.file = file});
  return samples;
}

void add_row(log::RowWriter& out, const ImuSample& sample) {
  out.whole(static_cast<std::uint64_t>(sample.t_ns));
  out.numbers(sample.angular_rad_s).numbers(sample.force_m_s2).end_row();
}

void check_sample(const ImuSample& sample, std::int64_t before_ns, const std::string& file) {
  if (sample.t_ns < 0 || sample.t_ns <= before_ns) {
    throw Error(ErrorCode::kBadInput,
                fmt::format("the time {} ns is not after {} ns", sample.t_ns, before_ns), {.file = file});
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::abs(sample.angular_rad_s[i]) <= kMaxImuNumber && std::abs(sample.force_m_s2[i]) <= kMaxImuNumber)
      continue;
    throw Error(ErrorCode::kBadInput,
                fmt::format("the sample at {} ns has a number that is not finite, or beyond {:g}",
                            sample.t_ns, kMaxImuNumber),
                {.file = file});
  }
}

}  // namespace hallway::import
