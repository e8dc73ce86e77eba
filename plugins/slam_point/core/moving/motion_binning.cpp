// SPDX-License-Identifier: MIT
#include "slam_point/core/moving/motion_binning.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace hallway::slam_point {
namespace {

/// The bins while they grow.
class Bins {
 public:
  Bins(std::size_t points, const BinningRules& rules,
       const std::function<double(std::uint32_t, std::uint32_t)>& deviation)
      : rules_(rules), deviation_(deviation), members_(points), apart_(points) {
    for (std::uint32_t p = 0; p < points; ++p) {
      members_[p] = {p};
      valid_.push_back(p);
    }
  }

  BinningResult run() {
    first_round();
    while (!has_enough() && next_round()) {
    }
    if (has_enough()) compare_rest();
    return result();
  }

 private:
  bool alive(std::uint32_t bin) const { return !members_[bin].empty(); }

  double ask(std::uint32_t a, std::uint32_t b) {
    ++comparisons_;
    return deviation_(std::min(a, b), std::max(a, b));
  }

  /// Pairs of neighbours; the threshold follows from what they give, and then they are joined or not.
  void first_round() {
    std::vector<double> deviations;
    for (std::uint32_t p = 0; p + 1 < members_.size(); p += 2) deviations.push_back(ask(p, p + 1));
    threshold_m_ = rules_.threshold_m > 0.0 ? rules_.threshold_m : find_threshold(deviations);
    std::vector<std::uint32_t> joined;
    std::vector<std::uint32_t> rest;
    for (std::uint32_t p = 0; p < members_.size(); p += 2) {
      if (p + 1 == members_.size()) {
        rest.push_back(p);
      } else if (settle(p, p + 1, deviations[p / 2])) {
        joined.push_back(p);
      } else {
        rest.insert(rest.end(), {p, p + 1});
      }
    }
    take_turns(joined, rest);
  }

  double find_threshold(std::vector<double> deviations) const {
    if (deviations.empty()) return 0.0;
    std::sort(deviations.begin(), deviations.end());
    for (std::size_t i = 0; i + 1 < deviations.size(); ++i) {
      const double gap = deviations[i + 1] - deviations[i];
      if (gap > rules_.gap_m && gap > rules_.gap_share * deviations[i])
        return deviations[i] + rules_.gap_place * gap;
    }
    return deviations.back();
  }

  /// Joins two bins or notes that they are apart, by their deviation. Returns whether they were joined, into the lower one.
  bool settle(std::uint32_t a, std::uint32_t b, double deviation_m) {
    const std::uint32_t into = std::min(a, b);
    const std::uint32_t from = std::max(a, b);
    if (deviation_m > threshold_m_) {
      apart_[into].insert(from);
      apart_[from].insert(into);
      return false;
    }
    members_[into].insert(members_[into].end(), members_[from].begin(), members_[from].end());
    members_[from].clear();
    most_ = std::max(most_, members_[into].size());
    for (const std::uint32_t other : apart_[from]) {
      apart_[other].erase(from);
      apart_[other].insert(into);
      apart_[into].insert(other);
    }
    apart_[from].clear();
    return true;
  }

  /// Some bins compare themselves with the next one that they were not compared with. False when there was nothing left to compare.
  bool next_round() {
    std::vector<std::uint32_t> joined;
    std::vector<std::uint32_t> rest;
    bool compared = false;
    const std::size_t turns = turns_;
    for (std::size_t i = 0; i < valid_.size(); ++i) {
      const std::uint32_t bin = valid_[i];
      if (!alive(bin)) continue;
      if (i >= turns) {
        rest.push_back(bin);
        continue;
      }
      const std::uint32_t other = find_partner(i);
      if (other == bin) {
        // Done, but others may still come to it.
        rest.push_back(bin);
        continue;
      }
      compared = true;
      if (settle(bin, other, ask(bin, other))) {
        joined.push_back(std::min(bin, other));
      } else {
        rest.push_back(bin);
      }
      if (has_enough()) return true;
    }
    // With none left among those that came first, all get a turn.
    if (!compared && turns < valid_.size()) {
      turns_ = valid_.size();
      return true;
    }
    take_turns(joined, rest);
    return compared;
  }

