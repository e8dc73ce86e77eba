// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/pose_fit.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <tuple>
#include <utility>

#include "geometry/symmetric.hpp"
#include "slam_plane/spatial/outline.hpp"

namespace hallway::slam_plane::spatial {
namespace {

constexpr int kSteps = 4;  // the last one with edges gated
constexpr double kEdgeBounds_m[kSteps] = {0.3, 0.2, 0.15, 0.15};
constexpr double kEdgeGateSigmas = 4.0;
constexpr double kWorstTurn_rad = 0.05;  // standard deviation of a rotation above which it is open
constexpr double kSameWay = 0.94;        // cosine between outward normals of edges that may be one
constexpr double kLeastRun_m = 1e-6;     // shorter than this an edge has no direction

/// The row n . (T p) = offset, of which T is sought.
Vec6 gradient_of(const Vec3& n, const Vec3& arm) {
  Vec6 gradient;
  gradient << n, arm.cross(n);
  return gradient;
}

}  // namespace

void PoseFit::Normal::add(const Vec6& gradient, double residual, double variance) {
  h += gradient * gradient.transpose() / variance;
  g -= gradient * (residual / variance);
}

PoseFit::PoseFit(const Options& options)
    : noise_(options.noise()),
      undetermined_m_(options.undetermined_m),
      match_angle_(radians(options.match_angle_deg)) {}

void PoseFit::add(const AssociatedObservation& observation, const Feature& plane,
                  std::vector<const Feature*> edges) {
  const PlaneAxes axes(observation.normal);
  pairs_.push_back({&observation, &plane, std::move(edges), {axes.u, axes.v}});
}

/// How badly an edge fits a known one: 1 where it is as far off as is allowed, at the worse one of its ends or by its direction.
double PoseFit::misfit(const ObservedEdge& edge, const Feature& known, const Pose& T,
                       const EdgeBounds& bounds) const {
  if (known.normal().dot(T.q * edge.outward) < kSameWay) return 2.0;
  const double own = noise_.end_variance();
  double worst = 0.0;
  for (const Vec3& end : edge.end) {
    const Vec3 at = T * end;
    const double allowed = bounds.distance_m + kEdgeGateSigmas * std::sqrt(own + known.variance_at(at));
    worst = std::max(worst, std::abs(known.distance(at)) / allowed);
  }
  const Vec3 run = edge.end[1] - edge.end[0];
  const double length = run.norm();
  if (length < kLeastRun_m) return worst;
  const Vec3 along = T.q * run / length;
  const double sigma =
      std::sqrt(2.0 * noise_.end * noise_.end / (length * length) + known.variance_along(along));
  const double angle = std::asin(std::min(std::abs(known.normal().dot(along)), 1.0));
  return std::max(worst, angle / (bounds.angle_rad + kEdgeGateSigmas * sigma));
}

bool PoseFit::may_be_one(const ObservedEdge& a, const ObservedEdge& b) const {
  if (a.outward.dot(b.outward) < kSameWay) return false;
  const double bound = kEdgeGateSigmas * std::numbers::sqrt2 * noise_.end;
  const Vec3 ends[] = {a.end[0], a.end[1], b.end[0], b.end[1]};
  // The longer one tells the line.
  const bool first = (a.end[1] - a.end[0]).squaredNorm() >= (b.end[1] - b.end[0]).squaredNorm();
  const ObservedEdge& line = first ? a : b;
  return std::all_of(std::begin(ends), std::end(ends),
                     [&](const Vec3& end) { return std::abs(line.outward.dot(end - line.end[0])) <= bound; });
}

std::vector<Index> PoseFit::find_edges(const AssociatedObservation& observation,
                                       const std::vector<const Feature*>& edges, const Pose& T,
                                       const EdgeBounds& bounds) const {
  struct Candidate {
    double misfit;
    Index seen, known;
  };
  std::vector<Candidate> candidates;
  for (Index i = 0; i < observation.edges.size(); ++i) {
    if (!observation.edges[i].is_true) continue;
    for (Index k = 0; k < edges.size(); ++k) {
      if (edges[k] == nullptr) continue;
      const double found = misfit(observation.edges[i], *edges[k], T, bounds);
      if (found < 1.0) candidates.push_back({found, i, k});
    }
  }
  std::ranges::sort(candidates, [](const Candidate& a, const Candidate& b) {
    return std::tie(a.misfit, a.seen, a.known) < std::tie(b.misfit, b.seen, b.known);
  });
  std::vector<Index> found(observation.edges.size(), kNone);
  for (const Candidate& candidate : candidates) {
    if (found[candidate.seen] != kNone) continue;
    bool free = true;
    for (Index i = 0; i < found.size(); ++i)
      free = free && (found[i] != candidate.known ||
                      may_be_one(observation.edges[i], observation.edges[candidate.seen]));
    if (free) found[candidate.seen] = candidate.known;
  }
  return found;
}

void PoseFit::add_plane(const Pair& pair, const Pose& T, Normal& normal) const {
  const Feature& plane = *pair.plane;
  const Vec3 n = plane.normal();
  const Vec3 arm = T.q * pair.observation->centre;
  const Vec3 at = arm + T.t;
  normal.add(gradient_of(n, arm), plane.distance(at), noise_.normal * noise_.normal + plane.variance_at(at));
  for (const Vec3& axis : pair.axes) {
    const Vec3 turned = T.q * axis;
    Vec6 gradient;
    gradient << Vec3::Zero(), turned.cross(n);
    normal.add(gradient, n.dot(turned), noise_.angle * noise_.angle + plane.variance_along(turned));
  }
}

void PoseFit::add_edges(const Pair& pair, const Pose& T, double bound_m, bool gated, Normal& normal) const {
  const std::vector<Index> found = find_edges(*pair.observation, pair.edges, T, {bound_m, match_angle_});
  for (Index i = 0; i < found.size(); ++i) {
    if (found[i] == kNone) continue;
    const ObservedEdge& edge = pair.observation->edges[i];
    const Feature& feature = *pair.edges[found[i]];
    for (const Vec3& end : edge.end) {
      const Vec3 arm = T.q * end;
      const double variance = noise_.end_variance() + feature.variance_at(arm + T.t);
      const double residual = feature.distance(arm + T.t);
      const double ratio2 = residual * residual / (kEdgeGateSigmas * kEdgeGateSigmas * variance);
      if (gated && ratio2 > 1.0) continue;
      normal.add(gradient_of(feature.normal(), arm), residual, gated ? variance : variance * (1.0 + ratio2));
    }
  }
}

/// Standard deviations of a step above which its direction is open.
Vec6 PoseFit::scale() const {
  Vec6 scale;
  scale << Vec3::Constant(undetermined_m_), Vec3::Constant(kWorstTurn_rad);
  return scale;
}

/// Finds the directions that are open.
void PoseFit::judge(PoseInformation& information) const {
  const Vec6 scale = this->scale();
  const auto spectrum = hallway::spectrum<6>(scale.asDiagonal() * information.matrix * scale.asDiagonal());
  information.open = static_cast<int>((spectrum.values.array() < 1.0).count());
  information.directions = spectrum.vectors;
}

PoseInformation PoseFit::solve(Pose& T) const {
  PoseInformation information;
  if (pairs_.empty()) return information;
  const Vec6 scale = this->scale();
  for (int i = 0; i < kSteps; ++i) {
    Normal normal;
    for (const Pair& pair : pairs_) {
      add_plane(pair, T, normal);
      add_edges(pair, T, kEdgeBounds_m[i], i + 1 == kSteps, normal);
    }
    information.matrix = normal.h;
    judge(information);
    Vec6 step = Vec6::Zero();
    for (int k = information.open; k < 6; ++k) {
      const Vec6 direction = scale.asDiagonal() * information.directions.col(k);
      step += direction * (direction.dot(normal.g) / direction.dot(normal.h * direction));
    }
    if (step.allFinite()) T = {(rotation_by(step.tail<3>()) * T.q).normalized(), T.t + step.head<3>()};
  }
  return information;
}

PoseInformation PoseFit::own_information(const std::vector<AssociatedObservation>& frame) const {
  PoseFit fit(*this);
  fit.clear();
  std::vector<Feature> features;
  features.reserve(frame.size() * 9);
  const auto exact = [&](const Vec3& n, const Vec3& p) {
    Feature feature;
    feature.plane << n, n.dot(p);
    features.push_back(feature);
    return features.size() - 1;
  };
  std::vector<std::vector<Index>> edges(frame.size());
  std::vector<Index> planes(frame.size());
  for (Index i = 0; i < frame.size(); ++i) {
    planes[i] = exact(frame[i].normal, frame[i].centre);
    for (const ObservedEdge& edge : frame[i].edges) {
      if (edge.is_true) edges[i].push_back(exact(edge.outward, edge.end[0]));
    }
  }
  for (Index i = 0; i < frame.size(); ++i) {
    std::vector<const Feature*> known;
    for (const Index edge : edges[i]) known.push_back(&features[edge]);
    fit.add(frame[i], features[planes[i]], std::move(known));
  }
  Pose T;
  return fit.solve(T);
}

double PoseFit::distance2(const AssociatedObservation& observation, const Feature& plane,
                          const Pose& T) const {
  const PlaneAxes axes(observation.normal);
  const Vec3 at = T * observation.centre;
  const double offset = plane.distance(at);
  double sum = offset * offset / (noise_.normal * noise_.normal + plane.variance_at(at));
  for (const Vec3& axis : {axes.u, axes.v}) {
    const Vec3 turned = T.q * axis;
    const double angle = plane.normal().dot(turned);
    sum += angle * angle / (noise_.angle * noise_.angle + plane.variance_along(turned));
  }
  return sum;
}

}  // namespace hallway::slam_plane::spatial
