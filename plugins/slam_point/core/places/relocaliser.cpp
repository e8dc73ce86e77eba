// SPDX-License-Identifier: MIT
#include "slam_point/core/places/relocaliser.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include <Eigen/Geometry>

namespace hallway::slam_point {
namespace {

constexpr std::size_t kMostPoints = 64;
constexpr std::size_t kMostCentres = 32;
constexpr std::size_t kFewPoints = 24;  // that are looked up at once
constexpr std::size_t kShares = 8;      // that more are looked up in
constexpr std::size_t kMostShares = 3;  // of them in one call
constexpr std::size_t kQueryNeighbours = 5;
constexpr std::size_t kMostAlike = 2000;  // looked up in one call
constexpr int kMostHypotheses = 300;      // tried in one call
constexpr int kMostRefined = 24;          // of them fitted in full
constexpr std::size_t kFirstLooks = 8;    // points near the triangle that decide whether it is worth more
constexpr double kCoarseNoises = 12.0;
constexpr double kPlacementNoises = 4.0;
constexpr int kPasses = 4;
constexpr double kMostByChance = 1e-8;
constexpr double kLeastShareOfPoints = 0.4;
constexpr double kRivalShare = 0.6;
constexpr int kTrianglePoints = 3;
constexpr double kMostChance = 0.9;    // of one point
constexpr double kMostOfRival = 1e-3;  // expected by chance: above, a rival is nothing but that
constexpr std::array<double, 3> kTolerances{
    1.0, 0.5, 0.25};  // parts of what counts as noise that agreement is judged by

/// The chance that at least `least` of events that are independent of each other come true, each with its own chance.
/// O(events * least).
double chance_of_at_least(int least, const std::vector<double>& chances, std::vector<double>& of_count) {
  if (least <= 0) return 1.0;
  const auto most = static_cast<std::size_t>(least);
  of_count.assign(most + 1, 0.0);  // number that came true, where `least` means that or more -> its chance
  of_count[0] = 1.0;
  for (const double p : chances) {
    of_count[most] += p * of_count[most - 1];
    for (std::size_t k = most - 1; k > 0; --k) of_count[k] += p * (of_count[k - 1] - of_count[k]);
    of_count[0] *= 1.0 - p;
  }
  return std::min(1.0, of_count[most]);
}

/// An orthonormal frame on a triangle.
Mat3 frame_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 x = (b - a).normalized();
  const Vec3 z = x.cross(c - a).normalized();
  Mat3 frame;
  frame << x, z.cross(x), z;
  return frame;
}

}  // namespace

Relocaliser::Relocaliser(const Options& options, const SubmapGraph& graph, const ConstellationIndex& index)
    : graph_(graph),
      index_(index),
      noise_(options.noise_m),
      reach_(options.map_bound()),
      coarse_(std::min(kCoarseNoises * noise_, reach_)),
      agreement_(std::min(kPlacementNoises * noise_, reach_)) {}

bool Relocaliser::locate(const std::vector<Vec3>& points, Index except, Relocalisation& placement) {
  choose_points(points);
  widths_.assign(points_.size(), 1.0);
  if (points_.size() <= static_cast<std::size_t>(kTrianglePoints)) return false;
  taken_.resize(graph_.landmarks.size(), 0);
  best_ = Hypothesis();
  rival_ = Hypothesis();
  tried_ = 0;
  refined_ = 0;
  shares_ = points_.size() < kFewPoints ? 1 : kShares;
  for (std::size_t looks = 0; looks < std::min(kMostShares, shares_); ++looks) {
    search(except, next_share_++ % shares_);
    if (is_answer(placement)) return true;
  }
  return false;
}

/// Tries what a share of the points' triangles are like.
void Relocaliser::search(Index except, std::size_t share) {
  make_queries(share);
  look_up(except);
  for (const Query& query : queries_) {
    for (std::uint32_t i = 0; i < query.count && tried_ < kMostHypotheses && refined_ < kMostRefined; ++i)
      try_triangle(query.triangle, alike_[query.first + i]);
  }
}

void Relocaliser::try_triangle(const Triangle& seen, const Triangle& mapped) {
  if (is_known(seen, mapped)) return;
  ++tried_;
  trial_.part = graph_.landmarks[mapped.vertices[0]].part;
  if (!pose_of(seen, mapped, trial_.T)) return;
  if (!is_promising(seen, trial_.T, trial_.part)) return;
  ++refined_;
  if (refine(trial_)) keep(trial_);
}

