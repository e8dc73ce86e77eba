// SPDX-License-Identifier: MIT
#include "link/description_parts.hpp"

#include <hallway/sample.h>

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

/// The kind is that of the samples.
struct IntrinsicsHead {
  std::uint32_t kind = 0;
  std::uint32_t reserved = 0;
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
  return {};
}

void read_intrinsics(std::span<const std::byte> bytes, host::SensorInfo& sensor) {
  if (bytes.empty()) return;
  AlignedByteReader reader(bytes);
  const auto head = reader.get<IntrinsicsHead>();
  if (head.kind == HW_SAMPLE_BUMP) {
    host::BumpIntrinsics bump;
    const std::size_t count = reader.get_count(sizeof(ZoneNumbers) + sizeof(std::uint64_t));
    for (std::size_t i = 0; i < count; ++i) {
      const auto numbers = reader.get<ZoneNumbers>();
      bump.zones.push_back({.name = reader.get_text(),
                            .middle_rad = numbers.middle_rad,
                            .width_rad = numbers.width_rad,
                            .bottom_m = numbers.bottom_m,
                            .top_m = numbers.top_m});
    }
    sensor.intrinsics = std::move(bump);
  } else if (head.kind == HW_SAMPLE_ENCODER) {
    sensor.intrinsics = host::EncoderIntrinsics{.wheels = reader.copy_list<host::EncoderWheel>()};
  }
}

}  // namespace hallway::link
