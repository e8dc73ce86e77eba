// SPDX-License-Identifier: MIT
#include "import/bag_protocol.hpp"

#include <algorithm>
#include <cmath>

#include "base/bytes.hpp"
#include "base/text.hpp"
#include "import/point_collector.hpp"

namespace hallway::import {
namespace {

constexpr std::size_t kMaxTextBytes = 65'536;

[[noreturn]] void refuse(const std::string& cause) {
  throw Error(ErrorCode::kBadInput, "the bag reader sent what cannot be read: " + cause);
}

/// What `put` puts, as text.
template <typename Put>
std::string bytes_of(Put&& put) {
  AlignedByteWriter measure({});
  put(measure);
  std::string bytes(measure.size(), '\0');
  AlignedByteWriter writer(std::as_writable_bytes(std::span(bytes)));
  put(writer);
  return bytes;
}

template <typename Put>
std::string message_of(BagMessageKind kind, Put&& put) {
  const std::string body = bytes_of(put);
  return bytes_of([&](AlignedByteWriter& out) {
           out.put(kind);
           out.put<std::uint64_t>(body.size());
         }) +
         body;
}

/// What `get` takes off the bytes, all of which belong to it.
template <typename Get>
auto taken_from(std::string_view bytes, Get&& get) {
  try {
    AlignedByteReader reader(std::as_bytes(std::span(bytes)));
    auto value = get(reader);
    reader.expect_end();
    return value;
  } catch (const BadBytes& bad) {
    refuse(bad.what);
  }
}

}  // namespace

std::string encode_request(const BagRequest& request) {
  return bytes_of([&](AlignedByteWriter& out) {
    out.put_text(request.file);
    out.put_text(request.topic);
    out.put_text(request.truth_topic);
    out.put(request.stride);
  });
}

BagRequest decode_request(std::string_view bytes) {
  return taken_from(bytes, [](AlignedByteReader& in) {
    BagRequest request;
    request.file = in.get_text();
    request.topic = in.get_text();
    request.truth_topic = in.get_text();
    request.stride = std::max(1u, in.get<std::uint32_t>());
    return request;
  });
}

std::string encode_head(const BagHead& head) {
  return message_of(BagMessageKind::kHead, [&](AlignedByteWriter& out) {
    out.put_text(head.topic);
    out.put(head.frames);
    out.put(head.first_ns);
    out.put(head.last_ns);
    out.put_list(head.truth);
  });
}

BagHead decode_head(std::string_view bytes) {
  return taken_from(bytes, [](AlignedByteReader& in) {
    BagHead head;
    head.topic = in.get_text();
    head.frames = in.get<std::uint64_t>();
    head.first_ns = in.get<std::int64_t>();
    head.last_ns = in.get<std::int64_t>();
    head.truth = in.copy_list<BagPose>();
    return head;
  });
}

std::string encode_frame(const Frame& frame) {
  return message_of(BagMessageKind::kFrame, [&](AlignedByteWriter& out) {
    out.put(frame.t_ns);
    out.put(frame.not_finite);
    out.put_list(frame.points);
  });
}

void decode_frame(std::string_view bytes, Frame& frame) {
  taken_from(bytes, [&](AlignedByteReader& in) {
    frame.t_ns = in.get<std::int64_t>();
    frame.not_finite = in.get<std::uint64_t>();
    frame.points = in.copy_list<std::array<double, 3>>();
    return true;
  });
  const bool finite = std::all_of(frame.points.begin(), frame.points.end(), [](const auto& point) {
    return std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]);
  });
  if (!finite || frame.points.size() > kMaxFramePoints || frame.t_ns < 0) refuse("a frame that is none");
}

std::string encode_end() {
  return message_of(BagMessageKind::kEnd, [](AlignedByteWriter&) {});
}

std::string encode_failure(const Error& failure) {
  return message_of(BagMessageKind::kFailure, [&](AlignedByteWriter& out) {
    out.put<std::uint64_t>(failure.code() == ErrorCode::kUsage ? 1 : 0);
    out.put_text(std::string_view(failure.message()).substr(0, kMaxTextBytes));
    out.put_text(std::string_view(failure.where().element).substr(0, kMaxTextBytes));
  });
}

Error decode_failure(std::string_view bytes) {
  return taken_from(bytes, [](AlignedByteReader& in) {
    const ErrorCode code = in.get<std::uint64_t>() == 1 ? ErrorCode::kUsage : ErrorCode::kBadInput;
    const std::string message = printable(in.get_text(), kMaxTextBytes);
    return Error(code, message, {.element = printable(in.get_text(), kMaxTextBytes)});
  });
}

BagMessageHeader decode_message_start(std::string_view bytes) {
  const BagMessageHeader header = taken_from(bytes, [](AlignedByteReader& in) {
    BagMessageHeader read;
    read.kind = in.get<BagMessageKind>();
    read.bytes = in.get<std::uint64_t>();
    return read;
  });
  if (header.bytes > kMaxBagMessageBytes) refuse("a message that is too long");
  return header;
}

}  // namespace hallway::import