/// Whether the best place so far is sure, and no other one is like it.
bool Relocaliser::is_answer(Relocalisation& placement) {
  const double least = kLeastShareOfPoints * static_cast<double>(points_.size());
  if (best_.agreeing < least || best_.agreeing <= kTrianglePoints) return false;
  placement = {best_.T, best_.part, best_.agreeing, expected_by_chance(best_)};
  if (placement.expected_by_chance >= kMostByChance) return false;
  return rival_.agreeing <= kRivalShare * best_.agreeing || expected_by_chance(rival_) >= kMostOfRival;
}

void Relocaliser::choose_points(const std::vector<Vec3>& points) {
  order_.resize(points.size());
  std::iota(order_.begin(), order_.end(), 0u);
  if (order_.size() > kMostPoints) {
    std::nth_element(order_.begin(), order_.begin() + kMostPoints, order_.end(),
                     [&](std::uint32_t a, std::uint32_t b) {
                       const double da = points[a].squaredNorm();
                       const double db = points[b].squaredNorm();
                       return std::tie(da, a) < std::tie(db, b);
                     });
    order_.resize(kMostPoints);
    std::sort(order_.begin(), order_.end());
  }
  points_.clear();
  for (const std::uint32_t i : order_) points_.push_back(points[i]);
}

void Relocaliser::make_queries(std::size_t share) {
  queries_.clear();
  const std::size_t step = 1 + (points_.size() - 1) / kMostCentres;
  for (auto centre = static_cast<Index>(share * step); centre < points_.size();
       centre += static_cast<Index>(shares_ * step)) {
    NearestNeighbours near;
    for (Index p = 0; p < points_.size(); ++p) {
      if (p != centre) near.add(p, (points_[p] - points_[centre]).squaredNorm(), kQueryNeighbours);
    }
    add_queries(centre, near);
  }
  const auto by_vertices = [](const Query& a, const Query& b) {
    return a.triangle.vertices < b.triangle.vertices;
  };
  std::sort(queries_.begin(), queries_.end(), by_vertices);
  queries_.erase(
      std::unique(queries_.begin(), queries_.end(),
                  [](const Query& a, const Query& b) { return a.triangle.vertices == b.triangle.vertices; }),
      queries_.end());
}

void Relocaliser::add_queries(Index centre, const NearestNeighbours& near) {
  const double least_height = graph_.planar ? 0.0 : 2.0 * kPlacementNoises * noise_;
  for (std::size_t i = 0; i < near.size(); ++i) {
    for (std::size_t j = i + 1; j < near.size(); ++j) {
      std::array<Index, 3> vertices{centre, near[i], near[j]};
      std::sort(vertices.begin(), vertices.end());
      const std::array<Vec3, 3> corners{points_[vertices[0]], points_[vertices[1]], points_[vertices[2]]};
      const Triangle triangle = make_triangle(vertices, corners);
      const double area2 = (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
      if (triangle.sides[2] < 2.0 * kPlacementNoises * noise_ || area2 < least_height * triangle.sides[0])
        continue;
      queries_.push_back({triangle, 0, 0});
    }
  }
}

void Relocaliser::look_up(Index except) {
  alike_.clear();
  for (Query& query : queries_) {
    query.first = static_cast<std::uint32_t>(alike_.size());
    look_up_ordered(except, query.triangle);
    query.count = static_cast<std::uint32_t>(alike_.size()) - query.first;
  }
  // What is rare says most.
  std::sort(queries_.begin(), queries_.end(), [](const Query& a, const Query& b) {
    return std::tie(a.count, a.triangle.vertices) < std::tie(b.count, b.triangle.vertices);
  });
}

void Relocaliser::look_up_ordered(Index except, const Triangle& triangle) {
  // Sides that differ by less than noise may be in another order in the map. All entries come out with their landmarks in the
  // order of the query's vertices.
  std::array<std::size_t, 3> order{0, 1, 2};
  do {
    const Sides sides{triangle.sides[order[0]], triangle.sides[order[1]], triangle.sides[order[2]]};
    const double slack = index_.tolerance();
    if (sides[0] < sides[1] - slack || sides[1] < sides[2] - slack) continue;
    index_.visit_like(sides, [&](const Triangle& mapped) {
      Triangle found;
      for (std::size_t i = 0; i < 3; ++i) {
        found.vertices[order[i]] = graph_.survivor(mapped.vertices[i]);
      }
      const Index part = graph_.landmarks[found.vertices[0]].part;
      const bool whole = part != kNone && part != except &&
                         part == graph_.landmarks[found.vertices[1]].part &&
                         part == graph_.landmarks[found.vertices[2]].part;
      if (whole) alike_.push_back(found);
      return alike_.size() < kMostAlike;
    });
  } while (std::next_permutation(order.begin(), order.end()));
}

bool Relocaliser::is_known(const Triangle& seen, const Triangle& mapped) const {
  const auto agrees = [&](const Hypothesis& hypothesis) {
    if (hypothesis.agreeing == 0) return false;
    for (std::size_t i = 0; i < 3; ++i) {
      if (hypothesis.landmarks[seen.vertices[i]] != mapped.vertices[i]) return false;
    }
    return true;
  };
  return agrees(best_) || agrees(rival_);
}

bool Relocaliser::pose_of(const Triangle& seen, const Triangle& mapped, Pose& T) const {
  std::array<Vec3, 3> from;
  std::array<Vec3, 3> to;
  for (std::size_t i = 0; i < 3; ++i) {
    from[i] = points_[seen.vertices[i]];
    to[i] = graph_.landmarks[mapped.vertices[i]].position;
  }
  const Mat3 from_frame = frame_of(from[0], from[1], from[2]);
  const Mat3 to_frame = frame_of(to[0], to[1], to[2]);
  if (!from_frame.allFinite() || !to_frame.allFinite()) return false;
  // A plane is not turned over.
  if (graph_.planar && from_frame(2, 2) * to_frame(2, 2) < 0.0) return false;
  const Mat3 rotation = to_frame * from_frame.transpose();
  T.q = Quat(rotation).normalized();
  if (graph_.planar) {
    T.q.x() = T.q.y() = 0.0;
    T.q.normalize();
  }
  T.t = (to[0] + to[1] + to[2]) / 3.0 - T.q * ((from[0] + from[1] + from[2]) / 3.0);
  if (graph_.planar) T.t.z() = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    if ((T * from[i] - to[i]).squaredNorm() > coarse_ * coarse_) return false;
  }
  return true;
}

