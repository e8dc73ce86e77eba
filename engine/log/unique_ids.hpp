// SPDX-License-Identifier: MIT
#pragma once

#include <unordered_set>

#include <fmt/format.h>

#include "log/csv_reader.hpp"
#include "log/landmark_id.hpp"

namespace hallway::log {

/// Reads the ids of a table in which each stands once.
class UniqueIds {
 public:
  /// The id in a column of the current row. Throws Error{kBadInput} if it is none or stood in an earlier row.
  LandmarkId read(const CsvReader& row, std::size_t column) {
    const LandmarkId id = row.whole(column, kNoLandmark - 1);
    if (!seen_.insert(id).second)
      throw row.error(fmt::format("landmark {} stands here for the second time", id));
    return id;
  }

 private:
  std::unordered_set<LandmarkId> seen_;
};

}  // namespace hallway::log
