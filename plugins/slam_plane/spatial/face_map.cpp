// SPDX-License-Identifier: MIT
#include "slam_plane/spatial/face_map.hpp"

#include <algorithm>
#include <cmath>

#include "slam_plane/spatial/polygon.hpp"

namespace hallway::slam_plane::spatial {
namespace {

// What pose and map may be wrong by where an edge is seen again, and how many sigmas of noise are added.
constexpr PoseFit::EdgeBounds kSameEdge{.distance_m = 0.1, .angle_rad = 0.02};
constexpr double kSameEdgeSigmas = 4.0;
constexpr double kBeyond_m = 0.05;  // more face than that beyond an edge, and 4 sigma, disproves it
constexpr double kBeyondSigmas = 4.0;
constexpr std::uint32_t kDisproved = 3;    // sightings that do so
constexpr std::uint64_t kForgotten = 100;  // frames after which an edge that is not certain is forgotten
constexpr std::size_t kMostCorners = 24;   // of an outline

/// The middle of what was seen of a face's edge.
Vec3 middle_of(const FaceRecord& face, const Feature& edge) {
  return face.plane.offset() * face.plane.normal() + edge.offset() * edge.normal() +
         edge.tangent(3, 0) * edge.tangent.col(0).head<3>();
}

/// Whether an edge of a face lies on a line: its middle, and by its direction.
bool lies_on(const Feature& line, const FaceRecord& face, const Feature& edge) {
  const Vec3 along = edge.tangent.col(0).head<3>(), middle = middle_of(face, edge);
  const double variance = line.variance_at(middle) + edge.variance_at(middle);
  const double turn = line.variance_along(along) + edge.variance_along(along);
  return line.normal().dot(edge.normal()) > 0.0 &&
         std::abs(line.distance(middle)) <
             2.0 * kSameEdge.distance_m + kSameEdgeSigmas * std::sqrt(variance) &&
         std::abs(line.normal().dot(along)) < 2.0 * kSameEdge.angle_rad + kSameEdgeSigmas * std::sqrt(turn);
}

}  // namespace

std::vector<Vec3> hull_on_plane(std::span<const Vec3> points, const Feature& plane, std::size_t most) {
  const PlaneAxes axes(plane.normal());
  Polygon hull = convex_hull(flattened(points, axes));
  simplify(hull, most);
  std::vector<Vec3> lifted;
  for (const Vec2& p : hull) lifted.push_back(axes.lift(p, plane.offset()));
  return lifted;
}

FaceMap::FaceMap(const Options& options)
    : noise_(options.noise()),
      edges_(options),
      corner_sightings_(static_cast<std::uint32_t>(options.corner_sightings)) {}

Index FaceMap::add_face() {
  faces.emplace_back();
  active_member_.push_back(kNone);
  ++count_;
  return faces.size() - 1;
}

Index FaceMap::add_submap(const Pose3& T_map_submap) {
  submaps.emplace_back().T_map_submap = T_map_submap;
  return submaps.size() - 1;
}

void FaceMap::activate(Index submap) {
  if (active_ != kNone) {
    for (const Member& member : submaps[active_].members) {
      if (member.face != kNone) active_member_[member.face] = kNone;
    }
  }
  active_ = submap;
  const std::vector<Member>& members = submaps[submap].members;
  for (Index m = 0; m < members.size(); ++m) {
    if (members[m].face != kNone) active_member_[members[m].face] = m;
  }
}

const Member* FaceMap::in_active(Index face) const {
  const Index member = active_member_[face];
  return member == kNone ? nullptr : &submaps[active_].members[member];
}

Member& FaceMap::join(Index face, const Vec3& normal) {
  std::vector<Member>& members = submaps[active_].members;
  if (active_member_[face] == kNone) {
    active_member_[face] = members.size();
    faces[face].members.push_back({active_, members.size()});
    members.emplace_back().face = face;
    members.back().normal = normal;
  }
  return members[active_member_[face]];
}

void FaceMap::observe(const Pose3& T_submap_robot, const Sighting& sighting, std::uint64_t iteration) {
  Member& member = join(sighting.face, T_submap_robot.q * sighting.normal);
  const Mat4 g = plane_transform(T_submap_robot);
  member.evidence += g.transpose() * plane_evidence(sighting, noise_) * g;
  ++member.observations;
  ++faces[sighting.face].observations;
  observe_edges(T_submap_robot, sighting, iteration, member);
  std::vector<Vec3> points = member.outline;
  for (const Vec3& p : sighting.outline) points.push_back(T_submap_robot * p);
  member.outline = hull_on_plane(points, fit_plane(member.evidence, member.normal), kMostCorners);
  const Pose3 T_map_robot = submaps[active_].T_map_submap * T_submap_robot;
  update(sighting.face);
  points.clear();
  for (const Vec3& p : sighting.outline) points.push_back(T_map_robot * p);
  extend_outline(sighting.face, points);
  note_beyond(T_map_robot, sighting);
  count_edges(sighting.face);
}

void FaceMap::observe_edges(const Pose3& T_submap_robot, const Sighting& sighting, std::uint64_t iteration,
                            Member& member) {
  FaceRecord& face = faces[sighting.face];
  const Pose3 T_map_robot = submaps[active_].T_map_submap * T_submap_robot;
  const Mat4 g = plane_transform(T_submap_robot);
  std::vector<Index> known = edges_.find_edges(sighting, lines(sighting.face, true), T_map_robot, kSameEdge);
  for (Index i = 0; i < sighting.edges.size(); ++i) {
    const SightedEdge& edge = sighting.edges[i];
    if (!edge.is_true) continue;
    Index& found = known[i];
    for (Index k = 0; k < i && found == kNone; ++k) {
      if (sighting.edges[k].is_true && edges_.may_be_one(sighting.edges[k], edge)) found = known[k];
    }
    if (found == kNone) {
      found = face.edges.size();
      face.edges.emplace_back().id = next_edge_++;
      const Vec3 outward = T_map_robot.q * edge.outward;
      face.edges.back().line.plane << outward, outward.dot(T_map_robot * edge.end[0]);
    }
    EdgeRecord& record = face.edges[found];
    ++record.sightings;
    record.last_seen = iteration;
    auto sum = std::find_if(member.edges.begin(), member.edges.end(),
                            [&](const EdgeSum& s) { return s.id == record.id; });
    if (sum == member.edges.end()) sum = member.edges.insert(sum, {record.id, Mat4::Zero()});
    sum->evidence += g.transpose() * edge_evidence(edge, noise_) * g;
  }
}

void FaceMap::note_beyond(const Pose3& T_map_robot, const Sighting& sighting) {
  const double own = noise_.end * noise_.end + noise_.along * noise_.along;
  for (EdgeRecord& edge : faces[sighting.face].edges) {
    for (const Vec3& p : sighting.outline) {
      const Vec3 at = T_map_robot * p;
      const double bound = kBeyond_m + kBeyondSigmas * std::sqrt(own + edge.line.variance_at(at));
      if (edge.line.distance(at) <= bound) continue;
      ++edge.beyond;
      break;
    }
  }
}

int FaceMap::revoke_edges(Index face, std::uint64_t iteration) {
  int revoked = 0;
  const std::vector<EdgeRecord> edges = faces[face].edges;
  for (const EdgeRecord& edge : edges) {
    const bool disproved = edge.beyond >= kDisproved;
    const bool faded = !is_certain(edge) && edge.last_seen + kForgotten < iteration;
    if (!disproved && !faded) continue;
    if (is_certain(edge)) ++revoked;
    forget_edge(face, edge.id);
  }
  if (revoked > 0) {
    count_edges(face);
    rebuild(face);  // it goes on where it was cut
  }
  return revoked;
}

/// Brings the counts of certain edges up to date.
void FaceMap::count_edges(Index index) {
  FaceRecord& face = faces[index];
  certain_edges_ -= face.certain_edges;
  face.certain_edges = static_cast<std::uint32_t>(std::count_if(
      face.edges.begin(), face.edges.end(), [this](const EdgeRecord& edge) { return is_certain(edge); }));
  certain_edges_ += face.certain_edges;
}

void FaceMap::forget_edge(Index face, EdgeId id) {
  std::erase_if(faces[face].edges, [&](const EdgeRecord& edge) { return edge.id == id; });
  for (const MemberAt& at : faces[face].members) {
    std::erase_if(submaps[at.submap].members[at.member].edges,
                  [&](const EdgeSum& sum) { return sum.id == id; });
  }
}

void FaceMap::update(Index index) {
  FaceRecord& face = faces[index];
  Mat4 sum = Mat4::Zero();
  std::vector<Mat4> edges(face.edges.size(), Mat4::Zero());
  Vec3 normal = Vec3::Zero();
  for (const MemberAt& at : face.members) {
    const SubmapRecord& submap = submaps[at.submap];
    const Member& member = submap.members[at.member];
    const Mat4 g = plane_transform(submap.T_map_submap);
    sum += g.transpose() * member.evidence * g;
    normal += member.observations * (submap.T_map_submap.q * member.normal);
    for (const EdgeSum& edge : member.edges) {
      for (Index k = 0; k < edges.size(); ++k) {
        if (face.edges[k].id == edge.id) edges[k] += g.transpose() * edge.evidence * g;
      }
    }
  }
  if (sum(3, 3) <= 0.0) return;
  face.plane = fit_plane(sum, normal);
  for (Index k = 0; k < edges.size(); ++k) {
    if (edges[k](3, 3) > 0.0)
      face.edges[k].line = fit_edge(edges[k], face.plane.normal(), face.edges[k].line.normal());
  }
}

void FaceMap::extend_outline(Index index, std::span<const Vec3> points) {
  FaceRecord& face = faces[index];
  std::vector<Vec3> all = face.outline;
  all.insert(all.end(), points.begin(), points.end());
  face.outline = hull_on_plane(all, face.plane, kMostCorners);
  cut_outline(face);
  index_.put(index, face.outline);
}

/// The outline ends where the face does: noise does not carry it over the border of a neighbour in the same plane.
void FaceMap::cut_outline(FaceRecord& face) const {
  const PlaneAxes axes(face.plane.normal());
  Polygon cut = flattened(face.outline, axes);
  for (const EdgeRecord& edge : face.edges) {
    if (is_certain(edge)) cut = clip(cut, axes.flat(edge.line.normal()), edge.line.offset());
  }
  if (cut.size() < 3) return;
  face.outline.clear();
  for (const Vec2& p : cut) face.outline.push_back(axes.lift(p, face.plane.offset()));
}

void FaceMap::rebuild(Index index) {
  FaceRecord& face = faces[index];
  if (!face.alive() || face.is_dynamic) return;
  // The edges' directions turn with their submaps.
  update(index);
  face.outline.clear();
  std::vector<Vec3> points;
  for (const MemberAt& at : face.members) {
    for (const Vec3& p : submaps[at.submap].members[at.member].outline)
      points.push_back(submaps[at.submap].T_map_submap * p);
  }
  extend_outline(index, points);
}

std::vector<const Feature*> FaceMap::lines(Index face, bool all) const {
  std::vector<const Feature*> lines;
  for (const EdgeRecord& edge : faces[face].edges)
    lines.push_back(all || is_certain(edge) ? &edge.line : nullptr);
  return lines;
}

Index FaceMap::resolve(Index face) const {
  while (face != kNone && !faces[face].alive()) face = faces[face].merged_into;
  return face;
}

void FaceMap::rename_edge(Index face, EdgeId from, EdgeId to) {
  for (const MemberAt& at : faces[face].members) {
    for (EdgeSum& sum : submaps[at.submap].members[at.member].edges) {
      if (sum.id == from) sum.id = to;
    }
  }
}

void FaceMap::set_apart(Index a, Index b) {
  const auto note = [this](Index face, Index other) {
    std::vector<Index>& beside = faces[face].beside;
    const auto at = std::lower_bound(beside.begin(), beside.end(), other);
    if (at == beside.end() || *at != other) beside.insert(at, other);
  };
  note(a, b);
  note(b, a);
}

bool FaceMap::are_apart(Index a, Index b) const {
  return std::binary_search(faces[a].beside.begin(), faces[a].beside.end(), b);
}

void FaceMap::merge(Index kept_index, Index gone_index) {
  FaceRecord& kept = faces[kept_index];
  FaceRecord& gone = faces[gone_index];
  for (const Index other : gone.beside) set_apart(kept_index, resolve(other));
  for (const EdgeRecord& edge : gone.edges) {
    const auto twin = std::find_if(kept.edges.begin(), kept.edges.end(), [&](const EdgeRecord& own) {
      return lies_on(own.line, gone, edge.line) && lies_on(edge.line, kept, own.line);
    });
    if (twin == kept.edges.end()) {
      kept.edges.push_back(edge);
    } else {
      rename_edge(gone_index, edge.id, twin->id);
      twin->sightings += edge.sightings;
      twin->last_seen = std::max(twin->last_seen, edge.last_seen);
    }
  }
  for (const MemberAt& at : gone.members) {
    SubmapRecord& submap = submaps[at.submap];
    Member& from = submap.members[at.member];
    const auto same = std::find_if(kept.members.begin(), kept.members.end(),
                                   [&](const MemberAt& own) { return own.submap == at.submap; });
    if (same == kept.members.end()) {
      from.face = kept_index;
      kept.members.push_back(at);
      continue;
    }
    Member& to = submap.members[same->member];
    to.evidence += from.evidence;
    to.observations += from.observations;
    to.outline.insert(to.outline.end(), from.outline.begin(), from.outline.end());
    to.outline = hull_on_plane(to.outline, fit_plane(to.evidence, to.normal), kMostCorners);
    for (const EdgeSum& sum : from.edges) {
      const auto own =
          std::find_if(to.edges.begin(), to.edges.end(), [&](const EdgeSum& s) { return s.id == sum.id; });
      if (own == to.edges.end()) {
        to.edges.push_back(sum);
      } else {
        own->evidence += sum.evidence;
      }
    }
    from.face = kNone;
  }
  std::replace(submaps[active_].first_seen.begin(), submaps[active_].first_seen.end(), gone_index,
               kept_index);
  kept.observations += gone.observations;
  kept.last_seen = std::max(kept.last_seen, gone.last_seen);
  certain_edges_ -= gone.certain_edges;
  gone = FaceRecord{};
  gone.merged_into = kept_index;
  --count_;
  index_.remove(gone_index);
  active_member_[gone_index] = kNone;
  std::erase(strayed_, gone_index);
  activate(active_);
  rebuild(kept_index);
  count_edges(kept_index);
}

}  // namespace hallway::slam_plane::spatial
