// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/error.hpp"

namespace hallway::log {

/// The highest iteration number that a log may name. Higher ones are damage, such as a time stamp in the wrong column.
inline constexpr std::uint32_t kMaxIteration = 99'999'999;

/// What was seen in a run, frame by frame; a frame's elements keep their order. Memory grows with the elements, not with the
/// iteration numbers.
template <typename Element>
class FrameList {
 public:
  /// One more than the last iteration that was added, 0 before the first.
  std::uint32_t iterations() const { return iterations_; }
  /// All elements, in the order of the frames.
  std::span<const Element> all() const { return elements_; }
  /// The iterations that have elements, increasing.
  std::span<const std::uint32_t> filled_iterations() const { return filled_; }

  /// The elements of an iteration; empty where there are none and after the end. O(log iterations).
  std::span<const Element> frame(std::uint32_t iteration) const {
    const auto found = std::lower_bound(filled_.begin(), filled_.end(), iteration);
    if (found == filled_.end() || *found != iteration) return {};
    const auto place = static_cast<std::size_t>(found - filled_.begin());
    const std::size_t end = place + 1 < begin_.size() ? begin_[place + 1] : elements_.size();
    return std::span(elements_).subspan(begin_[place], end - begin_[place]);
  }

  /// Adds the next frame, which may be empty. Iterations left out are empty frames. Throws Error{kInternal} if
  /// `iteration` is not above all earlier ones or is above kMaxIteration.
  void add_frame(std::uint32_t iteration, std::span<const Element> elements) {
    if (iteration > kMaxIteration || iteration < iterations_) {
      throw Error(ErrorCode::kInternal,
                  fmt::format("an observation log cannot take iteration {} now", iteration));
    }
    iterations_ = iteration + 1;
    if (elements.empty()) return;
    filled_.push_back(iteration);
    begin_.push_back(elements_.size());
    elements_.insert(elements_.end(), elements.begin(), elements.end());
  }

 private:
  std::uint32_t iterations_ = 0;
  std::vector<Element> elements_;
  std::vector<std::uint32_t> filled_;
  std::vector<std::size_t> begin_;  ///< by place in filled_: where its elements begin
};

}  // namespace hallway::log
