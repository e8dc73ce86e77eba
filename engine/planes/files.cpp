// SPDX-License-Identifier: MIT
#include "planes/files.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>
#include <numbers>

#include "base/bytes.hpp"
#include "planes/picture.hpp"

namespace hallway::planes {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr std::array kFaultKinds{FaultKind::kMissing,   FaultKind::kExtra,  FaultKind::kSplit,
                                 FaultKind::kMerged,    FaultKind::kStolen, FaultKind::kMisaligned,
                                 FaultKind::kUnattached};

Json vec3_json(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

template <typename List>
Json points_json(const List& points) {
  Json list = Json::array();
  for (const Vec3& point : points) list.push_back(vec3_json(point));
  return list;
}

/// What a share of nothing is: null.
Json share(std::size_t part, std::size_t whole) {
  return whole == 0 ? Json() : Json(static_cast<double>(part) / static_cast<double>(whole));
}

/// Mean, median and largest; null without any.
Json spread_json(std::vector<double> values, double unit) {
  if (values.empty()) return nullptr;
  std::sort(values.begin(), values.end());
  double sum = 0;
  for (const double value : values) sum += value;
  return {{"mean", unit * sum / static_cast<double>(values.size())},
          {"median", unit * values[values.size() / 2]},
          {"max", unit * values.back()}};
}

Json fault_json(const Fault& fault, const Truth& truth) {
  Json labels = Json::array();
  for (const std::size_t t : fault.truths) labels.push_back(truth.planes[t].label);
  Json json{{"fault", fault_name(fault.kind)}, {"labels", labels}, {"planes", fault.found}};
  if (fault.kind == FaultKind::kStolen) json["points"] = static_cast<std::uint64_t>(fault.amount);
  if (fault.kind == FaultKind::kMisaligned) json["angle_deg"] = kDegrees * fault.amount;
  if (fault.kind == FaultKind::kUnattached) json["gap"] = fault.amount;
  return json;
}

/// Adds one cloud's; the sum is known only where that of each is.
void add_decidable(const std::optional<Decidable>& one, std::optional<Decidable>& sum) {
  if (!one || !sum) {
    sum.reset();
    return;
  }
  for (std::size_t i = 0; i < kIous.size(); ++i) {
    sum->truths[i] += one->truths[i];
    sum->found[i] += one->found[i];
    sum->matched[i] += one->matched[i];
  }
}

Json decidable_json(const Decidable& decidable, std::size_t i) {
  return {{"true_planes", decidable.truths[i]},
          {"found_planes", decidable.found[i]},
          {"matched", decidable.matched[i]},
          {"precision", share(decidable.matched[i], decidable.found[i])},
          {"recall", share(decidable.matched[i], decidable.truths[i])}};
}

}  // namespace

Json planes_json(const Cloud& cloud, const std::vector<PlaneObservation>& found) {
  Json list = Json::array();
  for (const PlaneObservation& plane : found) {
    std::vector<std::uint64_t> rows;
    for (const PointIndex member : plane.members) rows.push_back(cloud.rows[member]);
    list.push_back({{"id", plane.id},
                    {"normal", vec3_json(plane.plane.normal)},
                    {"offset", plane.plane.offset},
                    {"centroid", vec3_json(plane.centroid)},
                    {"corners", points_json(plane.corners)},
                    {"points", plane.points},
                    {"rms", plane.rms},
                    {"exclusive_share", plane.exclusive_share},
                    {"hull", points_json(plane.hull)},
                    {"members", rows}});
  }
  return list;
}

Json scores_json(const std::vector<Score>& scores) {
  Score sum;
  if (!scores.empty() && scores.front().decidable) sum.decidable.emplace();
  std::vector<double> angles, offsets;
  std::array<std::size_t, kFaultKinds.size()> faults{};
  for (const Score& score : scores) {
    sum.truths += score.truths;
    sum.found += score.found;
    sum.apart += score.apart;
    sum.apart_matched += score.apart_matched;
    for (std::size_t i = 0; i < kIous.size(); ++i) sum.matched[i] += score.matched[i];
    add_decidable(score.decidable, sum.decidable);
    sum.labelled_points += score.labelled_points;
    sum.unassigned_points += score.unassigned_points;
    sum.outliers += score.outliers;
    sum.assigned_outliers += score.assigned_outliers;
    for (std::size_t i = 0; i < faults.size(); ++i) faults[i] += score.count(kFaultKinds[i]);
    for (const PlanePair& pair : score.pairs) {
      if (pair.iou < kIous[0] || !score.asked[pair.truth]) continue;
      angles.push_back(pair.normal_error);
      offsets.push_back(pair.offset_error);
    }
  }
  Json json{{"true_planes", sum.truths}, {"found_planes", sum.found}};
  for (std::size_t i = 0; i < kIous.size(); ++i) {
    json["iou"].push_back({{"at", kIous[i]},
                           {"matched", sum.matched[i]},
                           {"precision", share(sum.matched[i], sum.found)},
                           {"recall", share(sum.matched[i], sum.truths)}});
    if (sum.decidable) json["iou"].back()["decidable"] = decidable_json(*sum.decidable, i);
  }
  json["apart"] = {{"true_planes", sum.apart}, {"matched", sum.apart_matched}};
  json["normal_error_deg"] = spread_json(std::move(angles), kDegrees);
  json["offset_error"] = spread_json(std::move(offsets), 1.0);
  json["over_segmented"] = faults[static_cast<std::size_t>(FaultKind::kSplit)];
  json["under_segmented"] = faults[static_cast<std::size_t>(FaultKind::kMerged)];
  json["unassigned_share"] = share(sum.unassigned_points, sum.labelled_points);
  json["assigned_outlier_share"] = share(sum.assigned_outliers, sum.outliers);
  for (std::size_t i = 0; i < faults.size(); ++i) json["faults"][fault_name(kFaultKinds[i])] = faults[i];
  return json;
}

Json score_json(const Score& score, const Truth& truth) {
  Json json = scores_json({score});
  Json pairs = Json::array(), faults = Json::array();
  for (const PlanePair& pair : score.pairs) {
    pairs.push_back({{"label", truth.planes[pair.truth].label},
                     {"plane", pair.found},
                     {"iou", pair.iou},
                     {"normal_error_deg", kDegrees * pair.normal_error},
                     {"offset_error", pair.offset_error}});
  }
  for (const Fault& fault : score.faults) faults.push_back(fault_json(fault, truth));
  json["pairs"] = std::move(pairs);
  json["fault_list"] = std::move(faults);
  return json;
}

std::vector<std::int64_t> plane_of_points(std::size_t points, const std::vector<PlaneObservation>& found) {
  std::vector<std::int64_t> of_points(points, -1);
  for (std::size_t f = found.size(); f-- > 0;) {
    for (const PointIndex member : found[f].members) of_points[member] = static_cast<std::int64_t>(f);
  }
  return of_points;
}

std::string print_ply(const Cloud& cloud, const std::vector<PlaneObservation>& found) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\n"
      "property double z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty int plane\n"
      "end_header\n",
      cloud.points.size());
  ByteAppender writer(bytes);
  const std::vector<std::int64_t> planes = plane_of_points(cloud.points.size(), found);
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    for (const double number : {cloud.points[i].x(), cloud.points[i].y(), cloud.points[i].z()})
      writer.put(number);
    const render::Rgb colour =
        planes[i] < 0 ? kNoPlaneColour : render::submap_colour(static_cast<std::size_t>(planes[i]));
    for (const std::uint8_t channel : {colour.r, colour.g, colour.b}) writer.put(channel);
    writer.put(static_cast<std::int32_t>(planes[i]));
  }
  return bytes;
}

std::string fault_text(const Fault& fault, const Truth& truth) {
  std::string labels;
  for (const std::size_t t : fault.truths)
    labels += (labels.empty() ? "" : "+") + fmt::to_string(truth.planes[t].label);
  switch (fault.kind) {
    case FaultKind::kSplit:
      return fmt::format("split {} in {}", labels, fault.found.size());
    case FaultKind::kStolen:
      return fmt::format("stolen {} of {}", fault.amount, labels);
    case FaultKind::kMisaligned:
      return fmt::format("misaligned {} by {:.1f}°", labels, kDegrees * fault.amount);
    case FaultKind::kUnattached:
      return fmt::format("unattached {}, gap {:.2g}", labels, fault.amount);
    default:
      return fault_name(fault.kind) + (labels.empty() ? std::string() : " " + labels);
  }
}

}  // namespace hallway::planes
