// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "slam_plane/core/options.hpp"
#include "slam_plane/core/sighting.hpp"

namespace hallway::slam_plane {

/// Tells corners from cuts. The end of a piece is a cut, made by the view's border or by something in front, when it lies within
/// a few standard deviations of that border or of the end of a nearer piece at the same bearing. All others are corners.
/// Taking a corner for a cut costs little; the other way is ruinous, so doubts are cuts.
class CornerJudge {
 public:
  explicit CornerJudge(const Options& options);

  /// Sets Sighting::corner and hidden of all. O(n log n) in the pieces of a frame, unless many are so
  /// near that their ends may be at any bearing.
  void judge(const View& view, std::vector<Sighting>& frame) const;

 private:
  struct EndView {
    double bearing = 0.0;  // [rad]
    double range = 0.0;    // [m]
    double sigma = 0.0;    // of the end's place across its wall, and along it [m]
  };

  EndView view_end(const Sighting& sighting, int end) const;
  bool at_border(const View& view, const Sighting& sighting, int end, const EndView& seen) const;
  bool behind_end(const EndView& seen, const EndView& other) const;
  bool is_hidden(std::size_t end) const;

  Noise noise_;
  double sigmas_;
  double margin_;
  mutable std::vector<EndView> ends_;  // two for each piece
  mutable double widest_ = 0.0;        // standard deviation of a bearing [rad]
  mutable std::vector<std::size_t> by_bearing_;
  mutable std::vector<std::size_t> place_;  // of an end in by_bearing_
};

}  // namespace hallway::slam_plane
