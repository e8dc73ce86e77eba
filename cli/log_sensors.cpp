// SPDX-License-Identifier: MIT
#include "log_sensors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>

#include "base/error.hpp"
#include "base/text.hpp"
#include "host/samples/sample_kind.hpp"
#include "log/json_text.hpp"

namespace hallway::cli {
namespace {

std::vector<LogSensor> sensors_in(std::string_view text) {
  log::check_json_size(text);
  std::vector<LogSensor> sensors;
  const auto activation = nlohmann::ordered_json::parse(text);
  for (const auto& json : activation.at("sensors")) {
    LogSensor& sensor = sensors.emplace_back();
    sensor.id = json.value("id", std::uint32_t{0});
    sensor.name = printable(json.at("name").get<std::string>());
    sensor.kind = printable(json.value("kind", std::string(host::kPointSamples.name)));
  }
  return sensors;
}

}  // namespace

void LogSensors::describe(std::string_view json) {
  try {
    for (LogSensor& sensor : sensors_in(json)) {
      LogSensor& known = sensors_[{sensor.id, sensor.kind}];
      known.id = sensor.id;
      known.kind = sensor.kind;
      known.name = sensor.name;
    }
  } catch (const nlohmann::json::exception& failure) {
    undescribed_ = printable(failure.what());
  } catch (const Error& error) {
    undescribed_ = error.message();
  }
}

void LogSensors::count(std::string_view frame) {
  try {
    const hw_frame_t& read = reader_.read(std::as_bytes(std::span(frame)));
    for (std::uint32_t i = 0; i < read.n_samples; ++i) add(*read.samples[i]);
    for (const hw_sample_t& sample : reader_.passed_over()) add(sample);
  } catch (const Error& error) {
    if (unreadable_++ == 0) first_cause_ = error.what();
  }
}

void LogSensors::add(const hw_sample_t& sample) {
  const std::string kind = host::sample_kind_name(sample.kind);
  LogSensor& sensor = sensors_[{sample.sensor_id, kind}];
  sensor.id = sample.sensor_id;
  sensor.kind = kind;
  sensor.first_ns = sensor.samples == 0 ? sample.t_begin_ns : std::min(sensor.first_ns, sample.t_begin_ns);
  sensor.last_ns = sensor.samples == 0 ? sample.t_end_ns : std::max(sensor.last_ns, sample.t_end_ns);
  ++sensor.samples;
  const auto elements = host::count_elements(sample);
  sensor.elements = elements && sensor.elements ? std::optional(*sensor.elements + *elements) : std::nullopt;
}

std::vector<LogSensor> LogSensors::list() const {
  std::vector<LogSensor> list;
  for (const auto& [key, sensor] : sensors_) list.push_back(sensor);
  return list;
}

std::vector<std::string> LogSensors::warnings() const {
  std::vector<std::string> warnings;
  if (!undescribed_.empty())
    warnings.push_back(fmt::format("the description of the sensors cannot be read: {}", undescribed_));
  if (unreadable_ > 0)
    warnings.push_back(fmt::format("{} frames cannot be read; the first: {}", unreadable_, first_cause_));
  return warnings;
}

}  // namespace hallway::cli
