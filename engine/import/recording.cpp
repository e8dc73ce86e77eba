// SPDX-License-Identifier: MIT
#include "import/recording.hpp"

namespace hallway::import {

const std::optional<std::vector<log::Landmark>>& Recording::true_landmarks() const {
  static const std::optional<std::vector<log::Landmark>> kNone;
  return kNone;
}

std::int64_t mean_period_ns(std::int64_t first_ns, std::int64_t last_ns, std::uint64_t frames,
                            std::int64_t otherwise) {
  if (frames < 2 || last_ns <= first_ns) return otherwise;
  const auto gaps = static_cast<std::int64_t>(frames - 1);
  return (last_ns - first_ns + gaps / 2) / gaps;
}

}  // namespace hallway::import
