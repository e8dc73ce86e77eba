// SPDX-License-Identifier: MIT
#include "slam_point/core/places/constellation_index.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hallway::slam_point {
namespace {

constexpr std::size_t kFirstBuckets = 1024;
constexpr std::uint8_t kLooks = 3;  // at a landmark: later submaps may show nearer neighbours
constexpr double kMaxSideCell = 1e9;

}  // namespace

Triangle make_triangle(const std::array<Index, 3>& vertices, const std::array<Vec3, 3>& points) {
  Sides sides;
  for (std::size_t i = 0; i < 3; ++i) sides[i] = (points[(i + 1) % 3] - points[(i + 2) % 3]).norm();
  std::array<std::size_t, 3> order{0, 1, 2};
  // By falling sides, equal ones in their order.
  if (sides[order[0]] < sides[order[1]]) std::swap(order[0], order[1]);
  if (sides[order[1]] < sides[order[2]]) std::swap(order[1], order[2]);
  if (sides[order[0]] < sides[order[1]]) std::swap(order[0], order[1]);
  Triangle triangle;
  for (std::size_t i = 0; i < 3; ++i) {
    triangle.vertices[i] = vertices[order[i]];
    triangle.sides[i] = sides[order[i]];
  }
  return triangle;
}

bool NearestNeighbours::add(Index neighbour, double distance2, std::size_t most) {
  std::size_t at = size_;
  for (std::size_t i = 0; i < size_; ++i) {
    if (neighbours_[i] == neighbour) return false;
  }
  while (at > 0 && (distance2 < distances2_[at - 1] ||
                    (distance2 == distances2_[at - 1] && neighbour < neighbours_[at - 1]))) {
    --at;
  }
  if (at >= most) return false;
  size_ = std::min(size_ + 1, most);
  for (std::size_t i = size_ - 1; i > at; --i) {
    neighbours_[i] = neighbours_[i - 1];
    distances2_[i] = distances2_[i - 1];
  }
  neighbours_[at] = neighbour;
  distances2_[at] = distance2;
  return true;
}

ConstellationIndex::ConstellationIndex(const SubmapGraph& graph, double tolerance_m,
                                       std::uint32_t min_observations)
    : graph_(graph), tolerance_(tolerance_m), min_observations_(min_observations) {}

void ConstellationIndex::note(Index submap) {
  const std::vector<Member>& members = graph_.submaps[submap].members;
  known_.resize(graph_.landmarks.size());
  for (Index m = 0; m < members.size(); ++m) {
    const Index landmark = members[m].landmark;
    if (members[m].count == 0 || graph_.landmarks[landmark].count < min_observations_ ||
        known_[landmark].times >= kLooks) {
      continue;
    }
    ++known_[landmark].times;
    work_.push_back({submap, m});
  }
}

void ConstellationIndex::advance(int landmarks) {
  for (; landmarks > 0 && !work_.empty(); --landmarks) {
    index_landmark(work_.front(), min_observations_);
    work_.pop_front();
  }
}

void ConstellationIndex::add_now(Index submap, int landmarks) {
  // The last ones are those that came into view last.
  const auto members = static_cast<Index>(graph_.submaps[submap].members.size());
  const Index first = members - std::min(members, static_cast<Index>(landmarks));
  for (Index m = first; m < members; ++m) index_landmark({submap, m}, 1);
}

