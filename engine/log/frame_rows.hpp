// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "log/csv_reader.hpp"
#include "log/frame_list.hpp"

namespace hallway::log {

/// Where reading stopped before the end of a file.
struct Damage {
  int line = 0;       ///< 1-based line of the first thing that was not read
  std::string cause;  ///< what is wrong there
};

/// Collects the rows of a table of observations into the frames of a log (a FrameList). A row that names its iteration alone says
/// that nothing was seen in it.
template <typename Log, typename Element>
class FrameRows {
 public:
  /// @param what  is in a row, for messages: "a point"
  FrameRows(Log log, std::string what) : log_(std::move(log)), what_(std::move(what)) {}

  /// Reads rows up to the end or the first bad one, which is told. Throws Error{kBadInput} if already the first row is bad.
  /// @param is_empty  of the present row: it names its iteration alone
  /// @param read      the present row's element
  template <typename IsEmpty, typename Read>
  std::optional<Damage> read_all(CsvReader& row, std::size_t iteration_column, IsEmpty is_empty, Read read) {
    try {
      while (row.next()) add_row(row, iteration_column, is_empty, read);
    } catch (const Error& error) {
      if (!begun_) throw;
      const std::string& element = error.where().element;
      return Damage{error.where().line, element.empty() ? error.message() : element + ": " + error.message()};
    }
    return std::nullopt;
  }

  Log finish() {
    flush();
    return std::move(log_);
  }

 private:
  template <typename IsEmpty, typename Read>
  void add_row(const CsvReader& row, std::size_t iteration_column, IsEmpty is_empty, Read read) {
    const auto iteration = static_cast<std::uint32_t>(row.whole(iteration_column, kMaxIteration));
    if (begun_ && iteration < iteration_)
      throw row.bad_field(iteration_column, fmt::format("an iteration not below {}", iteration_));
    const bool begins = !begun_ || iteration != iteration_;
    if (is_empty()) {
      if (!begins)
        throw row.error("a row without " + what_ + " has other rows of the same iteration beside it");
      begin(iteration);
      empty_ = true;
      return;
    }
    if (!begins && empty_) throw row.error(what_ + " follows in an iteration that was declared empty");
    const Element element = read();
    if (begins) begin(iteration);
    frame_.push_back(element);
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

  Log log_;
  std::string what_;
  std::vector<Element> frame_;
  std::uint32_t iteration_ = 0;
  bool begun_ = false;
  bool empty_ = false;
};

}  // namespace hallway::log
