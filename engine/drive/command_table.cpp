// SPDX-License-Identifier: MIT
#include "drive/command_table.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"

namespace hallway::drive {
namespace {

constexpr std::array<std::string_view, 4> kColumns{"t_ns", "forward_m_s", "angular_rad_s", "lateral_m_s"};

/// The lines of a table, with the place in the file for messages.
class RowReader {
 public:
  RowReader(std::string_view text, const std::string& name) : rest_(text), name_(name) {}

  bool at_end() const { return rest_.empty(); }

  std::vector<std::string_view> next() {
    ++line_;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    std::string_view row = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    if (row.ends_with('\r')) row.remove_suffix(1);
    return split(row, ',');
  }

  [[noreturn]] void refuse_row(const std::string& cause) const {
    throw Error(ErrorCode::kBadInput, cause, {.file = printable(name_), .line = line_});
  }

 private:
  std::string_view rest_;
  const std::string& name_;
  int line_ = 0;
};

std::size_t read_header(RowReader& rows) {
  const std::vector<std::string_view> names = rows.next();
  const bool known =
      (names.size() == 3 || names.size() == 4) && std::equal(names.begin(), names.end(), kColumns.begin());
  if (!known)
    rows.refuse_row("the header must be `t_ns,forward_m_s,angular_rad_s`, with or without `,lateral_m_s`");
  return names.size();
}

double number_in(const RowReader& rows, std::string_view field, std::size_t column) {
  const std::optional<double> number = parse_double(field);
  if (!number) {
    rows.refuse_row(std::string(kColumns.at(column)) + " must be a finite number, not \"" + printable(field) +
                    "\"");
  }
  return *number;
}

TimedCommand read_row(RowReader& rows, std::size_t columns) {
  const std::vector<std::string_view> fields = rows.next();
  if (fields.size() != columns) {
    rows.refuse_row("a row must have " + std::to_string(columns) + " fields, not " +
                    std::to_string(fields.size()));
  }
  const std::optional<std::int64_t> t = parse_int(fields[0]);
  if (!t || *t < 0)
    rows.refuse_row("t_ns must be a whole number from 0 on, not \"" + printable(fields[0]) + "\"");
  TimedCommand row{.t_ns = *t};
  row.command.forward_m_s = number_in(rows, fields[1], 1);
  row.command.angular_rad_s = number_in(rows, fields[2], 2);
  if (columns == 4) row.command.lateral_m_s = number_in(rows, fields[3], 3);
  return row;
}

}  // namespace

CommandTable::CommandTable(std::vector<TimedCommand> commands) : commands_(std::move(commands)) {
  if (commands_.empty()) throw Error(ErrorCode::kBadInput, "there are no commands");
  std::int64_t last_ns = -1;
  for (const TimedCommand& command : commands_) {
    if (command.t_ns <= last_ns)
      throw Error(ErrorCode::kBadInput,
                  "a command at " + std::to_string(command.t_ns) + " ns comes after one that is not earlier");
    last_ns = command.t_ns;
  }
}

CommandTable CommandTable::read(const std::filesystem::path& file) {
  return parse(read_file(file), file.string());
}

CommandTable CommandTable::parse(std::string_view text, const std::string& name) {
  RowReader rows(text, name);
  const std::size_t columns = read_header(rows);
  CommandTable table;
  while (!rows.at_end()) {
    const TimedCommand row = read_row(rows, columns);
    if (!table.commands_.empty() && row.t_ns <= table.commands_.back().t_ns) {
      rows.refuse_row("t_ns must be greater than in the row before, not " + std::to_string(row.t_ns));
    }
    table.commands_.push_back(row);
  }
  if (table.commands_.empty()) rows.refuse_row("the table has no commands");
  return table;
}

Command CommandTable::at(std::int64_t t_ns) const {
  const auto later = std::ranges::upper_bound(commands_, t_ns, {}, &TimedCommand::t_ns);
  return later == commands_.begin() ? Command{} : std::prev(later)->command;
}

}  // namespace hallway::drive
