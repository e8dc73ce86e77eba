// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "base/text.hpp"
#include "command.hpp"
#include "console.hpp"
#include "log/mcap_reader.hpp"
#include "log/run_log.hpp"
#include "log/unfinished_input.hpp"
#include "log_input.hpp"
#include "log_sensors.hpp"
#include "shared_options.hpp"

namespace hallway::cli {
namespace {

/// The messages of one channel.
struct ChannelFacts {
  log::McapChannel channel;
  std::uint64_t messages = 0;
  std::uint64_t bytes = 0;
  std::uint64_t first_ns = 0;
  std::uint64_t last_ns = 0;
};

/// What a log holds, as far as it can be read.
struct Facts {
  std::string file{};
  std::uint64_t bytes = 0;
  log::McapHeader header{};
  std::uint64_t chunks = 0;
  std::map<std::uint16_t, ChannelFacts> channels;
  std::vector<LogSensor> sensors;
  std::vector<std::string> attachments;  ///< names, safe to print
  std::vector<std::string> metadata;     ///< the same
  std::optional<log::McapDamage> damage;
  bool all_data_read = false;
  std::vector<std::string> warnings;  ///< already printed
};

void count(ChannelFacts& facts, const log::McapMessage& message) {
  const std::uint64_t t = message.log_time_ns;
  facts.first_ns = facts.messages == 0 ? t : std::min(facts.first_ns, t);
  facts.last_ns = std::max(facts.last_ns, t);
  facts.bytes += message.data.size();
  ++facts.messages;
}

/// What a message of the run's own channels says of the sensors.
void take(LogSensors& sensors, const std::string& topic, const log::McapMessage& message) {
  if (topic == log::topics::kActivation) sensors.describe(message.data);
  if (topic == log::topics::kFrame) sensors.count(message.data);
}

Facts facts_of(const fs::path& path) {
  const log::UnfinishedInput input(path);
  Facts facts;
  facts.file = path_text(path);
  facts.bytes = input.size();
  log::McapReader reader(input);
  LogSensors sensors;
  while (const log::McapItem* item = reader.next()) {
    if (const auto* channel = std::get_if<log::McapChannel>(item))
      facts.channels[channel->id].channel = *channel;
    if (const auto* message = std::get_if<log::McapMessage>(item)) {
      ChannelFacts& channel = facts.channels[message->channel_id];
      count(channel, *message);
      take(sensors, channel.channel.topic, *message);
    }
    if (const auto* attachment = std::get_if<log::McapAttachment>(item))
      facts.attachments.push_back(printable(attachment->name));
    if (const auto* metadata = std::get_if<log::McapMetadata>(item))
      facts.metadata.push_back(printable(metadata->name));
  }
  facts.header = reader.header();
  facts.chunks = reader.chunks();
  facts.damage = reader.damage();
  facts.all_data_read = reader.all_data_read();
  facts.sensors = sensors.list();
  for (const std::string& warning : sensors.warnings())
    print_warning(facts.warnings, fmt::format("{}: {}", facts.file, warning));
  return facts;
}

std::uint64_t messages_of(const Facts& facts) {
  std::uint64_t sum = 0;
  for (const auto& [id, channel] : facts.channels) sum += channel.messages;
  return sum;
}

std::string seconds(std::uint64_t ns) {
  return fmt::format("{}.{:09}", ns / 1'000'000'000, ns % 1'000'000'000);
}

/// Of a time that may lie before 0, as a sample's may.
std::string signed_seconds(std::int64_t ns) {
  return ns < 0 ? "-" + seconds(0 - static_cast<std::uint64_t>(ns)) : seconds(static_cast<std::uint64_t>(ns));
}

std::string damage_text(const Facts& facts) {
  if (!facts.damage) return "none; every check sum that it has is right";
  return fmt::format(
      "byte {} of {}: {}; {}", facts.damage->offset, facts.bytes, facts.damage->cause,
      facts.all_data_read ? "all messages could be read" : "what stands before it could be read");
}

std::string names_of(const std::vector<std::string>& names) {
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

std::string line_of(const LogSensor& sensor) {
  const std::string name = fmt::format("{} {}", sensor.id, sensor.name.value_or("(not described)"));
  std::string line = fmt::format("    {:<32} {:>8}  {}", name, sensor.samples, sensor.kind);
  if (sensor.samples == 0) return line;
  if (sensor.elements) line += fmt::format("  {} elements", *sensor.elements);
  return line +
         fmt::format("  {} s to {} s", signed_seconds(sensor.first_ns), signed_seconds(sensor.last_ns));
}

std::string text_of(const Facts& facts) {
  std::string text = facts.file + "\n";
  const Rows row{text, 12};
  row("bytes", fmt::to_string(facts.bytes));
  row("written by", printable(facts.header.library));
  row("chunks", fmt::to_string(facts.chunks));
  row("messages", fmt::to_string(messages_of(facts)));
  for (const auto& [id, channel] : facts.channels) {
    text += fmt::format("    {:<32} {:>8}  {}", printable(channel.channel.topic), channel.messages,
                        printable(channel.channel.encoding));
    if (channel.messages > 0)
      text += fmt::format("  {} s to {} s", seconds(channel.first_ns), seconds(channel.last_ns));
    text += '\n';
  }
  row("sensors", fmt::to_string(facts.sensors.size()));
  for (const LogSensor& sensor : facts.sensors) text += line_of(sensor) + "\n";
  row("metadata", names_of(facts.metadata));
  row("attachments", names_of(facts.attachments));
  row("damage", damage_text(facts));
  return text;
}

Json json_of(const LogSensor& sensor) {
  const bool has_times = sensor.samples > 0;
  return {{"id", sensor.id},
          {"name", sensor.name ? Json(*sensor.name) : Json(nullptr)},
          {"kind", sensor.kind},
          {"samples", sensor.samples},
          {"elements", sensor.elements ? Json(*sensor.elements) : Json(nullptr)},
          {"first_ns", has_times ? Json(sensor.first_ns) : Json(nullptr)},
          {"last_ns", has_times ? Json(sensor.last_ns) : Json(nullptr)}};
}

Json document_of(const Facts& facts) {
  Json channels = Json::array();
  for (const auto& [id, channel] : facts.channels) {
    Json entry{{"topic", printable(channel.channel.topic)},
               {"encoding", printable(channel.channel.encoding)},
               {"messages", channel.messages},
               {"bytes", channel.bytes}};
    entry["first_ns"] = channel.messages > 0 ? Json(channel.first_ns) : Json(nullptr);
    entry["last_ns"] = channel.messages > 0 ? Json(channel.last_ns) : Json(nullptr);
    channels.push_back(entry);
  }
  Json sensors = Json::array();
  for (const LogSensor& sensor : facts.sensors) sensors.push_back(json_of(sensor));
  Json damage = nullptr;
  if (facts.damage) {
    damage = {{"byte", facts.damage->offset},
              {"cause", facts.damage->cause},
              {"all_data_read", facts.all_data_read}};
  }
  return {{"schema", "hallway.log_info/1"},
          {"status", facts.damage ? 1 : 0},
          {"file", facts.file},
          {"bytes", facts.bytes},
          {"profile", printable(facts.header.profile)},
          {"library", printable(facts.header.library)},
          {"chunks", facts.chunks},
          {"messages", messages_of(facts)},
          {"channels", channels},
          {"sensors", sensors},
          {"metadata", facts.metadata},
          {"attachments", facts.attachments},
          {"damage", damage},
          {"warnings", facts.warnings}};
}

struct InfoOptions {
  std::string log;
  bool json = false;
};

int show_info(const InfoOptions& options) {
  const fs::path path = mcap_file(options.log);
  const Facts facts = in_file(path, [&] { return facts_of(path); });
  if (options.json) {
    print_json(document_of(facts));
  } else {
    print_result(text_of(facts));
  }
  return facts.damage ? 1 : 0;
}

}  // namespace

void add_log_info_command(Command& group) {
  Command& command = group.command("info", "List what an MCAP log contains, and whether it is complete");
  InfoOptions& options = command.runs(&show_info);
  command.argument("log", &options.log, "An .mcap file, or a run folder").required().value("LOG");
  add_shared(command, Shared::kJson, &options.json);
  command.footer(
      "All of the log is read. Of each sensor: id, name, samples, their kind, elements (points, planes) and "
      "times.\n"
      "Exit status 1 says that the log is damaged.\nExample: hallway log info out/office/run.mcap");
}

}  // namespace hallway::cli
