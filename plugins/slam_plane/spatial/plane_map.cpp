// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/plane_map.hpp"

#include <algorithm>
#include <cmath>

#include "slam_plane/spatial/outline.hpp"

namespace hallway::slam_plane::spatial {
namespace {

// What pose and map may be wrong by where an edge is seen again, and how many sigmas of noise are added.
constexpr PoseFit::EdgeBounds kSameEdge{.distance_m = 0.1, .angle_rad = 0.02};
constexpr double kSameEdgeSigmas = 4.0;
constexpr double kBeyond_m = 0.05;  // more plane than that beyond an edge, and 4 sigma, disproves it
constexpr double kBeyondSigmas = 4.0;
constexpr std::uint32_t kDisproved = 3;    // observations that do so
constexpr std::uint64_t kForgotten = 100;  // frames after which an edge that is not certain is forgotten
constexpr std::size_t kMostCorners = 24;   // of an outline

/// The middle of what was seen of a plane's edge.
Vec3 middle_of(const PlaneRecord& landmark, const Feature& edge) {
  return landmark.plane.offset() * landmark.plane.normal() + edge.offset() * edge.normal() +
         edge.tangent(3, 0) * edge.tangent.col(0).head<3>();
}

/// Whether an edge of a plane lies on a line: its middle, and by its direction.
bool lies_on(const Feature& line, const PlaneRecord& landmark, const Feature& edge) {
  const Vec3 along = edge.tangent.col(0).head<3>(), middle = middle_of(landmark, edge);
  const double variance = line.variance_at(middle) + edge.variance_at(middle);
  const double turn = line.variance_along(along) + edge.variance_along(along);
  return line.normal().dot(edge.normal()) > 0.0 &&
         std::abs(line.distance(middle)) <
             2.0 * kSameEdge.distance_m + kSameEdgeSigmas * std::sqrt(variance) &&
         std::abs(line.normal().dot(along)) < 2.0 * kSameEdge.angle_rad + kSameEdgeSigmas * std::sqrt(turn);
}

/// Convex hull of points near a plane, seen from where the normal points.
std::vector<Vec3> hull_on_plane(std::span<const Vec3> points, const Feature& plane) {
  const PlaneAxes axes(plane.normal());
  Convex hull = convex_hull(axes.flat(points));
  simplify(hull, kMostCorners);
  return axes.lift(hull, plane.offset());
}

}  // namespace

PlaneMap::PlaneMap(const Options& options)
    : noise_(options.noise()),
      edges_(options),
      corner_sightings_(static_cast<std::uint32_t>(options.corner_sightings)) {}

Index PlaneMap::add_landmark() {
  landmarks.emplace_back();
  active_member_.push_back(kNone);
  ++count_;
  return landmarks.size() - 1;
}

Index PlaneMap::add_submap(const Pose& T_map_submap) {
  submaps.emplace_back().T_map_submap = T_map_submap;
  return submaps.size() - 1;
}

void PlaneMap::activate(Index submap) {
  if (active_ != kNone) {
    for (const Member& member : submaps[active_].members) {
      if (member.landmark != kNone) active_member_[member.landmark] = kNone;
    }
  }
  active_ = submap;
  const std::vector<Member>& members = submaps[submap].members;
  for (Index m = 0; m < members.size(); ++m) {
    if (members[m].landmark != kNone) active_member_[members[m].landmark] = m;
  }
}

const Member* PlaneMap::in_active(Index landmark) const {
  const Index member = active_member_[landmark];
  return member == kNone ? nullptr : &submaps[active_].members[member];
}

Member& PlaneMap::join(Index landmark, const Vec3& normal) {
  std::vector<Member>& members = submaps[active_].members;
  if (active_member_[landmark] == kNone) {
    active_member_[landmark] = members.size();
    landmarks[landmark].members.push_back({active_, members.size()});
    members.emplace_back().landmark = landmark;
    members.back().normal = normal;
  }
  return members[active_member_[landmark]];
}

void PlaneMap::observe(const Pose& T_submap_robot, const AssociatedObservation& observation,
                       std::uint64_t iteration) {
  Member& member = join(observation.landmark, T_submap_robot.q * observation.normal);
  const Mat4 g = plane_transform(T_submap_robot);
  member.evidence += g.transpose() * plane_evidence(observation, noise_) * g;
  ++member.observations;
  ++landmarks[observation.landmark].observations;
  observe_edges(T_submap_robot, observation, iteration, member);
  std::vector<Vec3> points = member.outline;
  append_moved(T_submap_robot, observation.outline, points);
  member.outline = hull_on_plane(points, fit_plane(member.evidence, member.normal));
  const Pose T_map_robot = submaps[active_].T_map_submap * T_submap_robot;
  update(observation.landmark);
  points.clear();
  append_moved(T_map_robot, observation.outline, points);
  extend_outline(observation.landmark, points);
  note_beyond(T_map_robot, observation);
  count_edges(observation.landmark);
}

void PlaneMap::observe_edges(const Pose& T_submap_robot, const AssociatedObservation& observation,
                             std::uint64_t iteration, Member& member) {
  PlaneRecord& landmark = landmarks[observation.landmark];
  const Pose T_map_robot = submaps[active_].T_map_submap * T_submap_robot;
  const Mat4 g = plane_transform(T_submap_robot);
  std::vector<Index> known =
      edges_.find_edges(observation, lines(observation.landmark, true), T_map_robot, kSameEdge);
  for (Index i = 0; i < observation.edges.size(); ++i) {
    const ObservedEdge& edge = observation.edges[i];
    if (!edge.is_true) continue;
    Index& found = known[i];
    for (Index k = 0; k < i && found == kNone; ++k) {
      if (observation.edges[k].is_true && edges_.may_be_one(observation.edges[k], edge)) found = known[k];
    }
    if (found == kNone) {
      found = landmark.edges.size();
      landmark.edges.emplace_back().id = next_edge_++;
      const Vec3 outward = T_map_robot.q * edge.outward;
      landmark.edges.back().line.plane << outward, outward.dot(T_map_robot * edge.end[0]);
    }
    EdgeRecord& record = landmark.edges[found];
    ++record.observations;
    record.last_seen = iteration;
    auto sum = std::ranges::find(member.edges, record.id, &EdgeSum::id);
    if (sum == member.edges.end()) sum = member.edges.insert(sum, {record.id, Mat4::Zero()});
    sum->evidence += g.transpose() * edge_evidence(edge, noise_) * g;
  }
}

void PlaneMap::note_beyond(const Pose& T_map_robot, const AssociatedObservation& observation) {
  const double own = noise_.end_variance();
  for (EdgeRecord& edge : landmarks[observation.landmark].edges) {
    for (const Vec3& p : observation.outline) {
      const Vec3 at = T_map_robot * p;
      const double bound = kBeyond_m + kBeyondSigmas * std::sqrt(own + edge.line.variance_at(at));
      if (edge.line.distance(at) <= bound) continue;
      ++edge.beyond;
      break;
    }
  }
}

int PlaneMap::revoke_edges(Index landmark, std::uint64_t iteration) {
  int revoked = 0;
  const std::vector<EdgeRecord> edges = landmarks[landmark].edges;
  for (const EdgeRecord& edge : edges) {
    const bool disproved = edge.beyond >= kDisproved;
    const bool faded = !is_certain(edge) && edge.last_seen + kForgotten < iteration;
    if (!disproved && !faded) continue;
    if (is_certain(edge)) ++revoked;
    forget_edge(landmark, edge.id);
  }
  if (revoked > 0) {
    count_edges(landmark);
    rebuild(landmark);  // it goes on where it was cut
  }
  return revoked;
}

/// Brings the counts of certain edges up to date.
void PlaneMap::count_edges(Index index) {
  PlaneRecord& landmark = landmarks[index];
  certain_edges_ -= landmark.certain_edges;
  landmark.certain_edges = static_cast<std::uint32_t>(
      std::ranges::count_if(landmark.edges, [this](const EdgeRecord& edge) { return is_certain(edge); }));
  certain_edges_ += landmark.certain_edges;
}

void PlaneMap::forget_edge(Index landmark, EdgeId id) {
  std::erase_if(landmarks[landmark].edges, [&](const EdgeRecord& edge) { return edge.id == id; });
  for (const Membership& at : landmarks[landmark].members) {
    std::erase_if(submaps[at.submap].members[at.member].edges,
                  [&](const EdgeSum& sum) { return sum.id == id; });
  }
}

void PlaneMap::update(Index index) {
  PlaneRecord& landmark = landmarks[index];
  Mat4 sum = Mat4::Zero();
  std::vector<Mat4> edges(landmark.edges.size(), Mat4::Zero());
  Vec3 normal = Vec3::Zero();
  for (const Membership& at : landmark.members) {
    const SubmapRecord& submap = submaps[at.submap];
    const Member& member = submap.members[at.member];
    const Mat4 g = plane_transform(submap.T_map_submap);
    sum += g.transpose() * member.evidence * g;
    normal += member.observations * (submap.T_map_submap.q * member.normal);
    for (const EdgeSum& edge : member.edges) {
      for (Index k = 0; k < edges.size(); ++k) {
        if (landmark.edges[k].id == edge.id) edges[k] += g.transpose() * edge.evidence * g;
      }
    }
  }
  if (sum(3, 3) <= 0.0) return;
  landmark.plane = fit_plane(sum, normal);
  for (Index k = 0; k < edges.size(); ++k) {
    if (edges[k](3, 3) > 0.0)
      landmark.edges[k].line = fit_edge(edges[k], landmark.plane.normal(), landmark.edges[k].line.normal());
  }
}

void PlaneMap::extend_outline(Index index, std::span<const Vec3> points) {
  PlaneRecord& landmark = landmarks[index];
  std::vector<Vec3> all = landmark.outline;
  all.insert(all.end(), points.begin(), points.end());
  landmark.outline = hull_on_plane(all, landmark.plane);
  cut_outline(landmark);
  index_.put(index, landmark.outline);
}

/// The outline ends where the plane does: noise does not carry it over the border of a neighbour in the same plane.
void PlaneMap::cut_outline(PlaneRecord& landmark) const {
  const PlaneAxes axes(landmark.plane.normal());
  Convex cut = axes.flat(landmark.outline);
  for (const EdgeRecord& edge : landmark.edges) {
    if (is_certain(edge)) cut = clip(cut, axes.flat(edge.line.normal()), edge.line.offset());
  }
  if (cut.size() >= 3) landmark.outline = axes.lift(cut, landmark.plane.offset());
}

void PlaneMap::rebuild(Index index) {
  PlaneRecord& landmark = landmarks[index];
  if (!landmark.alive() || landmark.is_dynamic) return;
  // The edges' directions turn with their submaps.
  update(index);
  landmark.outline.clear();
  std::vector<Vec3> points;
  for (const Membership& at : landmark.members)
    append_moved(submaps[at.submap].T_map_submap, submaps[at.submap].members[at.member].outline, points);
  extend_outline(index, points);
}

std::vector<const Feature*> PlaneMap::lines(Index landmark, bool all) const {
  std::vector<const Feature*> lines;
  for (const EdgeRecord& edge : landmarks[landmark].edges)
    lines.push_back(all || is_certain(edge) ? &edge.line : nullptr);
  return lines;
}

Index PlaneMap::resolve(Index landmark) const {
  while (landmark != kNone && !landmarks[landmark].alive()) landmark = landmarks[landmark].merged_into;
  return landmark;
}

void PlaneMap::rename_edge(Index landmark, EdgeId from, EdgeId to) {
  for (const Membership& at : landmarks[landmark].members) {
    for (EdgeSum& sum : submaps[at.submap].members[at.member].edges) {
      if (sum.id == from) sum.id = to;
    }
  }
}

void PlaneMap::set_apart(Index a, Index b) {
  const auto note = [this](Index landmark, Index other) {
    std::vector<Index>& beside = landmarks[landmark].beside;
    const auto at = std::ranges::lower_bound(beside, other);
    if (at == beside.end() || *at != other) beside.insert(at, other);
  };
  note(a, b);
  note(b, a);
}

bool PlaneMap::are_apart(Index a, Index b) const {
  return std::ranges::binary_search(landmarks[a].beside, b);
}

void PlaneMap::merge(Index kept_index, Index gone_index) {
  PlaneRecord& kept = landmarks[kept_index];
  PlaneRecord& gone = landmarks[gone_index];
  for (const Index other : gone.beside) set_apart(kept_index, resolve(other));
  for (const EdgeRecord& edge : gone.edges) {
    const auto duplicate = std::ranges::find_if(kept.edges, [&](const EdgeRecord& own) {
      return lies_on(own.line, gone, edge.line) && lies_on(edge.line, kept, own.line);
    });
    if (duplicate == kept.edges.end()) {
      kept.edges.push_back(edge);
    } else {
      rename_edge(gone_index, edge.id, duplicate->id);
      duplicate->observations += edge.observations;
      duplicate->last_seen = std::max(duplicate->last_seen, edge.last_seen);
    }
  }
  for (const Membership& at : gone.members) {
    SubmapRecord& submap = submaps[at.submap];
    Member& from = submap.members[at.member];
    const auto same = std::ranges::find(kept.members, at.submap, &Membership::submap);
    if (same == kept.members.end()) {
      from.landmark = kept_index;
      kept.members.push_back(at);
      continue;
    }
    Member& to = submap.members[same->member];
    to.evidence += from.evidence;
    to.observations += from.observations;
    to.outline.insert(to.outline.end(), from.outline.begin(), from.outline.end());
    to.outline = hull_on_plane(to.outline, fit_plane(to.evidence, to.normal));
    for (const EdgeSum& sum : from.edges) {
      const auto own = std::ranges::find(to.edges, sum.id, &EdgeSum::id);
      if (own == to.edges.end()) {
        to.edges.push_back(sum);
      } else {
        own->evidence += sum.evidence;
      }
    }
    from.landmark = kNone;
  }
  std::ranges::replace(submaps[active_].first_seen, gone_index, kept_index);
  kept.observations += gone.observations;
  kept.last_seen = std::max(kept.last_seen, gone.last_seen);
  certain_edges_ -= gone.certain_edges;
  gone = PlaneRecord{};
  gone.merged_into = kept_index;
  --count_;
  index_.remove(gone_index);
  active_member_[gone_index] = kNone;
  std::erase(displaced_, gone_index);
  activate(active_);
  rebuild(kept_index);
  count_edges(kept_index);
}

}  // namespace hallway::slam_plane::spatial
