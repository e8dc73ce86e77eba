// SPDX-License-Identifier: MIT
#include "host/plugin_messages.hpp"

#include <algorithm>

#include "base/text.hpp"

namespace hallway::host {
namespace {

constexpr std::size_t kMaxText = 20'000;

/// Ours for ever, unlike what the other side may still write over.
std::string get_printable(AlignedByteReader& reader) {
  return printable(reader.get_text(), kMaxText);
}

void write_texts(AlignedByteWriter& writer, const std::vector<std::string>& texts) {
  writer.put<std::uint64_t>(texts.size());
  for (const std::string& text : texts) writer.put_text(text);
}

std::vector<std::string> read_texts(AlignedByteReader& reader) {
  std::vector<std::string> texts(reader.get_count());
  for (std::string& text : texts) text = reader.get_text();
  return texts;
}

std::vector<std::string> read_printables(AlignedByteReader& reader) {
  std::vector<std::string> texts(reader.get_count());
  for (std::string& text : texts) text = get_printable(reader);
  return texts;
}

void write_info(AlignedByteWriter& writer, const PluginInfo& info) {
  for (const std::string* text : {&info.id, &info.name, &info.version, &info.vendor, &info.description}) {
    writer.put_text(*text);
  }
  writer.put_list(info.inputs);
  writer.put_list(info.outputs);
}

PluginInfo read_info(AlignedByteReader& reader) {
  PluginInfo info;
  for (std::string* text : {&info.id, &info.name, &info.version, &info.vendor, &info.description}) {
    *text = get_printable(reader);
  }
  info.inputs = reader.copy_list<std::uint32_t>();
  info.outputs = reader.copy_list<std::uint32_t>();
  return info;
}

void write_parameter(AlignedByteWriter& writer, const Parameter& parameter) {
  for (const std::string* text : {&parameter.name, &parameter.unit, &parameter.help}) writer.put_text(*text);
  for (const auto* value : {&parameter.default_value, &parameter.minimum, &parameter.maximum})
    writer.put(*value);
  write_texts(writer, parameter.choices);
  writer.put_text(parameter.default_text);
  writer.put<std::uint64_t>(parameter.writable ? 1 : 0);
}

Parameter read_parameter(AlignedByteReader& reader) {
  Parameter parameter{};
  for (std::string* text : {&parameter.name, &parameter.unit, &parameter.help}) *text = get_printable(reader);
  for (auto* value : {&parameter.default_value, &parameter.minimum, &parameter.maximum}) {
    *value = reader.get<hw_param_value_t>();
  }
  parameter.choices = read_printables(reader);
  parameter.default_text = get_printable(reader);
  parameter.writable = reader.get<std::uint64_t>() != 0;
  return parameter;
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
  writer.put_text(request.wanted);
  write_texts(writer, request.folders);
  writer.put(request.data_bytes);
  writer.put(request.file_bytes);
  writer.put_text(request.scratch);
  write_texts(writer, request.writable);
}

StartRequest read_start(AlignedByteReader& reader) {
  StartRequest request;
  request.wanted = reader.get_text();
  request.folders = read_texts(reader);
  request.data_bytes = reader.get<std::uint64_t>();
  request.file_bytes = reader.get<std::uint64_t>();
  request.scratch = reader.get_text();
  request.writable = read_texts(reader);
  return request;
}

void write_started(AlignedByteWriter& writer, const StartReply& reply) {
  write_texts(writer, reply.missing);
  writer.put_text(reply.file);
  write_info(writer, reply.info);
  writer.put<std::uint64_t>(reply.parameters.size());
  for (const Parameter& parameter : reply.parameters) write_parameter(writer, parameter);
}

StartReply read_started(AlignedByteReader& reader) {
  StartReply reply;
  reply.missing = read_printables(reader);
  reply.file = reader.get_text();
  reply.info = read_info(reader);
  reply.parameters.resize(reader.get_count());
  for (Parameter& parameter : reply.parameters) parameter = read_parameter(reader);
  reader.expect_end();
  return reply;
}

void write_infos(AlignedByteWriter& writer, std::span<const PluginInfo> infos) {
  writer.put<std::uint64_t>(infos.size());
  for (const PluginInfo& info : infos) write_info(writer, info);
}

std::vector<PluginInfo> read_infos(AlignedByteReader& reader) {
  std::vector<PluginInfo> infos(reader.get_count());
  for (PluginInfo& info : infos) info = read_info(reader);
  reader.expect_end();
  return infos;
}

void write_sensors(AlignedByteWriter& writer, std::span<const SensorInfo> sensors) {
  writer.put<std::uint64_t>(sensors.size());
  for (const SensorInfo& sensor : sensors) {
    writer.put(sensor.id);
    writer.put(sensor.kind);
    writer.put_text(sensor.name);
    writer.put(sensor.T_body_sensor);
    for (const double number : {sensor.horizontal_fov, sensor.vertical_fov, sensor.min_range_m,
                                sensor.max_range_m, sensor.noise_m[0], sensor.noise_m[1], sensor.noise_m[2]})
      writer.put(number);
  }
}

std::vector<SensorInfo> read_sensors(AlignedByteReader& reader) {
  std::vector<SensorInfo> sensors(reader.get_count());
  for (SensorInfo& sensor : sensors) {
    sensor.id = reader.get<std::uint32_t>();
    sensor.kind = reader.get<std::uint32_t>();
    sensor.name = reader.get_text();
    sensor.T_body_sensor = reader.get<hw_pose_t>();
    for (double* number : {&sensor.horizontal_fov, &sensor.vertical_fov, &sensor.min_range_m,
                           &sensor.max_range_m, &sensor.noise_m[0], &sensor.noise_m[1], &sensor.noise_m[2]})
      *number = reader.get<double>();
  }
  return sensors;
}

void write_where(AlignedByteWriter& writer, const Where& where) {
  writer.put_text(where.file);
  writer.put<std::int64_t>(where.line);
  writer.put_text(where.element);
}

Where read_where(AlignedByteReader& reader) {
  Where where;
  where.file = get_printable(reader);
  where.line = static_cast<int>(reader.get<std::int64_t>());
  where.element = get_printable(reader);
  return where;
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
  const std::string message = get_printable(reader);
  const Where where = read_where(reader);
  const std::string call = get_printable(reader);
  reader.expect_end();
  if (call.empty()) throw Error(code, message, where);
  throw PluginFailure(
      code, message, where,
      {.what = Misdeed::kFault, .call = call, .plugin = printable(plugin), .message = message});
}

}  // namespace hallway::host