void ConstellationIndex::index_landmark(const Work& work, std::uint32_t min_observations) {
  const std::vector<Member>& members = graph_.submaps[work.submap].members;
  if (work.member >= members.size() || members[work.member].count == 0) return;
  const Index centre = members[work.member].landmark;
  const Vec3& place = graph_.landmarks[centre].position;
  known_.resize(graph_.landmarks.size());
  NearestNeighbours near;
  // Distances in the submap: its members lie together in memory, and nearly all are too far off to be looked at further.
  const Vec3& mean = members[work.member].mean;
  for (const Member& member : members) {
    const double distance2 = (member.mean - mean).squaredNorm();
    if (!near.reaches(distance2) || member.landmark == centre || member.count == 0) continue;
    if (graph_.landmarks[member.landmark].count >= min_observations) near.add(member.landmark, distance2);
  }
  NearestNeighbours& known = known_[centre].neighbours;
  for (std::size_t i = 0; i < near.size(); ++i) {
    const double distance2 = (graph_.landmarks[near[i]].position - place).squaredNorm();
    if (!known.add(near[i], distance2)) continue;
    for (std::size_t j = 0; j < known.size(); ++j) {
      if (known[j] != near[i]) add_triangle({centre, near[i], known[j]});
    }
  }
}

void ConstellationIndex::add_triangle(const std::array<Index, 3>& landmarks) {
  std::array<Vec3, 3> points;
  for (std::size_t i = 0; i < 3; ++i) {
    if (graph_.landmarks[landmarks[i]].count == 0) return;
    points[i] = graph_.landmarks[landmarks[i]].position;
  }
  Entry entry;
  entry.triangle = make_triangle(landmarks, points);
  if (entry.triangle.sides[2] < 2.0 * tolerance_) return;
  entry.cell = cell_of(entry.triangle.sides, 0.0);
  if (entries_.size() >= heads_.size()) grow();
  if (is_known(entry)) return;
  entries_.push_back(entry);
  link(static_cast<std::uint32_t>(entries_.size() - 1));
}

/// Whether a triangle of the same landmarks with the same sides, by their cell, is there. Many have sides like it, so it is
/// looked for by its vertices.
bool ConstellationIndex::is_known(const Entry& entry) const {
  for (std::uint32_t i = named_[bucket_of(entry.triangle.vertices)]; i != kEnd; i = entries_[i].next_named) {
    if (entries_[i].triangle.vertices == entry.triangle.vertices && entries_[i].cell == entry.cell)
      return true;
  }
  return false;
}

void ConstellationIndex::link(std::uint32_t i) {
  Entry& entry = entries_[i];
  std::uint32_t& head = heads_[bucket_of(entry.cell)];
  entry.next = head;
  head = i;
  std::uint32_t& named = named_[bucket_of(entry.triangle.vertices)];
  entry.next_named = named;
  named = i;
}

ConstellationIndex::Cell ConstellationIndex::cell_of(const Sides& sides, double shift) const {
  // Cells of twice the tolerance: what is within it of `sides` lies in two along each axis.
  Cell cell;
  for (std::size_t i = 0; i < 3; ++i) {
    const double scaled = std::floor(sides[i] / (2.0 * tolerance_) + shift);
    cell[i] = static_cast<std::int32_t>(std::clamp(scaled, -kMaxSideCell, kMaxSideCell));
  }
  return cell;
}

std::size_t ConstellationIndex::bucket_of(const Cell& cell) const {
  std::array<Index, 3> numbers;
  for (std::size_t i = 0; i < 3; ++i) numbers[i] = static_cast<Index>(cell[i]);
  return bucket_of(numbers);
}

std::size_t ConstellationIndex::bucket_of(const std::array<Index, 3>& numbers) const {
  std::uint64_t h = numbers[0];
  h = (h ^ numbers[1] * 0x9e3779b97f4a7c15u) * 0xbf58476d1ce4e5b9u;
  h = (h ^ numbers[2] * 0x94d049bb133111ebu) * 0xbf58476d1ce4e5b9u;
  return static_cast<std::size_t>(h >> 32) & (heads_.size() - 1);
}

void ConstellationIndex::grow() {
  heads_.assign(std::max(kFirstBuckets, 2 * heads_.size()), kEnd);
  named_.assign(heads_.size(), kEnd);
  for (std::uint32_t i = 0; i < entries_.size(); ++i) link(i);
}

void ConstellationIndex::clear() {
  entries_.clear();
  heads_.clear();
  named_.clear();
  known_.clear();
  work_.clear();
}

}  // namespace hallway::slam_point
