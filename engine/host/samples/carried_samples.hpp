// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/sample.h>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "host/samples/frame_bytes.hpp"
#include "host/samples/sample_selection.hpp"

namespace hallway::host {

/// Where a host drops frames, it keeps the samples of which none may be missed (SampleKind::carried): they go into the next frame.
class CarriedSamples {
 public:
  /// How many samples a frame may have with those that are carried into it. Of more the oldest are left out, which shows as a gap in their
  /// numbers.
  static constexpr std::size_t kMaxSamples = 10'000;

  /// Puts the carried samples of a frame that is dropped into a later one, each before the samples of its sensor that are there. Bytes that are no frame
  /// stay as they are, and so does a frame that would have more than kMaxFrameBytes. O(bytes of both) where `dropped` has carried samples; O(1) where the
  /// table has no kind that is carried.
  /// @tparam Bytes  a container of bytes or characters
  /// @return how many samples were put
  template <typename Bytes>
  std::size_t carry(const Bytes& dropped, Bytes& next) {
    const std::size_t size =
        merge(std::as_bytes(std::span(dropped)), std::as_bytes(std::span(std::as_const(next))));
    if (size == 0) return 0;
    Bytes bytes;
    bytes.resize(size);
    writer_.write(std::as_writable_bytes(std::span(bytes)));
    next = std::move(bytes);
    return carried_.size();
  }

 private:
  std::size_t merge(std::span<const std::byte> dropped, std::span<const std::byte> next);
  void put_together();
  void find_carried(const hw_frame_t& dropped);
  void leave_out(std::size_t n_oldest);

  FrameReader dropped_;
  FrameReader next_;
  FrameWriter writer_;
  std::vector<const hw_sample_t*> carried_;
  std::vector<const hw_sample_t*> samples_;  ///< of the merged frame
  std::vector<std::uint32_t> places_;        ///< where the samples of the later frame are in it
  RenumberedSamples renumbered_;
  hw_frame_t merged_{};
};

}  // namespace hallway::host
