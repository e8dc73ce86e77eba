// SPDX-License-Identifier: MIT
// Linked into a program, it adds the row to the program's table.
#include "support/made_up_kind.hpp"

#include <cstddef>
#include <span>

#include "host/samples/strided.hpp"

namespace hallway::test {
namespace {

void check_made_up(void* payload, const host::CheckedSample&) {
  const auto& made_up = *static_cast<const MadeUp*>(payload);
  if (made_up.marks == nullptr) return;
  for (const std::uint32_t mark : std::span(made_up.marks, made_up.n_marks))
    host::demand(mark < made_up.n_rays, "a mark of no ray");
}

using host::NumberType;

constexpr host::PayloadMember kRay[] = {
    {.name = "azimuth", .type = NumberType::kF64, .offset = offsetof(MadeUpRay, azimuth)},
    {.name = "range", .type = NumberType::kF64, .offset = offsetof(MadeUpRay, range)}};
constexpr host::PayloadMember kMark[] = {{.name = "", .type = NumberType::kU32, .offset = 0}};
constexpr host::PayloadMember kTrack[] = {
    {.name = "", .type = NumberType::kU64, .offset = 0, .may_be_none = true}};
constexpr host::PayloadMember kMadeUp[] = {
    {.name = "temperature", .type = NumberType::kF64, .offset = offsetof(MadeUp, temperature)}};

constexpr host::PayloadArray kMadeUpArrays[] = {{.name = "rays",
                                                 .one = "ray",
                                                 .data = offsetof(MadeUp, rays),
                                                 .count = offsetof(MadeUp, n_rays),
                                                 .stride = offsetof(MadeUp, stride),
                                                 .element_bytes = sizeof(MadeUpRay),
                                                 .n_finite = 2,
                                                 .members = kRay},
                                                {.name = "marks",
                                                 .one = "mark",
                                                 .data = offsetof(MadeUp, marks),
                                                 .count = offsetof(MadeUp, n_marks),
                                                 .element_bytes = sizeof(std::uint32_t),
                                                 .optional = true,
                                                 .checked = true,
                                                 .members = kMark},
                                                {.name = "tracks",
                                                 .one = "track",
                                                 .data = offsetof(MadeUp, tracks),
                                                 .count = offsetof(MadeUp, n_rays),
                                                 .element_bytes = sizeof(std::uint64_t),
                                                 .optional = true,
                                                 .members = kTrack}};

}  // namespace

constexpr host::SampleKind kMadeUpKind{.kind = kMadeUpSample,
                                       .name = "made_up",
                                       .payload = "hw_made_up_t",
                                       .size = sizeof(MadeUp),
                                       .min_size = sizeof(MadeUp),
                                       .arrays = kMadeUpArrays,
                                       .track = offsetof(MadeUp, tracks),
                                       .check = &check_made_up,
                                       .carried = true,
                                       .members = kMadeUp};

namespace {
const host::AddedSampleKind kAdded(kMadeUpKind);
}

}  // namespace hallway::test
