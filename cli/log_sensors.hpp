// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/sample.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/samples/frame_bytes.hpp"

namespace hallway::cli {

/// A sensor of a log, and its samples in the frames.
struct LogSensor {
  std::uint32_t id = 0;
  std::optional<std::string> name{};  ///< safe to print; nothing: the log does not describe it
  std::string kind{};                 ///< of its samples, safe to print
  std::uint64_t samples = 0;
  std::optional<std::uint64_t> elements = 0;  ///< of all samples; nothing: of a kind that is not known
  std::int64_t first_ns = 0;                  ///< when the first sample began, where there is any
  std::int64_t last_ns = 0;                   ///< when the last one ended
};

/// Collects the sensors of a log from its messages. What cannot be read is a warning.
class LogSensors {
 public:
  /// A message of /hallway/activation: the sensors that the log describes.
  void describe(std::string_view json);
  /// A message of /hallway/frame: host/samples/frame_bytes.hpp. O(its bytes).
  void count(std::string_view frame);

  /// By id. A sensor that gives samples of two kinds, which no sensor should, stands there twice.
  std::vector<LogSensor> list() const;
  /// What could not be read, safe to print.
  std::vector<std::string> warnings() const;

 private:
  void add(const hw_sample_t& sample);

  std::map<std::pair<std::uint32_t, std::string>, LogSensor> sensors_;  ///< by id and kind
  host::FrameReader reader_;
  std::string undescribed_;       ///< why the description cannot be read
  std::uint64_t unreadable_ = 0;  ///< frames
  std::string first_cause_;       ///< of the first of them
};

}  // namespace hallway::cli
