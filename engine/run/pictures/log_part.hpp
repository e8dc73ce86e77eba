// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string_view>

#include "log/mcap_records.hpp"

namespace hallway::run {

/// Takes a message of a log; both live until it returns.
using MessageSink = std::function<void(const log::McapChannel&, const log::McapMessage&)>;

/// Gives the messages from one log time to another, both included, in their order; by the log's index, where it is finished. Throws Error{kBadInput, kIo}.
void read_messages(const std::filesystem::path& file, std::int64_t from_ns, std::int64_t to_ns,
                   const MessageSink& sink);

/// Gives all messages of one topic, in their order. A finished log without such messages is not read. Throws Error{kBadInput, kIo}.
void read_topic(const std::filesystem::path& file, std::string_view topic, const MessageSink& sink);

}  // namespace hallway::run
