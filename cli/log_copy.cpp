// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>

#include "base/error.hpp"
#include "base/refuse.hpp"
#include "base/text.hpp"
#include "command.hpp"
#include "console.hpp"
#include "log/mcap_copy.hpp"
#include "log/run_log.hpp"
#include "log/unfinished_input.hpp"
#include "log_input.hpp"
#include "log_output.hpp"
#include "output_file.hpp"
#include "shared_options.hpp"

namespace hallway::cli {
namespace {

struct CopyOptions {
  std::string log;
  std::string out;
  std::optional<double> from_s;
  std::optional<double> to_s;
  std::optional<std::uint32_t> from_iteration;
  std::optional<std::uint32_t> to_iteration;
  bool force = false;
  bool json = false;
};

/// What is kept: messages of a span of time or, of the run's own channels, of a span of iterations.
struct Span {
  std::uint64_t from_ns = 0;
  std::uint64_t to_ns = UINT64_MAX;
  std::uint32_t from_iteration = 0;
  std::uint32_t to_iteration = UINT32_MAX;
};

std::uint64_t nanoseconds(double seconds) {
  return static_cast<std::uint64_t>(std::llround(seconds * 1e9));
}

bool is_ours(const log::McapChannel& channel) {
  return channel.topic.starts_with("/hallway/");
}

/// The times of the frames of a span of iterations, for the channels that do not count iterations.
void find_times(const fs::path& path, Span& span) {
  const log::UnfinishedInput input(path);
  log::McapReader reader(input);
  std::uint64_t first = UINT64_MAX;
  std::uint64_t last = 0;
  while (const log::McapItem* item = reader.next()) {
    const auto* message = std::get_if<log::McapMessage>(item);
    if (message == nullptr || reader.channels().at(message->channel_id).topic != log::topics::kFrame)
      continue;
    if (message->sequence < span.from_iteration || message->sequence > span.to_iteration) continue;
    first = std::min(first, message->log_time_ns);
    last = std::max(last, message->log_time_ns);
  }
  if (first == UINT64_MAX) {
    throw Error(ErrorCode::kBadInput, "holds no frame of these iterations",
                {.file = printable(path.string())});
  }
  span.from_ns = first;
  span.to_ns = last;
}

Span span_of(const CopyOptions& options) {
  const bool by_time = options.from_s || options.to_s;
  const bool by_iteration = options.from_iteration || options.to_iteration;
  if (by_time == by_iteration) {
    refuse("cut takes --from and --to, or --from-iteration and --to-iteration");
  }
  Span span;
  if (options.from_s) span.from_ns = nanoseconds(*options.from_s);
  if (options.to_s) span.to_ns = nanoseconds(*options.to_s);
  span.from_iteration = options.from_iteration.value_or(0);
  span.to_iteration = options.to_iteration.value_or(UINT32_MAX);
  if (span.from_ns > span.to_ns || span.from_iteration > span.to_iteration) {
    refuse("the cut ends before it begins");
  }
  if (by_iteration) find_times(mcap_file(options.log), span);
  return span;
}

log::McapSpan mcap_span(const Span& span) {
  return {
      .from_ns = span.from_ns,
      .to_ns = span.to_ns,
      .is_of_whole_log = [](const log::McapChannel& channel) { return log::is_of_whole_log(channel.topic); },
      .wanted =
          [span](const log::McapChannel& channel, const log::McapMessage& message) {
            if (!is_ours(channel)) return true;
            return message.sequence >= span.from_iteration && message.sequence <= span.to_iteration;
          }};
}

void print_copy(const CopyOptions& options, const fs::path& out, const log::McapCopy& copy) {
  if (options.json) {
    Json damage = nullptr;
    if (copy.damage) damage = {{"byte", copy.damage->offset}, {"cause", copy.damage->cause}};
    print_json({{"schema", "hallway.log_copy/1"},
                {"status", 0},
                {"written", path_text(out)},
                {"messages", copy.messages},
                {"left_out", copy.left_out},
                {"damage", damage}});
    return;
  }
  print_result("{}: {} messages{}\n", path_text(out), copy.messages,
               copy.left_out > 0 ? fmt::format(", {} left out", copy.left_out) : "");
}

/// Copies from one file to a new one.
using CopyBytes = std::function<log::McapCopy(const log::ByteInput&, log::ByteOutput&)>;

int copy(const CopyOptions& options, const fs::path& out, const CopyBytes& copy_bytes) {
  const fs::path path = mcap_file(options.log);
  check_replaces_no_input(out.string(), std::array{path.string()});
  const log::UnfinishedInput input(path);
  NewFile file(out, options.force);
  const log::McapCopy copied = in_file(path, [&] { return copy_bytes(input, file.output()); });
  file.commit();
  if (copied.damage) {
    print_warning("{}: byte {} of {}: {}; what stands before it is kept", printable(path.string()),
                  copied.damage->offset, input.size(), copied.damage->cause);
  }
  print_copy(options, out, copied);
  return 0;
}

int cut(const CopyOptions& options) {
  const log::McapSpan span = mcap_span(span_of(options));
  return copy(options, options.out, [&span](const log::ByteInput& input, log::ByteOutput& output) {
    return log::copy_mcap_span(input, output, span);
  });
}

int recover(const CopyOptions& options) {
  const fs::path beside = mcap_file(options.log).replace_extension(".recovered.mcap");
  return copy(
      options, options.out.empty() ? beside : fs::path(options.out),
      [](const log::ByteInput& input, log::ByteOutput& output) { return log::copy_mcap(input, output); });
}

void add_common_options(Command& command, CopyOptions& options) {
  command.argument("log", &options.log, "An .mcap file, or a folder with a run.mcap").required().value("LOG");
  add_shared(command, Shared::kForce, &options.force);
  add_shared(command, Shared::kJson, &options.json);
}

}  // namespace

void add_log_cut_command(Command& group) {
  Command& command = group.command("cut", "Copy a part of an MCAP log, by time or by iteration");
  CopyOptions& options = command.runs(&cut);
  add_common_options(command, options);
  add_shared(command, Shared::kOutFile, &options.out).required();
  constexpr double kMost_s = 9e9;
  command.option("--from", &options.from_s, "First log time, seconds [start]").value("S").range(0.0, kMost_s);
  command.option("--to", &options.to_s, "Last log time, seconds [end]").value("S").range(0.0, kMost_s);
  command.option("--from-iteration", &options.from_iteration, "First iteration [first]").value("N");
  command.option("--to-iteration", &options.to_iteration, "Last iteration [last]").value("N");
  command.footer(
      "The facts of the whole log (sensors, true landmarks, metadata, attachments) are kept.\n"
      "Example: hallway log cut out/office/run.mcap --from 10 --to 20.5 --out ten_seconds.mcap");
}

void add_log_recover_command(Command& group) {
  Command& command = group.command(
      "recover", "Write what can be read of a damaged or unfinished MCAP log as a whole one, with an index");
  CopyOptions& options = command.runs(&recover);
  add_common_options(command, options);
  add_shared(command, Shared::kOutFile, &options.out).fallback("LOG with .recovered.mcap at its end");
  command.footer(
      "A run that was killed leaves its folder as NAME.part-PID.\n"
      "Example: hallway log recover out/office.part-4711 --out office.mcap");
}

}  // namespace hallway::cli
