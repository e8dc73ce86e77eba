// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "base/spill_list.hpp"
#include "geometry/se3.hpp"
#include "log/map_landmarks.hpp"

namespace hallway::eval {

/// The path as the map at the end shows it: each frame placed anew where its points, as the plugin associated them while the
/// run went on, lie best on the landmarks of that map. Keeps the points until then, for at most kMaxPoints: in a folder, if there is one.
class RefittedPath {
 public:
  /// @param folder  see SpillList, as all that throws
  explicit RefittedPath(const std::filesystem::path& folder = {})
      : folder_(folder), sights_(folder), frames_(folder) {}

  /// Above so many points nothing is kept and no error is known.
  static constexpr std::size_t kMaxPoints = std::size_t{1} << 23;

  /// Adds a frame whose true position is known. `points`: body frame [m]; as long as `associations`.
  void add(const Vec3& true_position, std::span<const Vec3> points,
           std::span<const log::LandmarkId> associations);

  struct Error {
    std::uint64_t frames = 0;  ///< those placed
    std::optional<double>
        aligned_m;  ///< root mean square position error after the best rigid fit; from three frames on
  };
  /// The error of the positions of all frames that `map` places: three points or more on its mapped landmarks, neither all near
  /// one line nor their landmarks (the second principal extent is at least a hundredth of the first). A landmark that rests on n observations
  /// has the weight n / (n + 1): what the point's noise and its own leave of it. Empty beyond kMaxPoints. O(points).
  std::optional<Error> error(std::span<const log::MapLandmark> map) const;

 private:
  struct Sight {
    log::LandmarkId landmark = 0;
    std::array<double, 3> point{};
  };
  struct Frame {
    std::array<double, 3> true_position{};
    std::uint64_t end = 0;  // of its sights
  };
  std::filesystem::path folder_;
  SpillList<Sight> sights_;
  SpillList<Frame> frames_;
  bool complete_ = true;
};

}  // namespace hallway::eval
