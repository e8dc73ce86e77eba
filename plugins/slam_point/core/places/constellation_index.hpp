// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <vector>

#include "slam_point/core/submaps/submap_graph.hpp"

namespace hallway::slam_point {

/// The sides of a triangle, longest first [m].
using Sides = std::array<double, 3>;

/// A triangle with its vertices in a fixed order: vertex i lies opposite side i, so the longest side lies opposite vertex 0.
struct Triangle {
  std::array<Index, 3> vertices{kNone, kNone, kNone};  ///< numbers of points, as the maker counts them
  Sides sides{};
};

/// The triangle of three points, whose numbers are `vertices`. Of equal sides the one opposite the earlier point comes first.
Triangle make_triangle(const std::array<Index, 3>& vertices, const std::array<Vec3, 3>& points);

/// The k nearest of a point's neighbours, nearest first; equally near ones by number. O(k) to add one.
class NearestNeighbours {
 public:
  static constexpr std::size_t kMost = 6;

  /// Takes a neighbour in when it is among the nearest `most` (at most kMost) and not there yet. Says whether it did.
  bool add(Index neighbour, double distance2, std::size_t most = kMost);
  /// Whether what is so far off may be among the nearest kMost.
  bool reaches(double distance2) const { return size_ < kMost || distance2 <= distances2_[kMost - 1]; }
  std::size_t size() const { return size_; }
  Index operator[](std::size_t i) const { return neighbours_[i]; }

 private:
  std::array<Index, kMost> neighbours_{};
  std::array<double, kMost> distances2_{};
  std::size_t size_ = 0;
};

/// Triangles of neighbouring landmarks, found by their sides: rigid motion does not change them, so what is in view can be
/// found again without any idea of where the sensor is. A landmark makes triangles with pairs of its nearest neighbours.
///
/// Grows with the map as submaps close, a few landmarks a call; looking up costs O(triangles of about these sides).
/// Memory: about 70 bytes a triangle, some ten triangles a landmark.
class ConstellationIndex {
 public:
  /// `graph` must outlive it. `tolerance_m`: how much each side of what is looked up may differ [m]. `min_observations`: of a landmark that is indexed.
  ConstellationIndex(const SubmapGraph& graph, double tolerance_m, std::uint32_t min_observations);

  /// Takes note of a submap that closed: its landmarks are to be indexed. O(members).
  void note(Index submap);

  /// Indexes at most `landmarks` of those noted, each O(members of its submap). In the order noted.
  void advance(int landmarks);

  /// Indexes `landmarks` of a submap at once, however seldom they were seen: the active one, whose landmarks are in no closed
  /// one yet. O(landmarks * members).
  void add_now(Index submap, int landmarks);

  /// Calls visit(triangle) for each triangle of landmarks whose sides all differ by at most the tolerance from `sides`, until it
  /// returns false. In the order of a history that is the same for the same input.
  template <typename Visit>
  void visit_like(const Sides& sides, Visit&& visit) const {
    if (heads_.empty()) return;
    const Cell low = cell_of(sides, -0.5);
    for (int corner = 0; corner < 8; ++corner) {
      const Cell cell{low[0] + (corner & 1), low[1] + ((corner >> 1) & 1), low[2] + ((corner >> 2) & 1)};
      for (std::uint32_t i = heads_[bucket_of(cell)]; i != kEnd; i = entries_[i].next) {
        if (is_in(entries_[i], cell) && is_like(entries_[i].triangle.sides, sides) &&
            !visit(entries_[i].triangle))
          return;
      }
    }
  }

  double tolerance() const { return tolerance_; }
  std::size_t triangles() const { return entries_.size(); }
  void clear();

 private:
  using Cell = std::array<std::int32_t, 3>;
  static constexpr std::uint32_t kEnd = 0xffffffffu;

  struct Entry {
    Triangle triangle;
    Cell cell{};
    std::uint32_t next = kEnd;        // in the same bucket of heads_
    std::uint32_t next_named = kEnd;  // in the same bucket of named_
  };
  struct Work {
    Index submap = kNone;
    Index member = kNone;
  };
  struct Known {
    NearestNeighbours neighbours;
    std::uint8_t times = 0;  // that it was looked at
  };

  void index_landmark(const Work& work, std::uint32_t min_observations);
  void add_triangle(const std::array<Index, 3>& landmarks);
  static bool is_in(const Entry& entry, const Cell& cell) {
    return entry.cell[0] == cell[0] && entry.cell[1] == cell[1] && entry.cell[2] == cell[2];
  }
  bool is_like(const Sides& a, const Sides& b) const {
    return std::abs(a[0] - b[0]) <= tolerance_ && std::abs(a[1] - b[1]) <= tolerance_ &&
           std::abs(a[2] - b[2]) <= tolerance_;
  }
  Cell cell_of(const Sides& sides, double shift) const;
  std::size_t bucket_of(const Cell& cell) const;
  std::size_t bucket_of(const std::array<Index, 3>& numbers) const;
  bool is_known(const Entry& entry) const;
  void link(std::uint32_t i);
  void grow();

  const SubmapGraph& graph_;
  double tolerance_;
  std::uint32_t min_observations_;
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> heads_;  // by sides
  std::vector<std::uint32_t> named_;  // by vertices, of the same size
  std::vector<Known> known_;          // landmark -> what is known of it
  std::deque<Work> work_;
};

}  // namespace hallway::slam_point
