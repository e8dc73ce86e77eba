// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/edge_judge.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hallway::slam_plane::spatial {
namespace {

constexpr double kNearerSigmas = 2.0;    // that something is nearer by, if it hides
constexpr double kOnPlane_m = 0.01;      // and nearer to a plane than this nothing is behind it
constexpr double kLeastLength_m = 0.15;  // of an edge that is clear
constexpr double kSameDirection = 0.99;  // cosine between normals of planes that may lie in one plane

/// Whether both values are below a bound.
bool both_below(double a, double b, double bound_a, double bound_b) {
  return a < bound_a && b < bound_b;
}

}  // namespace

void EdgeJudge::Part::keep(double a, double b) {
  if (a >= 0.0 && b >= 0.0) return;
  if (a < 0.0 && b < 0.0) {
    to = from;
  } else if (a < 0.0) {
    from = std::max(from, a / (a - b));
  } else {
    to = std::min(to, a / (a - b));
  }
}

EdgeJudge::EdgeJudge(const Options& options)
    : noise_(options.noise()), sigmas_(options.corner_sigmas), margin_(radians(options.border_margin_deg)) {}

/// Of where an edge is seen, in any direction.
double EdgeJudge::sigma(const AssociatedObservation& observation) const {
  return std::hypot(std::hypot(noise_.normal, observation.reach_m * noise_.angle), noise_.end, noise_.along);
}

/// Of a landmark's plane at a point of it.
double EdgeJudge::sigma_across(const AssociatedObservation& observation, const Vec3& p) const {
  return std::hypot(noise_.normal, (p - observation.centre).norm() * noise_.angle);
}

bool EdgeJudge::at_border(const View& view, const ObservedEdge& edge, double sigma) const {
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
  if (view.max_range_m > 0.0 &&
      both_below(-depth(a), -depth(b), reach - view.max_range_m, reach - view.max_range_m))
    return true;
  return view.min_range_m > 0.0 &&
         both_below(depth(a), depth(b), reach + view.min_range_m, reach + view.min_range_m);
}

/// Whether a point of an edge, seen next to a nearer plane, is farther away than the side of that plane next to which it is seen. What lies
/// on the side itself touches the plane there.
bool EdgeJudge::beyond_side(const Vec3& p, double doubt, const AssociatedObservation& nearer) {
  const ObservedEdge* next = nullptr;
  double least = 0.0;
  for (const ObservedEdge& side : nearer.edges) {
    const Vec3 normal = side.end[0].cross(side.end[1]);
    if (normal.norm() < 1e-12) continue;
    const double off = std::abs(normal.normalized().dot(p));
    if (next != nullptr && off >= least) continue;
    least = off;
    next = &side;
  }
  if (next == nullptr) return false;
  const Vec3 along = (next->end[1] - next->end[0]).normalized();
  const Vec3 away = p - next->end[0] - along.dot(p - next->end[0]) * along;
  return away.norm() > doubt && away.dot(p) > 0.0;
}

