// SPDX-License-Identifier: MIT
// The bytes as those of a frame. Whatever they are, they are refused, or are a frame that can be written, read again and written as the same bytes; a plugin's
// selection of it too, and what is carried from it into the next frame. The made-up kind of the tests is known.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "host/samples/carried_samples.hpp"
#include "host/samples/frame_bytes.hpp"
#include "host/samples/sample_kind.hpp"
#include "host/samples/sample_selection.hpp"

using namespace hallway::host;
using Bytes = std::vector<std::byte>;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

/// A sound frame can be written, and its bytes are read back as what was written.
Bytes checked_bytes(const hw_frame_t& frame) {
  Bytes bytes, again;
  FrameWriter().write_over(bytes, frame);
  FrameReader reader;
  const hw_frame_t& back = reader.read(bytes);
  if (back.n_samples != frame.n_samples || back.sequence != frame.sequence) std::abort();
  FrameWriter().write_over(again, back);
  if (again != bytes) std::abort();
  return bytes;
}

void check(const hw_frame_t& frame) {
  std::uint32_t n_carried = 0;
  for (std::uint32_t i = 0; i < frame.n_samples; ++i) {
    const hw_sample_t& sample = *frame.samples[i];
    if (!count_elements(sample) || sample.t_end_ns < sample.t_begin_ns) std::abort();
    find_not_finite(sample);
    n_carried += find_sample_kind(sample.kind)->carried ? 1u : 0u;
  }
  const Bytes bytes = checked_bytes(frame);
  for (const SampleKind* kind : sample_kinds()) {
    SampleSelection selection;
    checked_bytes(selection.select(frame, std::array{kind->kind}));
  }
  if (frame.n_samples + n_carried > CarriedSamples::kMaxSamples) return;
  Bytes next = bytes;
  if (CarriedSamples().carry(bytes, next) != n_carried) std::abort();
  FrameReader reader;
  if (reader.read(next).n_samples != frame.n_samples + n_carried) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FrameReader reader;
  const hw_frame_t* frame = nullptr;
  try {
    frame = &reader.read(std::as_bytes(std::span(data, size)));
  } catch (const hallway::Error&) {
    return 0;
  }
  check(*frame);
  return 0;
}
