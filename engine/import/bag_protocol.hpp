// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "import/recording.hpp"

namespace hallway::import {

// What goes to the helper program `hallway-bag` and comes back from it: one request on its standard input; on its standard output a head, then its
// frames in order, then an end; or, at any place, a failure, which is the last message. Numbers are little-endian. A message is its kind (u64), the
// number of its bytes (u64) and its bytes.

/// Largest message, in bytes.
inline constexpr std::uint64_t kMaxBagMessageBytes = 256u << 20;

struct BagRequest {
  std::string file;
  std::string topic;        ///< empty: the one there is
  std::string truth_topic;  ///< empty: none
  std::uint32_t stride = 1;
};

/// A pose of the truth topic.
struct BagPose {
  std::int64_t t_ns = 0;
  double position_m[3]{};
  double orientation[4]{1.0, 0.0, 0.0, 0.0};  ///< w, x, y, z
};

/// What is known before the first frame.
struct BagHead {
  std::string topic;
  std::uint64_t frames = 0;
  std::int64_t first_ns = 0;  ///< when the first of them was recorded
  std::int64_t last_ns = 0;
  std::vector<BagPose> truth;  ///< in the order of the bag
};

enum class BagMessageKind : std::uint64_t { kHead = 1, kFrame = 2, kEnd = 3, kFailure = 4 };

/// Kind and number of bytes, which stand before a message's bytes.
inline constexpr std::size_t kBagMessageStart = 16;
struct BagMessageHeader {
  BagMessageKind kind = BagMessageKind::kEnd;
  std::uint64_t bytes = 0;
};

std::string encode_request(const BagRequest& request);
/// Each with its kind and number of bytes.
std::string encode_head(const BagHead& head);
std::string encode_frame(const Frame& frame);
std::string encode_end();
std::string encode_failure(const Error& failure);

/// These throw Error{kBadInput} for bytes that are not what the functions above give; none trusts a number in them.
BagRequest decode_request(std::string_view bytes);
BagMessageHeader decode_message_start(std::string_view bytes);
BagHead decode_head(std::string_view bytes);
/// Of a frame's truth nothing is in a message. Points that are not finite and more than a frame holds are refused.
void decode_frame(std::string_view bytes, Frame& frame);
Error decode_failure(std::string_view bytes);

}  // namespace hallway::import
