// SPDX-License-Identifier: MIT
#include "planes/score.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "planes/overlap.hpp"
#include "planes/rectangle.hpp"

namespace hallway::planes {
namespace {

constexpr double kPairIou = 0.5;  // from here on a found plane is the true one, well or badly
constexpr double kMostOf = 0.5;   // so much of a plane is "most of it"
constexpr double kPartOf = 0.1;   // so much of a true plane is a part of it
constexpr double kStolen = 0.05;  // so much of a true plane taken by another one is a theft
constexpr double kMisaligned = 2.0 * std::numbers::pi / 180.0;
constexpr double kApartAngle = 10.0 * std::numbers::pi / 180.0;
constexpr double kApartNoises = 5.0;
constexpr std::uint64_t kApartPoints = 20;
constexpr double kUpright =
    30.0 * std::numbers::pi / 180.0;  // two planes that lean more are attached, not parallel
constexpr double kGapNoises = 5.0;

double angle_between(const Plane& a, const Plane& b) {
  // By the sine where it is small: the cosine's last bits are then all there is.
  return std::atan2(a.normal.cross(b.normal).norm(), std::abs(a.normal.dot(b.normal)));
}

/// The middle of each true plane's points.
std::vector<Vec3> middles(const std::vector<Vec3>& points, const Truth& truth) {
  const std::vector<std::size_t> places = places_of_points(truth);
  std::vector<Vec3> sums(truth.planes.size(), Vec3::Zero());
  std::vector<double> counts(truth.planes.size(), 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (places[i] == kNoPlace) continue;
    sums[places[i]] += points[i];
    counts[places[i]] += 1.0;
  }
  for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= std::max(counts[i], 1.0);
  return sums;
}

class Judge {
 public:
  Judge(const std::vector<Vec3>& points, const Truth& truth, const std::vector<PlaneObservation>& found)
      : truth_(truth),
        found_(found),
        overlap_(overlap_of(truth, found)),
        middles_(middles(points, truth)),
        apart_(counted_apart(truth)),
        pair_of_truth_(truth.planes.size(), nullptr),
        pair_of_found_(found.size(), nullptr),
        explained_truth_(truth.planes.size(), false),
        explained_found_(found.size(), false) {}

  Score judge() {
    score_.labelled_points = overlap_.labelled;
    score_.unassigned_points = overlap_.unassigned;
    score_.outliers = overlap_.outliers;
    score_.assigned_outliers = overlap_.assigned_outliers;
    make_pairs();
    set_found_apart();
    count_pairs();
    find_splits();
    find_merges();
    find_missing_and_extra();
    find_thefts();
    find_misaligned();
    find_unattached();
    std::stable_sort(score_.faults.begin(), score_.faults.end(),
                     [](const Fault& a, const Fault& b) { return a.kind < b.kind; });
    return std::move(score_);
  }

 private:
  bool is_asked(std::size_t t) const { return overlap_.truth_sizes[t] > 0 && !apart_[t]; }

  /// Greedily by descending IoU; at IoU above one half no other choice is left where members are disjoint.
  void make_pairs() {
    std::vector<Common> candidates;
    for (const Common& common : overlap_.common) {
      if (overlap_.iou(common) >= kPairIou) candidates.push_back(common);
    }
    std::sort(candidates.begin(), candidates.end(), [&](const Common& a, const Common& b) {
      return std::tuple(-overlap_.iou(a), a.truth, a.found) < std::tuple(-overlap_.iou(b), b.truth, b.found);
    });
    std::vector<bool> truth_taken(truth_.planes.size()), found_taken(found_.size());
    for (const Common& pair : candidates) {
      if (truth_taken[pair.truth] || found_taken[pair.found]) continue;
      truth_taken[pair.truth] = found_taken[pair.found] = true;
      const Plane& plane = found_[pair.found].plane;
      score_.pairs.push_back({.truth = pair.truth,
                              .found = pair.found,
                              .iou = overlap_.iou(pair),
                              .normal_error = angle_between(truth_.planes[pair.truth].plane, plane),
                              .offset_error = std::abs(plane.distance(middles_[pair.truth]))});
    }
    std::sort(score_.pairs.begin(), score_.pairs.end(),
              [](const PlanePair& a, const PlanePair& b) { return a.truth < b.truth; });
    for (const PlanePair& pair : score_.pairs)
      pair_of_truth_[pair.truth] = pair_of_found_[pair.found] = &pair;
  }

  /// A found plane is apart where most of it lies on true planes that are.
  void set_found_apart() {
    std::vector<std::uint64_t> on_apart(found_.size(), 0);
    for (const Common& common : overlap_.common)
      on_apart[common.found] += apart_[common.truth] ? common.points : 0;
    for (std::size_t f = 0; f < found_.size(); ++f)
      found_apart_.push_back(static_cast<double>(on_apart[f]) >
                             kMostOf * static_cast<double>(overlap_.found_sizes[f]));
  }

  void count_pairs() {
    for (std::size_t t = 0; t < truth_.planes.size(); ++t) {
      score_.asked.push_back(is_asked(t));
      score_.truths += is_asked(t) ? 1u : 0u;
      score_.apart += apart_[t] && overlap_.truth_sizes[t] > 0 ? 1u : 0u;
    }
    score_.found = static_cast<std::size_t>(std::count(found_apart_.begin(), found_apart_.end(), false));
    for (const PlanePair& pair : score_.pairs) {
      score_.apart_matched += apart_[pair.truth] && pair.iou >= kIous[0] ? 1u : 0u;
      if (apart_[pair.truth]) continue;
      for (std::size_t i = 0; i < kIous.size(); ++i) score_.matched[i] += pair.iou >= kIous[i] ? 1u : 0u;
    }
  }

