// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "log/run_log.hpp"

namespace hallway::log {

// How the channels of run_log.hpp are named and numbered in the file.

inline constexpr const char* kRunLogProfile = "x-hallway";
inline constexpr const char* kRunLogFormat = "hallway.log/1";
inline constexpr const char* kRunMetadata = "hallway.run";
inline constexpr const char* kJsonEncoding = "json";
inline constexpr const char* kFrameEncoding = "x-hallway-frame";

/// All topics; a channel's id is its topic's place in this list, counted from 1. New ones go to the end.
inline constexpr std::array kRunTopics{
    topics::kActivation, topics::kTrueLandmarks, topics::kFrame,   topics::kTruePose, topics::kIdentities,
    topics::kPose,       topics::kAssociations,  topics::kMap,     topics::kCommand,  topics::kPlanes,
    topics::kTruePlanes, topics::kObeyed,        topics::kContact, topics::kEvent,    topics::kSampleTruth,
    topics::kLabels,     topics::kTopology,      topics::kDrawing};

/// The id of a topic's channel.
inline std::uint16_t run_channel_id(std::string_view topic) {
  const auto found = std::ranges::find(kRunTopics, topic);
  return static_cast<std::uint16_t>(found - kRunTopics.begin() + 1);
}

/// Says what the frame channel holds, to other programs.
inline McapSchema frame_schema() {
  return {.id = 1,
          .name = "hw.frame/1",
          .encoding = "x-hallway",
          .data =
              "hw_frame_t of <hallway/sample.h>, ABI 0, with offsets for pointers; see Hallway's "
              "docs/formats.md"};
}

}  // namespace hallway::log