/// What of an edge may be the border of a plane's shadow: what lies within its outline as seen from the robot, widened by what noise may do, if any
/// of that is behind it: behind its plane, or past the side by which it is seen. A shadow begins where what casts it touches the plane, and is
/// a shadow there too, so that one place that is clearly behind tells of all of it.
EdgeJudge::Part EdgeJudge::hidden_part(const AssociatedObservation& own, const ObservedEdge& edge,
                                       double sigma, const AssociatedObservation& nearer) const {
  constexpr Part kNothing{1.0, 0.0};
  const Vec3 &a = edge.end[0], &b = edge.end[1];
  Part part;
  const double of_nearer = EdgeJudge::sigma(nearer);
  const double range = std::max(a.norm(), b.norm());
  for (const ObservedEdge& side : nearer.edges) {
    // The plane through the robot's eye and the side; inward.
    const Vec3 normal = side.end[0].cross(side.end[1]);
    if (normal.norm() < 1e-12) continue;
    const Vec3 inward = normal.normalized() * (normal.dot(nearer.centre) < 0.0 ? -1.0 : 1.0);
    const double nearest = std::max(std::min(side.end[0].norm(), side.end[1].norm()), 0.05);
    const double reach = sigmas_ * std::hypot(sigma, of_nearer * range / nearest);
    part.keep(inward.dot(a) + reach, inward.dot(b) + reach);
    if (part.empty()) return kNothing;
  }
  const auto behind = [&](const Vec3& p) { return nearer.offset() - nearer.normal.dot(p); };
  const auto doubt = [&](const Vec3& p) {
    return kNearerSigmas * std::hypot(sigma, sigma_across(nearer, p));
  };
  bool hides = false;
  for (const double share : {part.from, part.to}) {
    const Vec3 p = a + share * (b - a);
    hides = hides || behind(p) > doubt(p) ||
            (behind(p) > kOnPlane_m && !may_share_plane(own, nearer, p) &&
             beyond_side(p, sigmas_ * std::hypot(sigma, of_nearer), nearer));
  }
  if (!hides) return kNothing;
  part.keep(behind(a) + doubt(a), behind(b) + doubt(b));
  return part;
}

/// Whether two planes may lie in one plane, at a point of one of them.
bool EdgeJudge::may_share_plane(const AssociatedObservation& own, const AssociatedObservation& other,
                                const Vec3& p) const {
  const double doubt = sigmas_ * std::hypot(sigma_across(own, p), sigma_across(other, p));
  return own.normal.dot(other.normal) >= kSameDirection &&
         std::abs(other.normal.dot(p) - other.offset()) <= doubt;
}

/// Where another plane of the same plane begins where an edge is.
EdgeJudge::Part EdgeJudge::continued_part(const AssociatedObservation& own, const ObservedEdge& edge,
                                          const AssociatedObservation& other) const {
  constexpr Part kNothing{1.0, 0.0};
  if (!may_share_plane(own, other, 0.5 * (edge.end[0] + edge.end[1]))) return kNothing;
  const double reach = sigmas_ * std::hypot(noise_.end, noise_.along) * 2.0 + 0.01;
  // What of the edge, moved outwards by that, lies in the other plane or beside it.
  Part part;
  const Vec3 a = edge.end[0] + reach * edge.outward, b = edge.end[1] + reach * edge.outward;
  for (const ObservedEdge& side : other.edges)
    part.keep(reach + side.outward.dot(side.end[0] - a), reach + side.outward.dot(side.end[0] - b));
  return part;
}

bool EdgeJudge::is_clear(const std::vector<AssociatedObservation>& frame, const AssociatedObservation& own,
                         const ObservedEdge& edge) const {
  const double length = (edge.end[1] - edge.end[0]).norm(), doubt = sigma(own);
  std::vector<Part> taken;
  for (const AssociatedObservation& other : frame) {
    if (&other == &own) continue;
    for (const Part& part : {hidden_part(own, edge, doubt, other), continued_part(own, edge, other)}) {
      if (!part.empty()) taken.push_back(part);
    }
  }
  std::ranges::sort(taken, [](const Part& a, const Part& b) { return a.from < b.from; });
  double clear_from = 0.0;
  for (const Part& part : taken) {
    if ((part.from - clear_from) * length >= kLeastLength_m) return true;
    clear_from = std::max(clear_from, part.to);
  }
  return (1.0 - clear_from) * length >= kLeastLength_m;
}

void EdgeJudge::judge(const View& view, std::vector<AssociatedObservation>& frame) const {
  for (AssociatedObservation& own : frame) {
    const double doubt = sigma(own);
    for (ObservedEdge& edge : own.edges)
      edge.is_true = !at_border(view, edge, doubt) && is_clear(frame, own, edge);
  }
}

}  // namespace hallway::slam_plane::spatial
