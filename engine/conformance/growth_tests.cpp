// SPDX-License-Identifier: MIT
// Hosts of later minor versions, whose structs are larger and whose flags are more.
#include <string>

#include "conformance/instance.hpp"
#include "conformance/walk.hpp"

namespace hallway::conformance {
namespace {

constexpr std::uint32_t kGrowth = 48;
constexpr std::uint64_t kGrowthFrames = 4;
constexpr std::uint32_t kUnknownFlag = 1u << 31;

/// What is put for a few frames by a new plugin of a host that is as the shapes say.
std::string put_by(const LoadedLibrary& library, const Subject& subject, const InputShape& shape,
                   const HostShape& host = {}, std::uint32_t sample_flags = 0) {
  Instance plugin(library, subject, host);
  plugin.activate(plugin.ordinary().sensors(), shape).demand_good();
  std::string bytes;
  for (std::uint64_t step = 0; step < kGrowthFrames; ++step) {
    Frame frame = plugin.ordinary().frame(step);
    for (Reading& reading : frame.readings) reading.flags = sample_flags;
    bytes += plugin.process(frame, shape).bytes();
  }
  return bytes + plugin.report(0).bytes();
}

void compare(const Subject& subject, const std::string& what, const InputShape& shape,
             const HostShape& host = {}, std::uint32_t sample_flags = 0) {
  const LoadedLibrary library(subject.file);
  demand_same(put_by(library, subject, shape, host, sample_flags), put_by(library, subject, {}), what);
}

void takes_a_larger_frame(const Subject& subject) {
  compare(subject, "a larger hw_frame_t changes the answer", {.frame_growth = kGrowth});
}
void takes_a_larger_sample(const Subject& subject) {
  compare(subject, "a larger hw_sample_t changes the answer", {.sample_growth = kGrowth});
}
void takes_larger_payloads(const Subject& subject) {
  compare(subject, "a larger payload of a sample (hw_points_t, ...) changes the answer",
          {.payload_growth = kGrowth});
}
void takes_older_payloads(const Subject& subject) {
  constexpr std::uint32_t kMost = 4;  // arrays that hw_points_t did not have once
  for (std::uint32_t n = 1; n <= kMost; ++n) {
    compare(subject, "a payload of an older version changes the answer",
            {.without_arrays = n, .tight = true});
  }
}
void honours_the_stride(const Subject& subject) {
  compare(subject, "a larger stride changes the answer", {.stride_growth = 16});
}
void takes_a_larger_activation(const Subject& subject) {
  compare(subject, "a larger hw_activation_t changes the answer", {.activation_growth = kGrowth});
}
void takes_a_larger_sensor(const Subject& subject) {
  compare(subject, "a larger hw_sensor_info_t changes the answer", {.sensor_growth = kGrowth});
}
void takes_a_larger_drive(const Subject& subject) {
  compare(subject, "a larger hw_drive_info_t changes the answer", {.drive_growth = kGrowth});
}
void takes_a_larger_body(const Subject& subject) {
  compare(subject, "a larger hw_body_info_t changes the answer", {.body_growth = kGrowth});
}
void takes_larger_intrinsics(const Subject& subject) {
  compare(subject, "larger intrinsics (hw_encoder_info_t, ...) change the answer",
          {.intrinsics_growth = kGrowth});
}
void takes_a_larger_host(const Subject& subject) {
  compare(subject, "a larger hw_host_t changes the answer", {}, {.growth = kGrowth});
}
void ignores_unknown_flags(const Subject& subject) {
  compare(subject, "an unknown flag of a sample changes the answer", {}, {}, kUnknownFlag);
}
void ignores_reserved_members(const Subject& subject) {
  compare(subject, "a reserved member that is not 0 changes the answer", {.reserved = 0xdeadbeef},
          {.reserved = 0xdeadbeef});
}

/// Throws Failed unless report() gives the same for an unusual request.
void compare_reports(const Subject& subject, const std::string& what, std::uint32_t flags,
                     std::uint32_t growth) {
  Active plugin(subject);
  plugin.walk(0, kGrowthFrames);
  const Answer plain = plugin.report(0);
  const Answer unusual = plugin.report(flags, growth);
  demand_same(unusual.bytes(), plain.bytes(), what);
}

void takes_a_larger_request(const Subject& subject) {
  compare_reports(subject, "a larger hw_report_request_t changes the report", 0, kGrowth);
}
void ignores_unknown_requests(const Subject& subject) {
  compare_reports(subject, "an unknown flag of a request changes the report", kUnknownFlag, 0);
}

constexpr Test kGrowthTests[] = {
    {"grown-frame", "A hw_frame_t of a later version, which is larger, is read as today's.",
     takes_a_larger_frame},
    {"grown-sample", "A hw_sample_t of a later version, which is larger, is read as today's.",
     takes_a_larger_sample},
    {"grown-points",
     "The payload of a sample (hw_points_t, ...) of a later version, which is larger, is read as today's.",
     takes_larger_payloads},
    {"older-points",
     "Members that the payload of a sample (hw_points_t, ...) did not have in older versions are not read "
     "where they are not there.",
     takes_older_payloads},
    {"grown-activation", "A hw_activation_t of a later version, which is larger, is read as today's.",
     takes_a_larger_activation},
    {"grown-sensor", "A hw_sensor_info_t of a later version, which is larger, is read as today's.",
     takes_a_larger_sensor},
    {"grown-drive", "A hw_drive_info_t of a later version, which is larger, is read as today's.",
     takes_a_larger_drive},
    {"grown-body", "A hw_body_info_t of a later version, which is larger, is read as today's.",
     takes_a_larger_body},
    {"grown-intrinsics",
     "Intrinsics of a sensor (hw_encoder_info_t, ...) of a later version, which are larger, are read as "
     "today's.",
     takes_larger_intrinsics},
    {"grown-request", "A hw_report_request_t of a later version, which is larger, is read as today's.",
     takes_a_larger_request},
    {"grown-host", "A hw_host_t of a later version, which is larger, is read as today's.",
     takes_a_larger_host},
    {"stride", "Elements of a sample stand as far apart as their stride says.", honours_the_stride},
    {"unknown-sample-flags", "Flags of a sample that the plugin does not know are ignored.",
     ignores_unknown_flags},
    {"unknown-request-flags", "Flags of a report that the plugin does not know are ignored.",
     ignores_unknown_requests},
    {"reserved-members", "Members called `reserved` are not read.", ignores_reserved_members},
};

}  // namespace

std::span<const Test> growth_tests() {
  return kGrowthTests;
}

}  // namespace hallway::conformance
