// SPDX-License-Identifier: MIT
#include "sim/recorded_commands.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "base/text.hpp"
#include "log/byte_io.hpp"
#include "log/drive_tables.hpp"
#include "log/mcap_reader.hpp"
#include "log/mcap_records.hpp"
#include "log/run_log.hpp"

namespace hallway::sim {
namespace {

/// The commands in what a drive obeyed, frame by frame.
class ObeyedCommands {
 public:
  explicit ObeyedCommands(std::int64_t latency_ns) : latency_ns_(latency_ns) {}

  void add(const log::ObeyedCommand& row) {
    if (row.cause == log::CommandCause::kNone) return;
    const drive::TimedCommand command{std::max<std::int64_t>(row.acts_from_ns - latency_ns_, 0),
                                      {row.linear_m_s, row.lateral_m_s, row.angular_rad_s}};
    if (acts_from_ns_ == row.acts_from_ns && commands_.back().command == command.command)
      return;  // it is held
    acts_from_ns_ = row.acts_from_ns;
    if (!commands_.empty() && command.t_ns <= commands_.back().t_ns) commands_.pop_back();
    commands_.push_back(command);
  }

  std::vector<drive::TimedCommand> take() { return std::move(commands_); }

 private:
  std::int64_t latency_ns_;
  std::optional<std::int64_t> acts_from_ns_;  ///< of the last one
  std::vector<drive::TimedCommand> commands_;
};

std::vector<drive::TimedCommand> commands_of_log(const std::filesystem::path& file, std::int64_t latency_ns) {
  const log::FileInput input(file);
  log::McapReader reader(input);
  ObeyedCommands obeyed(latency_ns);
  std::vector<drive::TimedCommand> given;
  while (const log::McapItem* item = reader.next()) {
    const auto* message = std::get_if<log::McapMessage>(item);
    if (message == nullptr) continue;
    const log::McapChannel& channel = reader.channels().at(message->channel_id);
    if (channel.topic == log::topics::kObeyed)
      obeyed.add(std::get<log::ObeyedCommand>(log::parse_drive_message(channel, *message)));
    if (channel.topic != log::topics::kCommand) continue;
    const auto command = std::get<log::CommandMessage>(log::parse_run_message(channel, *message)).command;
    const auto t_ns = static_cast<std::int64_t>(message->log_time_ns);
    if (!given.empty() && t_ns <= given.back().t_ns)
      given.pop_back();  // of several to one frame the last counts
    given.push_back({t_ns, {command.linear_m_s, command.lateral_m_s, command.angular_rad_s}});
  }
  if (reader.damage()) throw Error(ErrorCode::kBadInput, "the log is damaged: " + reader.damage()->cause);
  std::vector<drive::TimedCommand> commands = obeyed.take();
  return commands.empty() ? given : commands;
}

std::vector<drive::TimedCommand> commands_of_drive(const std::filesystem::path& file,
                                                   std::int64_t latency_ns) {
  ObeyedCommands obeyed(latency_ns);
  for (const log::ObeyedCommand& row : log::read_obeyed_commands(file)) obeyed.add(row);
  return obeyed.take();
}

/// Names the file.
template <typename Read>
drive::CommandTable table_of(const std::filesystem::path& file, Read read) {
  try {
    return drive::CommandTable(read());
  } catch (const Error& error) {
    if (!error.where().file.empty()) throw;
    throw Error(error.code(), error.message(), {.file = printable(file.string())});
  }
}

}  // namespace

drive::CommandTable read_commands(const std::filesystem::path& file, std::int64_t latency_ns) {
  std::string head;
  const log::FileInput input(file);
  input.read(0, std::min<std::uint64_t>(input.size(), 64), head);
  if (head.starts_with(log::kMcapMagic))
    return table_of(file, [&] { return commands_of_log(file, latency_ns); });
  if (head.starts_with("iteration,"))
    return table_of(file, [&] { return commands_of_drive(file, latency_ns); });
  return drive::CommandTable::read(file);
}

}  // namespace hallway::sim
