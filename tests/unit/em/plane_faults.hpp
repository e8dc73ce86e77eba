// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "plane_scene.hpp"

namespace hallway::em::planted {

/// One thing wrong with an answer: "missing", "extra", "misaligned", "stolen" (plane takes points of `from`), "unattached" (plane ends
/// before `from`).
struct Fault {
  std::string kind, plane, from;
};

/// Compares an answer with the scene's planes.
class FaultFinder {
 public:
  FaultFinder(const Scene& scene, const LabelledCloud& cloud, const Extraction& answer)
      : scene_(scene), cloud_(cloud), answer_(answer), found_(scene.planes.size()) {
    match();
  }

  std::vector<Fault> faults() const {
    std::vector<Fault> faults;
    for (std::size_t i = 0; i < found_.size(); ++i) {
      if (!found_[i]) {
        faults.push_back({"missing", scene_.planes[i].name, ""});
        continue;
      }
      if (misaligned(i)) faults.push_back({"misaligned", scene_.planes[i].name, ""});
      for (std::size_t j = 0; j < found_.size(); ++j) {
        if (j != i && steals(i, j))
          faults.push_back({"stolen", scene_.planes[i].name, scene_.planes[j].name});
      }
    }
    const auto extra =
        static_cast<std::ptrdiff_t>(answer_.planes.size()) -
        std::count_if(found_.begin(), found_.end(), [](const auto& f) { return f.has_value(); });
    for (std::ptrdiff_t i = 0; i < extra; ++i) faults.push_back({"extra", "", ""});
    for (const ExpectedPlane& expected : scene_.expected) {
      for (const std::string& other : expected.meets) {
        if (unattached(expected.plane, other)) faults.push_back({"unattached", expected.plane, other});
      }
    }
    return faults;
  }

 private:
  static constexpr double kLeastIou = 0.3;  // half of a plane is still that plane
  static constexpr double kMostTurnDeg = 5.0;
  static constexpr double kSlabSigmas = 3.0;
  static constexpr double kMostGapSigmas = 2.0;
  static constexpr double kMostStolen = 0.01;  // share of the other plane's points

  double iou(std::size_t truth, std::size_t plane) const {
    std::size_t both = 0;
    for (const PointIndex i : answer_.planes[plane].members) both += std::size_t{cloud_.labels[i] == truth};
    const std::size_t either = scene_.planes[truth].points + answer_.planes[plane].members.size() - both;
    return static_cast<double>(both) / static_cast<double>(either);
  }

  void match() {
    std::vector<bool> taken(answer_.planes.size(), false);
    while (true) {
      double best = kLeastIou;
      std::size_t truth = 0, plane = taken.size();
      for (std::size_t i = 0; i < found_.size(); ++i) {
        for (std::size_t j = 0; j < taken.size() && !found_[i]; ++j) {
          if (taken[j] || iou(i, j) < best) continue;
          best = iou(i, j);
          truth = i;
          plane = j;
        }
      }
      if (plane == taken.size()) return;
      found_[truth] = plane;
      taken[plane] = true;
    }
  }

  const Plane& answer(std::size_t truth) const { return answer_.planes[*found_[truth]]; }

  bool misaligned(std::size_t i) const {
    const ScenePlane& truth = scene_.planes[i];
    const double cosine = std::abs(truth.normal.dot(answer(i).normal));
    const double off = std::abs(answer(i).normal.dot(truth.centre) - answer(i).offset);
    return cosine < std::cos(kMostTurnDeg * M_PI / 180.0) || off > kSlabSigmas * truth.sigma;
  }

  // Points of `j` that the plane found for `i` covers, beyond where `i` is.
  bool steals(std::size_t i, std::size_t j) const {
    const ScenePlane& own = scene_.planes[i];
    const double margin = 5.0 * own.sigma;
    std::size_t stolen = 0;
    for (std::size_t k = 0; k < cloud_.points.size(); ++k) {
      if (cloud_.labels[k] != j) continue;
      const Vec3 d = cloud_.points[k] - own.centre;
      const bool at_home = std::abs(d.dot(own.axis_u)) <= own.half_u + margin &&
                           std::abs(d.dot(own.axis_v())) <= own.half_v + margin;
      stolen += std::size_t{!at_home && covers(answer(i), cloud_.points[k], kSlabSigmas * own.sigma)};
    }
    return static_cast<double>(stolen) > kMostStolen * static_cast<double>(scene_.planes[j].points);
  }

  static bool covers(const Plane& plane, const Vec3& p, double height) {
    const Vec3 u = plane.corners[1] - plane.corners[0];
    const Vec3 v = plane.corners[3] - plane.corners[0];
    const Vec3 d = p - plane.corners[0];
    return std::abs(plane.normal.dot(p) - plane.offset) <= height && d.dot(u) >= 0.0 &&
           d.dot(u) <= u.squaredNorm() && d.dot(v) >= 0.0 && d.dot(v) <= v.squaredNorm();
  }

  bool unattached(const std::string& name, const std::string& other) const {
    const std::size_t i = scene_.index_of(name);
    const std::size_t j = scene_.index_of(other);
    if (!found_[i] || !found_[j]) return false;  // that is another fault
    const double most = kMostGapSigmas * scene_.planes[i].sigma;
    return gap(answer(i), answer(j)) > most || gap(answer(j), answer(i)) > most;
  }

  // How far a rectangle ends before the other plane; 0 where it crosses it.
  static double gap(const Plane& plane, const Plane& other) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Vec3& corner : plane.corners) {
      const double distance = other.normal.dot(corner) - other.offset;
      low = std::min(low, distance);
      high = std::max(high, distance);
    }
    return std::max({0.0, low, -high});
  }

  const Scene& scene_;
  const LabelledCloud& cloud_;
  const Extraction& answer_;
  std::vector<std::optional<std::size_t>> found_;  ///< for each true plane the one of the answer
};

inline std::string text_of(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& fault : faults) text += fault.kind + ' ' + fault.plane + ' ' + fault.from + "; ";
  return text;
}

}  // namespace hallway::em::planted
