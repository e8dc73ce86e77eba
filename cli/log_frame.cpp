// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <span>

#include "base/error.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "console.hpp"
#include "host/samples/frame_bytes.hpp"
#include "host/samples/sample_json.hpp"
#include "log/mcap_reader.hpp"
#include "log/run_log.hpp"
#include "log/unfinished_input.hpp"
#include "log_input.hpp"
#include "log_sensors.hpp"
#include "shared_options.hpp"

namespace hallway::cli {
namespace {

struct FrameOptions {
  std::string log;
  std::uint32_t iteration = 0;
  std::string sensor;
  bool json = false;
};

/// What was found of the frame that is wanted.
struct FoundFrame {
  std::optional<std::string> bytes{};  ///< host/samples/frame_bytes.hpp
  std::vector<LogSensor> sensors{};    ///< that the log describes before it
  std::uint64_t others = 0;            ///< frames before it
  std::uint32_t first = 0;             ///< iteration of the first of them
  std::uint32_t last = 0;              ///< of the last
  std::optional<log::McapDamage> damage{};
};

/// Reads a log up to the frame.
FoundFrame find_frame(const fs::path& path, std::uint32_t iteration) {
  const log::UnfinishedInput input(path);
  log::McapReader reader(input);
  FoundFrame found;
  LogSensors sensors;
  while (const log::McapItem* item = reader.next()) {
    const auto* message = std::get_if<log::McapMessage>(item);
    if (message == nullptr) continue;
    const std::string& topic = reader.channels().at(message->channel_id).topic;
    if (topic == log::topics::kActivation) sensors.describe(message->data);
    if (topic != log::topics::kFrame) continue;
    if (message->sequence == iteration) {
      found.bytes = std::string(message->data);
      break;
    }
    if (found.others++ == 0) found.first = message->sequence;
    found.last = message->sequence;
  }
  found.sensors = sensors.list();
  found.damage = reader.damage();
  const bool has_channel = std::ranges::any_of(
      reader.channels(), [](const auto& entry) { return entry.second.topic == log::topics::kFrame; });
  if (!has_channel && !found.damage)
    throw Error(ErrorCode::kBadInput, "holds no frames of Hallway (no channel /hallway/frame)");
  return found;
}

std::string why_not_found(const FoundFrame& found, std::uint32_t iteration) {
  std::string text = fmt::format("holds no frame {}", iteration);
  if (found.damage)
    text += fmt::format(" before the damage at byte {}: {}", found.damage->offset, found.damage->cause);
  if (found.others == 0) return text + "; it holds none at all";
  return text +
         fmt::format("; its {} frames are of the iterations {} to {}", found.others, found.first, found.last);
}

/// The id of a sensor by its name or id. Throws Error{kUsage} for one that the log does not describe.
std::uint32_t sensor_named(const std::string& wanted, const std::vector<LogSensor>& sensors) {
  std::vector<std::string> names;
  for (const LogSensor& sensor : sensors) {
    if (sensor.name == wanted) return sensor.id;
    names.push_back(fmt::format("{} ({})", sensor.id, sensor.name.value_or("")));
  }
  const auto id = parse_uint(wanted);
  for (const LogSensor& sensor : sensors) {
    if (id && *id == sensor.id) return sensor.id;
  }
  if (sensors.empty() && id && *id <= UINT32_MAX) return static_cast<std::uint32_t>(*id);
  refuse("the log has no sensor `{}`; it has: {}", printable(wanted),
         names.empty() ? "none that it describes" : fmt::format("{}", fmt::join(names, ", ")));
}

/// A frame as JSON.
struct FrameText {
  std::string frame;        ///< host/samples/sample_json.hpp
  std::string passed_over;  ///< a list of the samples of unknown kinds, likewise
  std::size_t n_passed_over = 0;
};

/// @param sensor  whose samples alone are wanted
FrameText text_of(const std::string& bytes, std::optional<std::uint32_t> sensor) {
  const auto is_wanted = [&](const hw_sample_t& sample) { return !sensor || sample.sensor_id == *sensor; };
  host::FrameReader reader;
  hw_frame_t frame = reader.read(std::as_bytes(std::span(bytes)));
  std::vector<const hw_sample_t*> samples;
  for (std::uint32_t i = 0; i < frame.n_samples; ++i) {
    if (is_wanted(*frame.samples[i])) samples.push_back(frame.samples[i]);
  }
  frame.n_samples = static_cast<std::uint32_t>(samples.size());
  frame.samples = samples.data();
  FrameText text{.frame = host::frame_json(frame), .passed_over = "["};
  for (const hw_sample_t& sample : reader.passed_over()) {
    if (!is_wanted(sample)) continue;
    if (text.n_passed_over++ > 0) text.passed_over += ',';
    host::append_sample_json(text.passed_over, sample);
  }
  text.passed_over += ']';
  return text;
}

/// The document of the command. The frame is put in as the text that it is.
std::string document_of(const fs::path& path, const std::optional<FrameText>& text) {
  std::string document =
      Json{{"schema", "hallway.log_frame/1"}, {"status", text ? 0 : 1}, {"file", path_text(path)}}.dump(
          -1, ' ', false, Json::error_handler_t::replace);
  document.pop_back();
  return document + R"(,"frame":)" + (text ? text->frame : "null") + R"(,"passed_over":)" +
         (text ? text->passed_over : "[]") + "}\n";
}

int show_frame(const FrameOptions& options) {
  const fs::path path = mcap_file(options.log);
  const FoundFrame found = in_file(path, [&] { return find_frame(path, options.iteration); });
  if (!found.bytes) {
    print_notice(path_text(path) + ": " + why_not_found(found, options.iteration));
    if (options.json) print_result(document_of(path, std::nullopt));
    return 1;
  }
  std::optional<std::uint32_t> sensor;
  if (!options.sensor.empty()) sensor = sensor_named(options.sensor, found.sensors);
  FrameText text;
  try {
    text = text_of(*found.bytes, sensor);
  } catch (const Error& error) {
    throw Error(error.code(), error.message(), {.file = path_text(path), .element = error.where().element});
  }
  if (text.n_passed_over > 0 && !options.json)
    print_warning("{}: {} samples of kinds that this program does not know are left out", path_text(path),
                  text.n_passed_over);
  print_result(options.json ? document_of(path, text) : text.frame + "\n");
  return 0;
}

}  // namespace

void add_log_frame_command(Command& group) {
  Command& command = group.command("frame", "Print a frame of an MCAP log, with its samples, as JSON");
  FrameOptions& options = command.runs(&show_frame);
  command.argument("log", &options.log, "An .mcap file, or a folder with a run.mcap").required().value("LOG");
  command.argument("iteration", &options.iteration, "Number of the frame").required().value("N");
  command.option("--sensor", &options.sensor, "Samples of this sensor alone")
      .value("ID|NAME")
      .fallback("of all");
  add_shared(command, Shared::kJson, &options.json);
  command.footer(
      "Without --json the frame alone is printed. The log is read up to the frame.\n"
      "Exit status 1 says that the log has no such frame.\n"
      "Example: hallway log frame out/office/run.mcap 12");
}

}  // namespace hallway::cli