bool Relocaliser::is_promising(const Triangle& seen, const Pose& T, Index part) {
  const Vec3 centre =
      (points_[seen.vertices[0]] + points_[seen.vertices[1]] + points_[seen.vertices[2]]) / 3.0;
  near_.clear();
  for (Index p = 0; p < points_.size(); ++p) {
    if (p == seen.vertices[0] || p == seen.vertices[1] || p == seen.vertices[2]) continue;
    near_.emplace_back((points_[p] - centre).squaredNorm(), p);
  }
  const std::size_t looks = std::min(kFirstLooks, near_.size());
  std::partial_sort(near_.begin(), near_.begin() + static_cast<std::ptrdiff_t>(looks), near_.end());
  const std::size_t wanted = std::min<std::size_t>(graph_.planar ? 3 : 2, looks);
  std::size_t found = 0;
  for (std::size_t i = 0; i < looks && found < wanted && found + (looks - i) >= wanted; ++i) {
    const Vec3 p = T * points_[near_[i].second];
    bool any = false;
    graph_.visit_part_landmarks_near(part, p, [&](Index l) {
      any = any || (graph_.landmarks[l].position - p).squaredNorm() <= coarse_ * coarse_;
    });
    if (any) ++found;
  }
  return found >= wanted;
}

void Relocaliser::match(const Hypothesis& hypothesis, double bound_m) {
  matches_.clear();
  for (const Index landmark : taken_list_) taken_[landmark] = 0;
  taken_list_.clear();
  for (Index p = 0; p < points_.size(); ++p) {
    const Vec3 at = hypothesis.T * points_[p];
    const double bound = bound_of(p, bound_m);
    graph_.visit_part_landmarks_near(hypothesis.part, at, [&](Index l) {
      const double d2 = (graph_.landmarks[l].position - at).squaredNorm();
      if (d2 <= bound * bound) matches_.push_back({d2, p, l});
    });
  }
  std::sort(matches_.begin(), matches_.end());
}

void Relocaliser::assign(Hypothesis& hypothesis) {
  hypothesis.landmarks.assign(points_.size(), kNone);
  for (const auto& [d2, point, landmark] : matches_) {
    if (hypothesis.landmarks[point] != kNone || taken_[landmark] != 0) continue;
    hypothesis.landmarks[point] = landmark;
    taken_[landmark] = 1;
    taken_list_.push_back(landmark);
  }
}

bool Relocaliser::fit(Hypothesis& hypothesis) {
  pairs_.clear();
  for (Index p = 0; p < points_.size(); ++p) {
    if (hypothesis.landmarks[p] == kNone) continue;
    const LandmarkRecord& landmark = graph_.landmarks[hypothesis.landmarks[p]];
    pairs_.push_back({landmark.position, points_[p], pair_weight(landmark.weight)});
  }
  return robust_fit(pairs_, fit_rules(noise_, graph_.planar), hypothesis.T);
}

