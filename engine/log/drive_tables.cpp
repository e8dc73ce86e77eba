// SPDX-License-Identifier: MIT
#include "log/drive_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "log/csv_reader.hpp"

namespace hallway::log {
namespace {

constexpr std::array<std::pair<CommandCause, std::string_view>, 8> kCauses{
    {{CommandCause::kNone, "none"},
     {CommandCause::kPlugin, "plugin"},
     {CommandCause::kPath, "path"},
     {CommandCause::kCommands, "commands"},
     {CommandCause::kHeld, "held"},
     {CommandCause::kWatchdog, "watchdog"},
     {CommandCause::kTimeout, "timeout"},
     {CommandCause::kFailure, "failure"}}};

constexpr std::string_view kTimeProblem = "the time is below 0";
constexpr std::string_view kKindProblem = "the kind is not a word of the letters a-z, digits and _";

bool is_kind(std::string_view text) {
  const auto in_word = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
  return !text.empty() && std::ranges::all_of(text, in_word);
}

bool is_one_field(std::string_view text) {
  const auto ends_field = [](char c) { return c == ',' || static_cast<unsigned char>(c) < 0x20; };
  return std::ranges::none_of(text, ends_field) && trim(text) == text;
}

bool are_changes(std::string_view text) {
  if (text.empty()) return true;
  return std::ranges::all_of(split(text, '+'), [](std::string_view name) {
    return std::ranges::find(kCommandChanges, name) != kCommandChanges.end();
  });
}

template <typename Row>
void require_readable(const Row& row) {
  const std::string problem = problem_of(row);
  if (!problem.empty()) throw Error(ErrorCode::kInternal, "a row to be written: " + problem);
}

RowWriter& add_time(RowWriter& out, std::int64_t t_ns) {
  return out.whole(static_cast<std::uint64_t>(t_ns));
}

std::int64_t time_in(const CsvReader& row, std::size_t column) {
  return static_cast<std::int64_t>(row.whole(column, std::numeric_limits<std::int64_t>::max()));
}

std::int64_t later_time(const CsvReader& row, std::size_t column, std::int64_t previous) {
  const std::int64_t t_ns = time_in(row, column);
  if (t_ns < previous) throw row.bad_field(column, fmt::format("a time not below {}", previous));
  return t_ns;
}

std::string kind_in(const CsvReader& row, std::size_t column) {
  const std::string_view kind = row.text(column);
  if (!is_kind(kind)) throw row.bad_field(column, "a word of the letters a-z, digits and _");
  return std::string(kind);
}

/// The names of kCauses, for messages.
std::string cause_names() {
  std::string names;
  for (const auto& [cause, name] : kCauses) names += (names.empty() ? "" : ", ") + std::string(name);
  return names;
}

}  // namespace

std::string_view command_cause_name(CommandCause cause) {
  return std::ranges::find(kCauses, cause, [](const auto& entry) { return entry.first; })->second;
}

std::optional<CommandCause> command_cause(std::string_view name) {
  const auto found = std::ranges::find(kCauses, name, [](const auto& entry) { return entry.second; });
  if (found == kCauses.end()) return std::nullopt;
  return found->first;
}

std::string problem_of(const ObeyedCommand& row) {
  if (row.acts_from_ns < 0) return std::string(kTimeProblem);
  return are_changes(row.changes) ? std::string() : "the changes are not names joined by +";
}

std::string problem_of(const ContactRow& row) {
  if (row.t_ns < 0) return std::string(kTimeProblem);
  return is_kind(row.kind) ? std::string() : std::string(kKindProblem);
}

std::string problem_of(const EventRow& row) {
  if (row.t_ns < 0) return std::string(kTimeProblem);
  if (!is_kind(row.kind)) return std::string(kKindProblem);
  return is_one_field(row.what) ? std::string()
                                : "the text has a comma, a control character or a blank at one of its ends";
}

void add_row(RowWriter& out, const ObeyedCommand& row) {
  require_readable(row);
  out.whole(row.iteration).number(row.linear_m_s).number(row.angular_rad_s).number(row.lateral_m_s);
  add_time(out, row.acts_from_ns).word(command_cause_name(row.cause)).word(row.changes).end_row();
}

void add_row(RowWriter& out, const ContactRow& row) {
  require_readable(row);
  add_time(out, row.t_ns).word(row.kind).numbers(row.position_m).numbers(row.normal);
  out.number(row.speed_m_s).end_row();
}

void add_row(RowWriter& out, const EventRow& row) {
  require_readable(row);
  add_time(out, row.t_ns).word(row.kind).word(row.what).end_row();
}

std::vector<ObeyedCommand> parse_obeyed_commands(std::string_view text, const std::string& file) {
  enum Column : std::size_t { kIteration, kLinear, kAngular, kLateral, kActsFrom, kCause, kChanges };
  CsvReader row(text, file,
                {{"iteration"},
                 {"linear_m_s"},
                 {"angular_rad_s"},
                 {"lateral_m_s"},
                 {"acts_from_ns"},
                 {"cause"},
                 {"changes"}});
  std::vector<ObeyedCommand> rows;
  std::int64_t previous = -1;
  while (row.next()) {
    ObeyedCommand& read = rows.emplace_back();
    read.iteration = row.later_iteration(kIteration, previous);
    read.linear_m_s = row.number(kLinear);
    read.angular_rad_s = row.number(kAngular);
    read.lateral_m_s = row.number(kLateral);
    read.acts_from_ns = time_in(row, kActsFrom);
    const auto cause = command_cause(row.text(kCause));
    if (!cause) throw row.bad_field(kCause, "one of " + cause_names());
    read.cause = *cause;
    read.changes = row.text(kChanges);
    if (!are_changes(read.changes))
      throw row.bad_field(
          kChanges,
          "nothing or, joined by +, some of speed, lateral, angular, steering, left_out, dead_band");
    previous = read.iteration;
  }
  return rows;
}

std::vector<ContactRow> parse_contacts(std::string_view text, const std::string& file) {
  enum Column : std::size_t { kTime, kKind, kX, kY, kZ, kNx, kNy, kNz, kSpeed };
  CsvReader row(text, file,
                {{"t_ns"}, {"kind"}, {"x_m"}, {"y_m"}, {"z_m"}, {"nx"}, {"ny"}, {"nz"}, {"speed_m_s"}});
  std::vector<ContactRow> rows;
  std::int64_t previous = 0;
  while (row.next()) {
    ContactRow& read = rows.emplace_back();
    read.t_ns = previous = later_time(row, kTime, previous);
    read.kind = kind_in(row, kKind);
    read.position_m = row.vector(kX);
    read.normal = row.vector(kNx);
    read.speed_m_s = row.number(kSpeed);
  }
  return rows;
}

std::vector<EventRow> parse_events(std::string_view text, const std::string& file) {
  enum Column : std::size_t { kTime, kKind, kWhat };
  CsvReader row(text, file, {{"t_ns"}, {"kind"}, {"what"}});
  std::vector<EventRow> rows;
  std::int64_t previous = 0;
  while (row.next()) {
    EventRow& read = rows.emplace_back();
    read.t_ns = previous = later_time(row, kTime, previous);
    read.kind = kind_in(row, kKind);
    read.what = row.text(kWhat);
  }
  return rows;
}

std::vector<ObeyedCommand> read_obeyed_commands(const std::filesystem::path& path) {
  return parse_obeyed_commands(read_file(path), path.string());
}

std::vector<ContactRow> read_contacts(const std::filesystem::path& path) {
  return parse_contacts(read_file(path), path.string());
}

std::vector<EventRow> read_events(const std::filesystem::path& path) {
  return parse_events(read_file(path), path.string());
}

}  // namespace hallway::log
