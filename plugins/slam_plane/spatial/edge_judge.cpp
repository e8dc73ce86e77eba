// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/edge_judge.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace hallway::slam_plane::spatial {
namespace {

constexpr double kNearerSigmas = 2.0;  // that something is nearer by, if it hides
constexpr double kLeastLength_m = 0.1;
constexpr double kSameDirection = 0.99;  // cosine between normals of faces that may lie in one plane

/// Part of a segment, by shares of its length.
struct Part {
  double from = 0.0;
  double to = 1.0;
  bool empty() const { return from >= to; }
  /// Keeps where a + share * (b - a) is not negative.
  void keep(double a, double b) {
    if (a >= 0.0 && b >= 0.0) return;
    if (a < 0.0 && b < 0.0) {
      to = from;
    } else if (a < 0.0) {
      from = std::max(from, a / (a - b));
    } else {
      to = std::min(to, a / (a - b));
    }
  }
};

/// Whether both values are below a bound.
bool both_below(double a, double b, double bound_a, double bound_b) {
  return a < bound_a && b < bound_b;
}

}  // namespace

EdgeJudge::EdgeJudge(const Options& options)
    : noise_(options.noise()),
      sigmas_(options.corner_sigmas),
      margin_(options.border_margin_deg * std::numbers::pi / 180.0) {}

/// Of where an edge is seen, in any direction.
double EdgeJudge::sigma(const Sighting& sighting) const {
  return std::hypot(std::hypot(noise_.normal, sighting.reach_m * noise_.angle), noise_.end, noise_.along);
}

/// Of a face's plane at a point of it.
double EdgeJudge::sigma_across(const Sighting& sighting, const Vec3& p) const {
  return std::hypot(noise_.normal, (p - sighting.centre).norm() * noise_.angle);
}

bool EdgeJudge::at_border(const View& view, const SightedEdge& edge, double sigma) const {
  const double reach = sigmas_ * sigma;
  const Vec3 &a = edge.end[0], &b = edge.end[1];
  const double near_a = reach + margin_ * a.norm(), near_b = reach + margin_ * b.norm();
  for (const int axis : {1, 2}) {
    const double fov = axis == 1 ? view.horizontal_fov_rad : view.vertical_fov_rad;
    if (fov >= std::numbers::pi) continue;
    const double s = std::sin(0.5 * fov), c = std::cos(0.5 * fov);
    for (const double side : {-1.0, 1.0}) {
      if (both_below(s * a.x() + side * c * a[axis], s * b.x() + side * c * b[axis], near_a, near_b))
        return true;
    }
  }
  const auto depth = [&](const Vec3& p) { return view.range_bounds_sides ? p.norm() : p.x(); };
  if (view.max_range_m > 0.0 && both_below(-depth(a), -depth(b), reach - view.max_range_m, reach - view.max_range_m))
    return true;
  return view.min_range_m > 0.0 &&
         both_below(depth(a), depth(b), reach + view.min_range_m, reach + view.min_range_m);
}

/// Whether any of an edge lies behind a face: behind its plane, and within its outline as seen from the robot, widened by what noise may do.
bool EdgeJudge::is_hidden(const SightedEdge& edge, double sigma, const Sighting& nearer) const {
  const Vec3 &a = edge.end[0], &b = edge.end[1];
  Part part;
  const double offset = nearer.offset();
  const auto behind = [&](const Vec3& p) {
    return offset - nearer.normal.dot(p) - kNearerSigmas * std::hypot(sigma, sigma_across(nearer, p));
  };
  part.keep(behind(a), behind(b));
  const double own = EdgeJudge::sigma(nearer);
  const double range = std::max(a.norm(), b.norm());
  for (const SightedEdge& side : nearer.edges) {
    if (part.empty()) return false;
    // The plane through the robot's eye and the side; inward.
    const Vec3 normal = side.end[0].cross(side.end[1]);
    if (normal.norm() < 1e-12) continue;
    const Vec3 inward = normal.normalized() * (normal.dot(nearer.centre) < 0.0 ? -1.0 : 1.0);
    const double nearest = std::max(std::min(side.end[0].norm(), side.end[1].norm()), 0.05);
    const double reach = sigmas_ * std::hypot(sigma, own * range / nearest);
    part.keep(inward.dot(a) + reach, inward.dot(b) + reach);
  }
  return !part.empty();
}

/// Whether another face of the same plane begins where an edge is.
bool EdgeJudge::goes_on(const Sighting& own, const SightedEdge& edge, const Sighting& other) const {
  if (own.normal.dot(other.normal) < kSameDirection) return false;
  const Vec3 middle = 0.5 * (edge.end[0] + edge.end[1]);
  const double doubt = sigmas_ * std::hypot(sigma_across(own, middle), sigma_across(other, middle));
  if (std::abs(other.normal.dot(middle) - other.offset()) > doubt) return false;
  const double reach = sigmas_ * std::hypot(noise_.end, noise_.along) * 2.0 + 0.01;
  // What of the edge, moved outwards by that, lies in the other face.
  Part part;
  const Vec3 a = edge.end[0] + reach * edge.outward, b = edge.end[1] + reach * edge.outward;
  for (const SightedEdge& side : other.edges) {
    part.keep(side.outward.dot(side.end[0] - a), side.outward.dot(side.end[0] - b));
    if (part.empty()) return false;
  }
  return true;
}

void EdgeJudge::judge(const View& view, std::vector<Sighting>& frame) const {
  for (Sighting& own : frame) {
    const double doubt = sigma(own);
    for (SightedEdge& edge : own.edges) {
      edge.is_true = (edge.end[1] - edge.end[0]).norm() >= kLeastLength_m && !at_border(view, edge, doubt);
      for (std::size_t i = 0; i < frame.size() && edge.is_true; ++i) {
        const Sighting& other = frame[i];
        if (&other != &own) edge.is_true = !is_hidden(edge, doubt, other) && !goes_on(own, edge, other);
      }
    }
  }
}

}  // namespace hallway::slam_plane::spatial