bool Relocaliser::refine(Hypothesis& hypothesis) {
  for (int pass = 0; pass < kPasses; ++pass) {
    match(hypothesis, pass == 0 ? reach_ : coarse_);
    assign(hypothesis);
    if (!fit(hypothesis)) return false;
  }
  count_agreeing(hypothesis);
  return hypothesis.agreeing > 0;
}

void Relocaliser::count_agreeing(Hypothesis& hypothesis) {
  hypothesis.agreeing = 0;
  for (Index p = 0; p < points_.size(); ++p) {
    Index& landmark = hypothesis.landmarks[p];
    if (landmark == kNone) continue;
    const double d2 = (hypothesis.T * points_[p] - graph_.landmarks[landmark].position).squaredNorm();
    if (d2 <= agreement_ * agreement_) {
      ++hypothesis.agreeing;
    } else {
      landmark = kNone;
    }
  }
}

double Relocaliser::chance_at(const std::vector<Vec3>& points, const std::vector<double>& noises,
                              const Pose& T_map_points, int tried) {
  choose_points(points);
  widths_.clear();
  for (const std::uint32_t i : order_) widths_.push_back(noises[i] / noise_);
  taken_.resize(graph_.landmarks.size(), 0);
  tried_ = tried;
  trial_.T = T_map_points;
  trial_.part = graph_.part();
  match(trial_, agreement_);
  assign(trial_);
  return expected_by_chance(trial_);
}

void Relocaliser::keep(Hypothesis& hypothesis) {
  // Two that put the points that agree near to the same places are one.
  const auto is_same = [&](const Hypothesis& other) {
    if (other.agreeing == 0 || other.part != hypothesis.part) return false;
    for (Index p = 0; p < points_.size(); ++p) {
      if (hypothesis.landmarks[p] == kNone) continue;
      if ((hypothesis.T * points_[p] - other.T * points_[p]).squaredNorm() > reach_ * reach_) return false;
    }
    return true;
  };
  if (is_same(best_)) {
    if (hypothesis.agreeing > best_.agreeing) std::swap(best_, hypothesis);
    return;
  }
  if (hypothesis.agreeing > best_.agreeing) {
    std::swap(rival_, best_);
    std::swap(best_, hypothesis);
  } else if (hypothesis.agreeing > rival_.agreeing) {
    std::swap(rival_, hypothesis);
  }
}

double Relocaliser::bound_of(Index point, double bound_m) const {
  return std::min(widths_[point] * bound_m, reach_);
}

double Relocaliser::expected_by_chance(const Hypothesis& place) {
  std::size_t others = 0;
  residuals2_.assign(points_.size(), std::numeric_limits<double>::infinity());
  for (Index p = 0; p < points_.size(); ++p) {
    const Vec3 at = place.T * points_[p];
    graph_.visit_part_landmarks_near(place.part, at, [&](Index l) {
      const double d2 = (graph_.landmarks[l].position - at).squaredNorm();
      if (l == place.landmarks[p]) residuals2_[p] = d2;
      if (d2 <= reach_ * reach_ && l != place.landmarks[p]) ++others;
    });
  }
  // One more than was seen, so that nothing is impossible.
  const double within_reach = (static_cast<double>(others) + 1.0) / static_cast<double>(points_.size());
  double least = 1.0;
  for (const double share : kTolerances) least = std::min(least, chance_within(share, within_reach));
  return std::max(1, tried_) * static_cast<double>(kTolerances.size()) * least;
}

double Relocaliser::chance_within(double share, double within_reach) {
  chances_.clear();
  agreeing_chances_.clear();
  for (Index p = 0; p < points_.size(); ++p) {
    const double bound = bound_of(p, share * agreement_);
    const double chance =
        std::min(kMostChance, within_reach * std::pow(bound / reach_, graph_.planar ? 2 : 3));
    (residuals2_[p] <= bound * bound ? agreeing_chances_ : chances_).push_back(chance);
  }
  if (agreeing_chances_.size() <= kTrianglePoints) return 1.0;
  // Those that say most are taken for the triangle, which was chosen to agree.
  std::sort(agreeing_chances_.begin(), agreeing_chances_.end());
  chances_.insert(chances_.end(), agreeing_chances_.begin() + kTrianglePoints, agreeing_chances_.end());
  const auto beyond = static_cast<int>(agreeing_chances_.size()) - kTrianglePoints;
  return chance_of_at_least(beyond, chances_, of_count_);
}

}  // namespace hallway::slam_point
