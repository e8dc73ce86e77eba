// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/bytes.hpp"
#include "host/isolate/verdict.hpp"
#include "host/stage.hpp"

namespace hallway::host {

// What goes through a channel beside frames and outputs. Every read_x() throws BadBytes where the bytes are none of write_x(), and makes texts from a
// plugin's process safe to print once more.

/// Of a text from a plugin's process, once it is safe to print.
inline constexpr std::size_t kMaxMessageText = 20'000;

/// The first request.
struct StartRequest {
  std::string wanted{};                 ///< a plugin, as find_plugin() takes it
  std::vector<std::string> folders{};   ///< to look in
  std::uint64_t data_bytes = 0;         ///< private memory that may be had
  std::uint64_t file_bytes = 0;         ///< largest file that may be written
  std::string scratch{};                ///< folder that may be written in
  std::vector<std::string> writable{};  ///< further files and folders that may be written
};
void write_start(AlignedByteWriter& writer, const StartRequest& request);
StartRequest read_start(AlignedByteReader& reader);

/// The answer to it.
struct StartReply {
  std::vector<std::string> missing{};  ///< what the kernel does not keep the plugin from
  std::string file{};
  PluginInfo info{};
  std::vector<Parameter> parameters{};
};
void write_started(AlignedByteWriter& writer, const StartReply& reply);
StartReply read_started(AlignedByteReader& reader);

/// The answer to kDescribe.
void write_infos(AlignedByteWriter& writer, std::span<const PluginInfo> infos);
std::vector<PluginInfo> read_infos(AlignedByteReader& reader);

/// The request kActivate.
void write_activation(AlignedByteWriter& writer, const Activation& facts);
Activation read_activation(AlignedByteReader& reader);

void write_where(AlignedByteWriter& writer, const Where& where);
Where read_where(AlignedByteReader& reader);

/// An error, with the call that it came from where there is one.
void write_error(AlignedByteWriter& writer, const Error& error);
/// Throws it again: an Error or a PluginFailure.
[[noreturn]] void throw_error(AlignedByteReader& reader, const std::string& plugin);

}  // namespace hallway::host