  void add(FaultKind kind, std::vector<std::size_t> truths, std::vector<std::size_t> found,
           double amount = 0.0) {
    score_.faults.push_back({kind, std::move(truths), std::move(found), amount});
  }

  /// True planes that several found ones divide: most of each of these lies on it, and each is a part of it.
  void find_splits() {
    std::vector<std::vector<std::size_t>> parts(truth_.planes.size());
    for (const Common& common : overlap_.common) {
      if (overlap_.share_of_found(common) >= kMostOf && overlap_.share_of_truth(common) >= kPartOf)
        parts[common.truth].push_back(common.found);
    }
    for (std::size_t t = 0; t < parts.size(); ++t) {
      if (parts[t].size() < 2 || !is_asked(t)) continue;
      explained_truth_[t] = true;
      for (const std::size_t f : parts[t]) explained_found_[f] = true;
      add(FaultKind::kSplit, {t}, parts[t]);
    }
  }

  /// Found planes that hold most of several true ones.
  void find_merges() {
    std::vector<std::vector<std::size_t>> parts(found_.size());
    for (const Common& common : overlap_.common) {
      if (overlap_.share_of_truth(common) >= kMostOf && is_asked(common.truth))
        parts[common.found].push_back(common.truth);
    }
    for (std::size_t f = 0; f < parts.size(); ++f) {
      if (parts[f].size() < 2) continue;
      explained_found_[f] = true;
      for (const std::size_t t : parts[f]) explained_truth_[t] = true;
      merged_.push_back(f);
      add(FaultKind::kMerged, parts[f], {f});
    }
  }

  void find_missing_and_extra() {
    for (std::size_t t = 0; t < truth_.planes.size(); ++t) {
      if (is_asked(t) && pair_of_truth_[t] == nullptr && !explained_truth_[t])
        add(FaultKind::kMissing, {t}, {});
    }
    for (std::size_t f = 0; f < found_.size(); ++f) {
      if (!found_apart_[f] && pair_of_found_[f] == nullptr && !explained_found_[f])
        add(FaultKind::kExtra, {}, {f});
    }
  }

  /// Points of a true plane that a plane has which is another one.
  void find_thefts() {
    for (const Common& common : overlap_.common) {
      const PlanePair* thief = pair_of_found_[common.found];
      const bool merged = std::find(merged_.begin(), merged_.end(), common.found) != merged_.end();
      if (thief == nullptr || thief->truth == common.truth || merged || !is_asked(common.truth)) continue;
      if (overlap_.share_of_truth(common) < kStolen) continue;
      add(FaultKind::kStolen, {common.truth}, {common.found}, static_cast<double>(common.points));
    }
  }

  void find_misaligned() {
    for (const PlanePair& pair : score_.pairs) {
      if (is_asked(pair.truth) && pair.normal_error > kMisaligned)
        add(FaultKind::kMisaligned, {pair.truth}, {pair.found}, pair.normal_error);
    }
  }

  /// True planes that meet at an angle, both found, but not so that they meet.
  void find_unattached() {
    const double tolerance = kGapNoises * truth_.noise;
    for (std::size_t a = 0; a < truth_.planes.size(); ++a) {
      for (std::size_t b = a + 1; b < truth_.planes.size(); ++b) {
        const TruePlane &p = truth_.planes[a], &q = truth_.planes[b];
        if (pair_of_truth_[a] == nullptr || pair_of_truth_[b] == nullptr || !p.corners || !q.corners)
          continue;
        if (!is_asked(a) || !is_asked(b) || angle_between(p.plane, q.plane) < kUpright) continue;
        if (rectangle_distance(*p.corners, *q.corners) > 0.1 * tolerance) continue;
        const std::size_t f = pair_of_truth_[a]->found, g = pair_of_truth_[b]->found;
        const double gap = rectangle_distance(found_[f].corners, found_[g].corners);
        if (gap > tolerance) add(FaultKind::kUnattached, {a, b}, {f, g}, gap);
      }
    }
  }

  const Truth& truth_;
  const std::vector<PlaneObservation>& found_;
  const Overlap overlap_;
  const std::vector<Vec3> middles_;
  const std::vector<bool> apart_;
  std::vector<const PlanePair*> pair_of_truth_;
  std::vector<const PlanePair*> pair_of_found_;
  std::vector<bool> explained_truth_, explained_found_, found_apart_;
  std::vector<std::size_t> merged_;
  Score score_;
};

}  // namespace

const char* fault_name(FaultKind kind) {
  constexpr std::array kNames{"missing", "extra", "split", "merged", "stolen", "misaligned", "unattached"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::size_t Score::count(FaultKind kind) const {
  return static_cast<std::size_t>(
      std::count_if(faults.begin(), faults.end(), [&](const Fault& fault) { return fault.kind == kind; }));
}

std::vector<bool> counted_apart(const Truth& truth) {
  const std::vector<std::uint64_t> sizes = overlap_of(truth, {}).truth_sizes;
  std::vector<bool> apart(truth.planes.size(), false);
  for (std::size_t a = 0; a < truth.planes.size(); ++a) {
    if (sizes[a] < kApartPoints) apart[a] = true;
    for (std::size_t b = 0; b < a; ++b) {
      const TruePlane &p = truth.planes[a], &q = truth.planes[b];
      if (!p.corners || !q.corners || angle_between(p.plane, q.plane) > kApartAngle) continue;
      if (rectangle_distance(*p.corners, *q.corners) < kApartNoises * truth.noise) apart[a] = apart[b] = true;
    }
  }
  return apart;
}

Score score_planes(const std::vector<Vec3>& points, const Truth& truth,
                   const std::vector<PlaneObservation>& found) {
  return Judge(points, truth, found).judge();
}

}  // namespace hallway::planes