  /// The next bin in the list, round its end, that is not known to be apart from the one at `i`; that one itself if there is none.
  std::uint32_t find_partner(std::size_t i) const {
    const std::uint32_t bin = valid_[i];
    for (std::size_t step = 1; step < valid_.size(); ++step) {
      const std::uint32_t other = valid_[(i + step) % valid_.size()];
      if (other != bin && alive(other) && !apart_[bin].contains(other)) return other;
    }
    return bin;
  }

  void take_turns(const std::vector<std::uint32_t>& joined, const std::vector<std::uint32_t>& rest) {
    valid_.clear();
    std::vector<std::uint8_t> listed(members_.size(), 0);
    const auto append = [&](std::uint32_t bin) {
      if (!alive(bin) || listed[bin] != 0) return;
      listed[bin] = 1;
      valid_.push_back(bin);
    };
    for (const std::uint32_t bin : joined) append(bin);
    const std::size_t first = valid_.size();
    for (const std::uint32_t bin : rest) append(bin);
    if (!rules_.priority) std::sort(valid_.begin(), valid_.end());
    turns_ = rules_.priority && first > 0 ? first : valid_.size();
  }

  std::uint32_t largest() const {
    std::uint32_t best = 0;
    for (std::uint32_t bin = 1; bin < members_.size(); ++bin) {
      if (members_[bin].size() > members_[best].size()) best = bin;
    }
    return best;
  }

  bool has_enough() const {
    return static_cast<double>(most_) > rules_.enough_share * static_cast<double>(members_.size());
  }

  void compare_rest() {
    std::uint32_t most = largest();
    for (std::uint32_t bin = 0; bin < members_.size(); ++bin) {
      if (bin == most || !alive(bin) || apart_[most].contains(bin)) continue;
      if (settle(most, bin, ask(most, bin))) most = std::min(most, bin);
    }
  }

  BinningResult result() const {
    BinningResult result;
    result.bin_of.resize(members_.size());
    for (std::uint32_t bin = 0; bin < members_.size(); ++bin) {
      for (const std::uint32_t point : members_[bin]) result.bin_of[point] = bin;
    }
    result.largest = members_.empty() ? 0 : largest();
    result.threshold_m = threshold_m_;
    result.comparisons = comparisons_;
    return result;
  }

  const BinningRules& rules_;
  const std::function<double(std::uint32_t, std::uint32_t)>& deviation_;
  std::vector<std::vector<std::uint32_t>>
      members_;                                 // by bin, named by its lowest point; empty: joined to another
  std::vector<std::set<std::uint32_t>> apart_;  // bins that a bin was compared with and is not rigid against
  std::vector<std::uint32_t> valid_;
  std::size_t most_ = 0;   // points of the largest bin that was joined from others
  std::size_t turns_ = 0;  // of valid_, how many may begin a comparison in the next round
  double threshold_m_ = 0.0;
  std::uint64_t comparisons_ = 0;
};

}  // namespace

BinningResult bin_points(std::size_t points, const BinningRules& rules,
                         const std::function<double(std::uint32_t, std::uint32_t)>& deviation) {
  return Bins(points, rules, deviation).run();
}

double distance_deviation(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  const std::size_t frames = std::min(a.size(), b.size());
  if (frames < 2) return 0.0;
  double mean = 0.0;
  for (std::size_t f = 0; f < frames; ++f) mean += (a[f] - b[f]).norm() / static_cast<double>(frames);
  double squares = 0.0;
  for (std::size_t f = 0; f < frames; ++f) {
    const double off = (a[f] - b[f]).norm() - mean;
    squares += off * off;
  }
  return std::sqrt(squares / static_cast<double>(frames - 1));
}

}  // namespace hallway::slam_point
