// SPDX-License-Identifier: MIT
#include "host/isolate/plugin_messages.hpp"

#include <algorithm>

#include "base/byte_archive.hpp"
#include "base/text.hpp"

namespace hallway::host {
namespace {

struct Saver : ByteSaver<AlignedByteWriter> {
  using ByteSaver::ByteSaver;
};
struct Loader : ByteLoader<AlignedByteReader> {
  using ByteLoader::ByteLoader;
};

/// Texts that are read are ours for ever, unlike what the other side may still write over, and safe to print.
template <typename Archive, typename... Texts>
void pass_printables(Archive& archive, Texts&... texts) {
  archive.lists(texts...);
  if constexpr (Archive::kReads) ((texts = printable(texts, kMaxMessageText)), ...);
}

template <typename Archive>
void pass(Archive& archive, Passed<Archive, std::string>& text) {
  archive.lists(text);
}

template <typename Archive>
void pass_printable_list(Archive& archive, Passed<Archive, std::vector<std::string>>& texts) {
  pass_all(archive, texts);
  if constexpr (Archive::kReads) {
    for (std::string& text : texts) text = printable(text, kMaxMessageText);
  }
}

template <typename Archive>
void pass(Archive& archive, Passed<Archive, PluginInfo>& info) {
  pass_printables(archive, info.id, info.name, info.version, info.vendor, info.description);
  archive.lists(info.inputs, info.optional_inputs, info.outputs);
}

template <typename Archive>
void pass(Archive& archive, Passed<Archive, Parameter>& parameter) {
  pass_printables(archive, parameter.name, parameter.unit, parameter.help);
  archive.values(parameter.default_value, parameter.minimum, parameter.maximum);
  pass_printable_list(archive, parameter.choices);
  pass_printables(archive, parameter.default_text);
  archive.template value_as<std::uint64_t>(parameter.writable);
}

template <typename Archive>
void pass(Archive& archive, Passed<Archive, StartRequest>& request) {
  archive.lists(request.wanted);
  pass_all(archive, request.folders);
  archive.values(request.data_bytes, request.file_bytes);
  archive.lists(request.scratch);
  pass_all(archive, request.writable);
}

template <typename Archive>
void pass(Archive& archive, Passed<Archive, StartReply>& reply) {
  pass_printable_list(archive, reply.missing);
  archive.lists(reply.file);
  pass(archive, reply.info);
  pass_all(archive, reply.parameters);
}

template <typename Archive>
void pass(Archive& archive, Passed<Archive, BumpZoneInfo>& zone) {
  archive.lists(zone.name);
  archive.values(zone.middle_rad, zone.width_rad, zone.bottom_m, zone.top_m);
}

template <typename Archive>
void pass(Archive& archive, Passed<Archive, BumpIntrinsics>& bump) {
  pass_all(archive, bump.zones);
}

template <typename Archive>
void pass(Archive& archive, Passed<Archive, EncoderIntrinsics>& encoder) {
  archive.lists(encoder.wheels);
}

template <typename Archive>
void pass(Archive& archive, Passed<Archive, RangeScanIntrinsics>& scan) {
  archive.template value_as<std::uint64_t>(scan.width);
  archive.template value_as<std::uint64_t>(scan.height);
  archive.template value_as<std::uint64_t>(scan.layers);
  archive.values(scan.beam_rad, scan.scan_s);
}

template <typename Archive>
void pass(Archive& archive, Passed<Archive, ImuIntrinsics>& imu) {
  for (const ImuNumber& number : imu_numbers()) archive.values(imu.*number.host);
}

template <typename Archive>
void pass(Archive& archive, Passed<Archive, GnssIntrinsics>& gnss) {
  archive.values(gnss.latitude_deg, gnss.longitude_deg, gnss.altitude_m);
}

/// Which of the alternatives it is, and that.
template <typename Archive, typename Choice>
void pass_choice(Archive& archive, Choice& choice) {
  std::uint64_t index = choice.index();
  archive.values(index);
  if constexpr (Archive::kReads) {
    if (index == 1) choice = BumpIntrinsics{};
    if (index == 2) choice = EncoderIntrinsics{};
    if (index == 3) choice = RangeScanIntrinsics{};
    if (index == 4) choice = ImuIntrinsics{};
    if (index == 5) choice = GnssIntrinsics{};
    if (index > 5) throw BadBytes{"intrinsics of an unknown kind"};
  }
  if (auto* bump = std::get_if<BumpIntrinsics>(&choice)) pass(archive, *bump);
  if (auto* encoder = std::get_if<EncoderIntrinsics>(&choice)) pass(archive, *encoder);
  if (auto* scan = std::get_if<RangeScanIntrinsics>(&choice)) pass(archive, *scan);
  if (auto* imu = std::get_if<ImuIntrinsics>(&choice)) pass(archive, *imu);
  if (auto* gnss = std::get_if<GnssIntrinsics>(&choice)) pass(archive, *gnss);
}

template <typename Archive>
void pass(Archive& archive, Passed<Archive, SensorInfo>& sensor) {
  archive.values(sensor.id, sensor.kind);
  archive.lists(sensor.name);
  archive.values(sensor.T_body_sensor, sensor.horizontal_fov, sensor.vertical_fov, sensor.min_range_m,
                 sensor.max_range_m, sensor.noise_m[0], sensor.noise_m[1], sensor.noise_m[2], sensor.rate_hz,
                 sensor.latency_s, sensor.noise_per_m[0], sensor.noise_per_m[1], sensor.noise_per_m[2]);
  pass_choice(archive, sensor.intrinsics);
}

template <typename Archive>
void pass(Archive& archive, Passed<Archive, DriveInfo>& drive) {
  archive.template value_as<std::uint64_t>(drive.kind);
  for (const DriveNumber& number : drive_numbers()) archive.values(drive.*number.host);
}

template <typename Archive>
void pass(Archive& archive, Passed<Archive, BodyInfo>& body) {
  archive.lists(body.corners);
  archive.values(body.radius_m, body.bottom_m, body.top_m);
}

/// A value that may be missing.
template <typename Archive, typename Optional>
void pass_optional(Archive& archive, Optional& value) {
  std::uint64_t is_there = value.has_value() ? 1 : 0;
  archive.values(is_there);
  if constexpr (Archive::kReads) {
    if (is_there != 0) value.emplace();
  }
  if (value) pass(archive, *value);
}

template <typename Archive>
void pass(Archive& archive, Passed<Archive, Activation>& facts) {
  pass_all(archive, facts.sensors);
  pass_optional(archive, facts.drive);
  pass_optional(archive, facts.body);
}

template <typename Archive>
void pass(Archive& archive, Passed<Archive, Where>& where) {
  pass_printables(archive, where.file);
  archive.template value_as<std::int64_t>(where.line);
  pass_printables(archive, where.element);
}

template <typename Message>
void save(AlignedByteWriter& writer, const Message& message) {
  Saver saver(writer);
  pass(saver, message);
}

template <typename Message>
Message loaded(AlignedByteReader& reader) {
  Message message{};
  Loader loader(reader);
  pass(loader, message);
  return message;
}

/// What a plugin's process may say of what went wrong.
ErrorCode code_of(std::uint32_t number) {
  for (const ErrorCode code : {ErrorCode::kUsage, ErrorCode::kBadInput, ErrorCode::kIo,
                               ErrorCode::kPluginLoad, ErrorCode::kPluginFault}) {
    if (number == static_cast<std::uint32_t>(code)) return code;
  }
  throw BadBytes{"an error of an unknown kind"};
}

}  // namespace

void write_start(AlignedByteWriter& writer, const StartRequest& request) {
  save(writer, request);
}

StartRequest read_start(AlignedByteReader& reader) {
  return loaded<StartRequest>(reader);
}

void write_started(AlignedByteWriter& writer, const StartReply& reply) {
  save(writer, reply);
}

StartReply read_started(AlignedByteReader& reader) {
  StartReply reply = loaded<StartReply>(reader);
  reader.expect_end();
  return reply;
}

void write_infos(AlignedByteWriter& writer, std::span<const PluginInfo> infos) {
  Saver saver(writer);
  pass_all(saver, infos);
}

std::vector<PluginInfo> read_infos(AlignedByteReader& reader) {
  std::vector<PluginInfo> infos;
  Loader loader(reader);
  pass_all(loader, infos);
  reader.expect_end();
  return infos;
}

void write_activation(AlignedByteWriter& writer, const Activation& facts) {
  save(writer, facts);
}

Activation read_activation(AlignedByteReader& reader) {
  return loaded<Activation>(reader);
}

void write_where(AlignedByteWriter& writer, const Where& where) {
  save(writer, where);
}

Where read_where(AlignedByteReader& reader) {
  return loaded<Where>(reader);
}

void write_error(AlignedByteWriter& writer, const Error& error) {
  const auto* failure = dynamic_cast<const PluginFailure*>(&error);
  writer.put(static_cast<std::uint32_t>(error.code()));
  writer.put_text(error.message());
  write_where(writer, error.where());
  writer.put_text(failure != nullptr ? failure->verdict().call : "");
}

void throw_error(AlignedByteReader& reader, const std::string& plugin) {
  const ErrorCode code = code_of(reader.get<std::uint32_t>());
  const std::string message = printable(reader.get_text(), kMaxMessageText);
  const Where where = read_where(reader);
  const std::string call = printable(reader.get_text(), kMaxMessageText);
  reader.expect_end();
  if (call.empty()) throw Error(code, message, where);
  throw PluginFailure(
      code, message, where,
      {.what = Misdeed::kFault, .call = call, .plugin = printable(plugin), .message = message});
}

}  // namespace hallway::host
