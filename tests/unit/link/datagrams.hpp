// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "host/samples/frame_bytes.hpp"
#include "host/samples/point_kind.hpp"
#include "link/datagram.hpp"
#include "link/description.hpp"

namespace hallway::link {

inline Bytes datagram_of(const Header& header, std::span<const std::byte> payload = {}) {
  Bytes bytes;
  write_datagram(header, payload, bytes);
  return bytes;
}

/// Bytes that tell where they stand.
inline Bytes some_bytes(std::size_t size, std::size_t seed = 0) {
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>((i * 131 + i / 251 + seed) & 0xff);
  return bytes;
}

/// The bytes of a frame with as many points.
inline Bytes frame_of(std::uint64_t sequence, std::size_t points, std::int64_t t_ns) {
  host::FrameBuilder builder;
  builder.begin(sequence, t_ns);
  std::vector<hw_point3_t>& list = add_points(builder, 0);
  for (std::size_t i = 0; i < points; ++i) list.push_back({double(i), double(sequence), 0.5});
  const hw_frame_t& frame = builder.finish();
  Bytes bytes;
  host::FrameWriter().write_over(bytes, frame);
  return bytes;
}

/// The datagrams of a message.
inline std::vector<Bytes> datagrams_of(Header header, std::span<const std::byte> message) {
  std::vector<Bytes> datagrams;
  header.fragments = static_cast<std::uint16_t>(fragments_of(message.size()));
  for (; header.fragment < header.fragments; ++header.fragment) {
    datagrams.push_back(datagram_of(header, fragment_of(message, header.fragment)));
  }
  return datagrams;
}

inline Description description(bool lock_step) {
  Description description;
  description.lock_step = lock_step;
  description.period_ns = 100'000'000;
  description.name = "office";
  host::SensorInfo sensor = host::point_sensor("eyes");
  sensor.horizontal_fov = 1.5;
  description.sensors.push_back(sensor);
  return description;
}

}  // namespace hallway::link
