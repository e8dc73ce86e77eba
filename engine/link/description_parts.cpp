// SPDX-License-Identifier: MIT
#include "link/description_parts.hpp"

#include <hallway/sample.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/bytes.hpp"

namespace hallway::link {
namespace {

// Bits of the first word: what follows.
constexpr std::uint32_t kHasDrive = 1;
constexpr std::uint32_t kHasBody = 2;

/// More than any part that can be written takes.
constexpr std::size_t kMostPartBytes = 1u << 17;

struct PartsHead {
  std::uint32_t flags = 0;
  std::uint32_t drive_kind = 0;
};

struct BodyHead {
  double radius_m = 0;
  double bottom_m = 0;
  double top_m = 0;
};

/// The kind is that of the samples; 0: there are none.
struct IntrinsicsHead {
  std::uint32_t kind = 0;
  std::uint32_t bytes = 0;  ///< with this head, to where the pace begins; 0: there is no pace
};

/// Rate, latency and growth of noise.
struct Pace {
  double rate_hz = 0;
  double latency_s = 0;
  double noise_per_m[3]{};
};

struct ScanNumbers {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t layers = 0;
  std::uint32_t reserved = 0;
  double beam_rad = 0;
  double scan_s = 0;
};

struct OriginNumbers {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double altitude_m = 0;
};

struct ZoneNumbers {
  double middle_rad = 0;
  double width_rad = 0;
  double bottom_m = 0;
  double top_m = 0;
};

template <typename Put>
Bytes written(Put put) {
  Bytes bytes(kMostPartBytes);
  AlignedByteWriter writer(bytes);
  put(writer);
  bytes.resize((writer.size() + 7) / 8 * 8);
  return bytes;
}

bool knows_pace(const host::SensorInfo& sensor) {
  return !std::isnan(sensor.rate_hz) || !std::isnan(sensor.latency_s) ||
         !std::ranges::all_of(sensor.noise_per_m, [](double noise) { return std::isnan(noise); });
}

Bytes intrinsics_bytes(const host::Intrinsics& intrinsics) {
  if (const auto* bump = std::get_if<host::BumpIntrinsics>(&intrinsics)) {
    return written([&](AlignedByteWriter& writer) {
      writer.put(IntrinsicsHead{.kind = HW_SAMPLE_BUMP});
      writer.put(std::uint64_t{bump->zones.size()});
      for (const host::BumpZoneInfo& zone : bump->zones) {
        writer.put(ZoneNumbers{zone.middle_rad, zone.width_rad, zone.bottom_m, zone.top_m});
        writer.put_text(zone.name);
      }
    });
  }
  if (const auto* encoder = std::get_if<host::EncoderIntrinsics>(&intrinsics)) {
    return written([&](AlignedByteWriter& writer) {
      writer.put(IntrinsicsHead{.kind = HW_SAMPLE_ENCODER});
      writer.put_list(encoder->wheels);
    });
  }
  if (const auto* scan = std::get_if<host::RangeScanIntrinsics>(&intrinsics)) {
    return written([&](AlignedByteWriter& writer) {
      writer.put(IntrinsicsHead{.kind = HW_SAMPLE_RANGE_SCAN});
      writer.put(ScanNumbers{.width = scan->width,
                             .height = scan->height,
                             .layers = scan->layers,
                             .beam_rad = scan->beam_rad,
                             .scan_s = scan->scan_s});
    });
  }
  if (const auto* imu = std::get_if<host::ImuIntrinsics>(&intrinsics)) {
    return written([&](AlignedByteWriter& writer) {
      writer.put(IntrinsicsHead{.kind = HW_SAMPLE_IMU});
      for (const host::ImuNumber& number : host::imu_numbers()) writer.put(imu->*number.host);
    });
  }
  if (const auto* gnss = std::get_if<host::GnssIntrinsics>(&intrinsics)) {
    return written([&](AlignedByteWriter& writer) {
      writer.put(IntrinsicsHead{.kind = HW_SAMPLE_GNSS});
      writer.put(OriginNumbers{gnss->latitude_deg, gnss->longitude_deg, gnss->altitude_m});
    });
  }
  return {};
}

bool is_known(std::uint32_t kind) {
  return kind == 0 || kind == HW_SAMPLE_BUMP || kind == HW_SAMPLE_ENCODER || kind == HW_SAMPLE_RANGE_SCAN ||
         kind == HW_SAMPLE_IMU || kind == HW_SAMPLE_GNSS;
}

void read_zones(AlignedByteReader& reader, host::BumpIntrinsics& bump) {
  const std::size_t count = reader.get_count(sizeof(ZoneNumbers) + sizeof(std::uint64_t));
  for (std::size_t i = 0; i < count; ++i) {
    const auto numbers = reader.get<ZoneNumbers>();
    bump.zones.push_back({.name = reader.get_text(),
                          .middle_rad = numbers.middle_rad,
                          .width_rad = numbers.width_rad,
                          .bottom_m = numbers.bottom_m,
                          .top_m = numbers.top_m});
  }
}

void read_intrinsics(std::uint32_t kind, AlignedByteReader& reader, host::Intrinsics& intrinsics) {
  if (kind == HW_SAMPLE_BUMP) {
    read_zones(reader, intrinsics.emplace<host::BumpIntrinsics>());
  } else if (kind == HW_SAMPLE_ENCODER) {
    intrinsics = host::EncoderIntrinsics{.wheels = reader.copy_list<host::EncoderWheel>()};
  } else if (kind == HW_SAMPLE_RANGE_SCAN) {
    const auto numbers = reader.get<ScanNumbers>();
    intrinsics = host::RangeScanIntrinsics{.width = numbers.width,
                                           .height = numbers.height,
                                           .layers = numbers.layers,
                                           .beam_rad = numbers.beam_rad,
                                           .scan_s = numbers.scan_s};
  } else if (kind == HW_SAMPLE_IMU) {
    auto& imu = intrinsics.emplace<host::ImuIntrinsics>();
    for (const host::ImuNumber& number : host::imu_numbers()) imu.*number.host = reader.get<double>();
  } else if (kind == HW_SAMPLE_GNSS) {
    const auto numbers = reader.get<OriginNumbers>();
    intrinsics = host::GnssIntrinsics{.latitude_deg = numbers.latitude_deg,
                                      .longitude_deg = numbers.longitude_deg,
                                      .altitude_m = numbers.altitude_m};
  }
}

}  // namespace

Bytes robot_parts_bytes(const Description& description) {
  if (!description.drive && !description.body) return {};
  return written([&](AlignedByteWriter& writer) {
    writer.put(PartsHead{.flags = (description.drive ? kHasDrive : 0) | (description.body ? kHasBody : 0),
                         .drive_kind = description.drive ? description.drive->kind : 0});
    if (description.drive) {
      for (const host::DriveNumber& number : host::drive_numbers())
        writer.put((*description.drive).*number.host);
    }
    if (description.body) {
      const host::BodyInfo& body = *description.body;
      writer.put(BodyHead{body.radius_m, body.bottom_m, body.top_m});
      writer.put_list(body.corners);
    }
  });
}

void read_robot_parts(std::span<const std::byte> bytes, Description& description) {
  if (bytes.empty()) return;
  AlignedByteReader reader(bytes);
  const auto head = reader.get<PartsHead>();
  if ((head.flags & kHasDrive) != 0) {
    host::DriveInfo& drive = description.drive.emplace();
    drive.kind =
        head.drive_kind < host::kDriveNames.size() ? head.drive_kind : std::uint32_t{HW_DRIVE_UNKNOWN};
    for (const host::DriveNumber& number : host::drive_numbers()) drive.*number.host = reader.get<double>();
  }
  if ((head.flags & kHasBody) != 0) {
    const auto body = reader.get<BodyHead>();
    description.body = {.corners = reader.copy_list<std::array<double, 2>>(),
                        .radius_m = body.radius_m,
                        .bottom_m = body.bottom_m,
                        .top_m = body.top_m};
  }
}

Bytes sensor_parts_bytes(const host::SensorInfo& sensor) {
  Bytes bytes = intrinsics_bytes(sensor.intrinsics);
  if (!knows_pace(sensor)) return bytes;
  if (bytes.empty()) bytes = written([](AlignedByteWriter& writer) { writer.put(IntrinsicsHead{}); });
  const std::size_t at = bytes.size();
  store(bytes.data() + offsetof(IntrinsicsHead, bytes), static_cast<std::uint32_t>(at));
  Pace pace{.rate_hz = sensor.rate_hz, .latency_s = sensor.latency_s};
  std::ranges::copy(sensor.noise_per_m, pace.noise_per_m);
  bytes.resize(at + sizeof pace);
  store(bytes.data() + at, pace);
  return bytes;
}

void read_sensor_parts(std::span<const std::byte> bytes, host::SensorInfo& sensor) {
  if (bytes.empty()) return;
  AlignedByteReader reader(bytes);
  const auto head = reader.get<IntrinsicsHead>();
  const bool has_pace =
      head.bytes >= sizeof head && head.bytes % 8 == 0 && lies_within(head.bytes, sizeof(Pace), bytes.size());
  if (head.bytes != 0 && !has_pace && is_known(head.kind))
    throw BadBytes{"a sensor's rate outside of its bytes"};
  if (has_pace) {
    const auto pace = load<Pace>(bytes.data() + head.bytes);
    sensor.rate_hz = pace.rate_hz;
    sensor.latency_s = pace.latency_s;
    std::ranges::copy(pace.noise_per_m, sensor.noise_per_m);
    reader = AlignedByteReader(bytes.first(head.bytes));
    reader.get<IntrinsicsHead>();
  }
  read_intrinsics(head.kind, reader, sensor.intrinsics);
}

}  // namespace hallway::link
