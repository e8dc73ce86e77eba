// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <numbers>
#include <vector>

#include "slam_point/core/fit/motion_consensus.hpp"
#include "slam_point/core/fit/robust_fit.hpp"
#include "slam_point/core/moving/sighting_history.hpp"

namespace hallway::slam_point {

/// Decides from what frames saw whether a landmark has moved against the largest set of landmarks that kept their shape
/// (thesis 6.5.3 asks the same of the distances of all pairs).
///
/// Two short blocks of frames are taken, some time apart. Each frame of the later block is laid on one of the earlier by a
/// robust fit of the landmarks that both saw, suspects aside; where many are suspected, by the motion that most of all agree on, and if fewer
/// than half do, not at all. What a landmark is then away from where it was, averaged over the
/// block, is compared with its own scatter, with the sensor's noise, and with what the other landmarks do. No map, no
/// earlier fit and no sensor pose enters, so that neither drift nor a loop that closes looks like motion.
class MotionVerdict {
 public:
  struct Suspect {
    Index landmark = kNone;
    std::uint64_t since = 0;    ///< frames before this one do not count
    std::uint32_t attempt = 0;  ///< how often it was judged: the time between the blocks changes with it
  };
  enum class Finding { stands, moves, open };

  explicit MotionVerdict(double noise_m) : noise_m_(noise_m), consensus_(std::numbers::sqrt2 * noise_m) {}

  /// Judges the suspects by the newest frame of `history` and those before it. All that are judged need the same time between the
  /// blocks as the first; the others stay open, as do those of which too little was seen. At most kMostPairs fits of some
  /// hundred landmarks each, and as many looks at the points in view.
  void judge(const SightingHistory& history, const std::vector<Suspect>& suspects, bool planar,
             std::vector<Finding>& findings);

  static constexpr int kMostPairs = 8;

 private:
  /// What one landmark did from the earlier block to the later one, in units of its own noise times noise_m_.
  struct Shift {
    Vec3 sum = Vec3::Zero();
    double squares = 0.0;
    int count = 0;
    bool suspect = false;
    std::uint64_t session = 0;
  };
  /// A landmark that both frames of a pair saw.
  struct Common {
    Index landmark = kNone;
    Vec3 earlier = Vec3::Zero();
    Vec3 later = Vec3::Zero();
    double weight = 1.0;
  };

  void begin_session(const SightingHistory& history, const std::vector<Suspect>& suspects);
  bool is_asked(Index landmark) const;
  Shift& shift_of(Index landmark);
  bool add_pair(const SightingHistory& history, std::uint64_t earlier, std::uint64_t later);
  void find_common(const SightingHistory& history, std::uint64_t earlier, std::uint64_t later);
  bool fit(const Pose& guess, Pose& T_earlier_later);
  double usual_variance(int pairs);
  Finding finding(const Shift& shift, int pairs, double usual) const;

  double noise_m_;
  MotionConsensus consensus_;
  FitRules rules_;  // of this session
  std::uint64_t session_ = 0;
  std::uint64_t stamp_ = 0;
  std::uint32_t witness_step_ = 1;      // of so many landmarks above suspicion one is asked
  std::vector<Shift> shifts_;           // by landmark; those of this session count
  std::vector<Index> touched_;          // landmarks of this session
  std::vector<std::uint64_t> stamped_;  // landmark -> stamp_ when the later frame saw it
  std::vector<Vec3> later_point_;       // landmark -> where, valid where stamped
  std::vector<Common> common_;
  std::vector<Pair> pairs_;
  std::vector<double> lengths2_;
};

}  // namespace hallway::slam_point
