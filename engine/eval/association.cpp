// SPDX-License-Identifier: MIT
#include "eval/association.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <tuple>

namespace hallway::eval {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// The times of both sides in one list, of which neighbours leave in pairs: of the pairs that are left, the nearest one always
/// stands side by side.
class Pairing {
 public:
  Pairing(std::span<const double> reference_s, std::span<const double> estimate_s, double most_s)
      : most_s_(most_s) {
    std::size_t r = 0, e = 0;
    while (r < reference_s.size() || e < estimate_s.size()) {
      const bool take_reference =
          e == estimate_s.size() || (r < reference_s.size() && reference_s[r] <= estimate_s[e]);
      if (take_reference) {
        times_.push_back({reference_s[r], true, r});
        ++r;
      } else {
        times_.push_back({estimate_s[e], false, e});
        ++e;
      }
    }
    for (std::size_t i = 0; i < times_.size(); ++i) {
      times_[i].before = i == 0 ? kNone : i - 1;
      times_[i].after = i + 1 == times_.size() ? kNone : i + 1;
    }
    for (std::size_t i = 1; i < times_.size(); ++i) offer(i - 1, i);
  }

  std::vector<Match> pair() {
    std::vector<Match> matches;
    while (!offers_.empty()) {
      const auto [difference, match_reference, left, right] = offers_.top();
      offers_.pop();
      if (times_[left].gone || times_[right].gone) continue;
      matches.push_back(match_of(left, right));
      const std::size_t before = times_[left].before, after = times_[right].after;
      times_[left].gone = times_[right].gone = true;
      if (before != kNone) times_[before].after = after;
      if (after != kNone) times_[after].before = before;
      if (before != kNone && after != kNone) offer(before, after);
    }
    std::sort(matches.begin(), matches.end(),
              [](const Match& a, const Match& b) { return a.reference < b.reference; });
    return matches;
  }

 private:
  struct Entry {
    double t_s = 0.0;
    bool of_reference = false;
    std::size_t index = 0;  ///< on its side
    std::size_t before = kNone;
    std::size_t after = kNone;
    bool gone = false;
  };

  Match match_of(std::size_t left, std::size_t right) const {
    const Entry &a = times_[left], &b = times_[right];
    return a.of_reference ? Match{a.index, b.index} : Match{b.index, a.index};
  }

  void offer(std::size_t left, std::size_t right) {
    if (times_[left].of_reference == times_[right].of_reference) return;
    const double difference = std::abs(times_[right].t_s - times_[left].t_s);
    if (difference <= most_s_) offers_.emplace(difference, match_of(left, right).reference, left, right);
  }

  using Offer = std::tuple<double, std::size_t, std::size_t, std::size_t>;
  double most_s_;
  std::vector<Entry> times_;
  std::priority_queue<Offer, std::vector<Offer>, std::greater<>> offers_;
};

}  // namespace

std::vector<Match> associate(std::span<const double> reference_s, std::span<const double> estimate_s,
                             double most_s) {
  return Pairing(reference_s, estimate_s, most_s).pair();
}

}  // namespace hallway::eval
