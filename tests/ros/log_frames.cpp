// SPDX-License-Identifier: MIT
#include "log_frames.hpp"

#include <span>
#include <stdexcept>
#include <variant>

#include "base/file.hpp"
#include "host/samples/frame_bytes.hpp"
#include "host/samples/point_kind.hpp"
#include "log/mcap_reader.hpp"
#include "log/run_log.hpp"

namespace hallway::test {
namespace {

LogFrame parse_frame(std::string_view bytes) {
  host::FrameReader reader;
  const hw_frame_t& frame = reader.read(std::as_bytes(std::span(bytes.data(), bytes.size())));
  if (frame.n_samples != 1) throw std::runtime_error("a frame of the log has not one reading");
  const auto& points = *static_cast<const hw_points_t*>(frame.samples[0]->payload);
  LogFrame result{frame.sequence, frame.t_ns, {}, std::string(bytes)};
  for (std::uint64_t i = 0; i < points.count; ++i) result.points.push_back(*hw_point_at(&points, i));
  return result;
}

}  // namespace

std::vector<LogFrame> read_log_frames(const std::filesystem::path& file) {
  const log::FileInput input(file);
  log::McapReader reader(input);
  std::vector<LogFrame> frames;
  while (const log::McapItem* item = reader.next()) {
    const auto* message = std::get_if<log::McapMessage>(item);
    if (message == nullptr) continue;
    const log::RunMessage parsed =
        log::parse_run_message(reader.channels().at(message->channel_id), *message);
    if (const auto* frame = std::get_if<log::FrameMessage>(&parsed))
      frames.push_back(parse_frame(frame->bytes));
  }
  if (reader.damage()) throw std::runtime_error("the log is damaged: " + reader.damage()->cause);
  return frames;
}

void write_log(const std::filesystem::path& file, const std::vector<std::vector<hw_point3_t>>& frames) {
  log::StringOutput output;
  log::RunLogWriter writer(output, "test", "{}");
  host::FrameBuilder builder;
  std::string bytes;
  for (std::uint32_t i = 0; i < frames.size(); ++i) {
    builder.begin(i, std::int64_t{i} * 1'000'000);
    add_points(builder, 0) = frames[i];
    const hw_frame_t& frame = builder.finish();
    host::FrameWriter().write_over(bytes, frame);
    writer.add_frame({i, frame.t_ns}, bytes);
  }
  writer.finish();
  write_file_atomically(file, output.text());
}

}  // namespace hallway::test
