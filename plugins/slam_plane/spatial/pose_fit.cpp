// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/pose_fit.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

#include "slam_plane/spatial/polygon.hpp"

namespace hallway::slam_plane::spatial {
namespace {

constexpr int kSteps = 4;  // the last one with edges gated
constexpr double kEdgeBounds_m[kSteps] = {0.3, 0.2, 0.15, 0.15};
constexpr double kEdgeGateSigmas = 4.0;
constexpr double kWorstTurn_rad = 0.05;  // standard deviation of a rotation above which it is open
constexpr double kSameWay = 0.94;        // cosine between outward normals of edges that may be one

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

PoseFit::PoseFit(const Options& options) : noise_(options.noise()), undetermined_m_(options.undetermined_m) {}

void PoseFit::add(const Sighting& sighting, const Feature& plane, std::vector<const Feature*> edges) {
  const PlaneAxes axes(sighting.normal);
  pairs_.push_back({&sighting, &plane, std::move(edges), {axes.u, axes.v}});
}

Index PoseFit::find_edge(const SightedEdge& edge, const std::vector<const Feature*>& edges, const Pose3& T,
                         double bound) {
  const Vec3 outward = T.q * edge.outward;
  const Vec3 middle = T * Vec3(0.5 * (edge.end[0] + edge.end[1]));
  Index best = kNone;
  double least = bound;
  for (Index i = 0; i < edges.size(); ++i) {
    if (edges[i] == nullptr || edges[i]->normal().dot(outward) < kSameWay) continue;
    const double distance = std::abs(edges[i]->distance(middle));
    if (distance >= least) continue;
    least = distance;
    best = i;
  }
  return best;
}

void PoseFit::add_plane(const Pair& pair, const Pose3& T, Normal& normal) const {
  const Feature& plane = *pair.plane;
  const Vec3 n = plane.normal();
  const Vec3 arm = T.q * pair.sighting->centre;
  const Vec3 at = arm + T.t;
  normal.add(gradient_of(n, arm), plane.distance(at), noise_.normal * noise_.normal + plane.variance_at(at));
  for (const Vec3& axis : pair.axes) {
    const Vec3 turned = T.q * axis;
    Vec6 gradient;
    gradient << Vec3::Zero(), turned.cross(n);
    normal.add(gradient, n.dot(turned), noise_.angle * noise_.angle + plane.variance_along(turned));
  }
}

void PoseFit::add_edges(const Pair& pair, const Pose3& T, double bound, bool gated, Normal& normal) const {
  for (const SightedEdge& edge : pair.sighting->edges) {
    if (!edge.is_true) continue;
    const Index found = find_edge(edge, pair.edges, T, bound);
    if (found == kNone) continue;
    const Feature& feature = *pair.edges[found];
    for (const Vec3& end : edge.end) {
      const Vec3 arm = T.q * end;
      const double variance =
          noise_.end * noise_.end + noise_.along * noise_.along + feature.variance_at(arm + T.t);
      const double residual = feature.distance(arm + T.t);
      const double ratio2 = residual * residual / (kEdgeGateSigmas * kEdgeGateSigmas * variance);
      if (gated && ratio2 > 1.0) continue;
      normal.add(gradient_of(feature.normal(), arm), residual, gated ? variance : variance * (1.0 + ratio2));
    }
  }
}

/// Finds the directions that are open.
void PoseFit::judge(PoseInformation& information) const {
  Vec6 scale;
  scale << Vec3::Constant(undetermined_m_), Vec3::Constant(kWorstTurn_rad);
  const Eigen::SelfAdjointEigenSolver<Mat6> solver(scale.asDiagonal() * information.matrix *
                                                   scale.asDiagonal());
  information.open = static_cast<int>((solver.eigenvalues().array() < 1.0).count());
  information.directions = solver.eigenvectors();
}

PoseInformation PoseFit::solve(Pose3& T) const {
  PoseInformation information;
  if (pairs_.empty()) return information;
  Vec6 scale;
  scale << Vec3::Constant(undetermined_m_), Vec3::Constant(kWorstTurn_rad);
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
    if (step.allFinite()) T = T.moved(step);
  }
  return information;
}

PoseInformation PoseFit::own_information(const std::vector<Sighting>& frame) const {
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
    for (const SightedEdge& edge : frame[i].edges) {
      if (edge.is_true) edges[i].push_back(exact(edge.outward, edge.end[0]));
    }
  }
  for (Index i = 0; i < frame.size(); ++i) {
    std::vector<const Feature*> known;
    for (const Index edge : edges[i]) known.push_back(&features[edge]);
    fit.add(frame[i], features[planes[i]], std::move(known));
  }
  Pose3 T;
  return fit.solve(T);
}

double PoseFit::distance2(const Sighting& sighting, const Feature& plane, const Pose3& T) const {
  const PlaneAxes axes(sighting.normal);
  const Vec3 at = T * sighting.centre;
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
