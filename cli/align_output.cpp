// SPDX-License-Identifier: MIT
#include "align_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/se3.hpp"
#include "log/row_writer.hpp"
#include "render/draw.hpp"
#include "render/png.hpp"

namespace hallway::cli {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

/// "1.79387 0.720047 0 39.7117 0 0", as --guess takes it.
std::string values_text(const std::array<double, 6>& v) {
  return fmt::format("{:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {:.6g}", v[0], v[1], v[2], v[3], v[4], v[5]);
}

std::string matrix_text(const Pose& pose) {
  const Mat3 r = pose.q.toRotationMatrix();
  std::string text;
  for (Eigen::Index row = 0; row < 3; ++row) {
    text +=
        fmt::format("  {:12.8f} {:12.8f} {:12.8f} {:14.6f}\n", r(row, 0), r(row, 1), r(row, 2), pose.t[row]);
  }
  return text + fmt::format("  {:12.8f} {:12.8f} {:12.8f} {:14.6f}\n", 0.0, 0.0, 0.0, 1.0);
}

nlohmann::ordered_json matrix_json(const Pose& pose) {
  const Mat3 r = pose.q.toRotationMatrix();
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (Eigen::Index row = 0; row < 3; ++row) rows.push_back({r(row, 0), r(row, 1), r(row, 2), pose.t[row]});
  rows.push_back({0.0, 0.0, 0.0, 1.0});
  return rows;
}

nlohmann::ordered_json cloud_json(const AlignedCloud& cloud, std::size_t used) {
  return {{"file", cloud.file},
          {"points", cloud.points.size()},
          {"not_finite", cloud.not_finite},
          {"used", used}};
}

}  // namespace

Pose pose_of(const std::array<double, 6>& v) {
  return {from_yaw_pitch_roll(v[3] / kDegrees, v[4] / kDegrees, v[5] / kDegrees), {v[0], v[1], v[2]}};
}

std::array<double, 6> values_of(const Pose& pose) {
  const Mat3 r = pose.q.toRotationMatrix();
  const double pitch = std::asin(std::clamp(-r(2, 0), -1.0, 1.0));
  // Looking straight up or down, yaw and roll turn about one axis; all of it is called yaw.
  const bool level = std::hypot(r(2, 1), r(2, 2)) > 1e-9;
  const double yaw = level ? std::atan2(r(1, 0), r(0, 0)) : std::atan2(-r(0, 1), r(1, 1));
  const double roll = level ? std::atan2(r(2, 1), r(2, 2)) : 0.0;
  return {pose.t.x(), pose.t.y(), pose.t.z(), yaw * kDegrees, pitch * kDegrees, roll * kDegrees};
}

std::string alignment_text(const AlignedCloud& a, const AlignedCloud& b, const icp::Alignment& found) {
  const icp::Registration& result = found.registration;
  return fmt::format(
      "A  {}: {} points, {} used\n"
      "B  {}: {} points, {} used\n"
      "{} after {} steps\n"
      "T_a_b\n{}"
      "x y z [m], yaw pitch roll [deg]: {}\n"
      "residual {:.6g} m, overlap {:.1f} % within {:.4g} m\n",
      a.file, a.points.size(), found.used_a, b.file, b.points.size(), found.used_b,
      icp::text_of(result.outcome), result.iterations, matrix_text(result.T_target_source),
      values_text(values_of(result.T_target_source)), result.residual_m, 100.0 * result.overlap,
      found.rules.max_distance_m);
}

nlohmann::ordered_json to_json(const AlignedCloud& a, const AlignedCloud& b, const icp::Alignment& found,
                               const std::string& method, const std::string& weights) {
  const icp::Registration& result = found.registration;
  const Pose& T = result.T_target_source;
  const std::array<double, 6> v = values_of(T);
  return {{"schema", "hallway.align/1"},
          {"a", cloud_json(a, found.used_a)},
          {"b", cloud_json(b, found.used_b)},
          {"method", method},
          {"weights", weights},
          {"voxel_m", found.cube_m},
          {"reach_m", found.rules.reach_m},
          {"max_distance_m", found.rules.max_distance_m},
          {"converged", result.outcome == icp::Outcome::converged},
          {"outcome", icp::text_of(result.outcome)},
          {"iterations", result.iterations},
          {"residual_m", result.residual_m},
          {"overlap", result.overlap},
          {"T_a_b",
           {{"matrix", matrix_json(T)},
            {"position_m", {T.t.x(), T.t.y(), T.t.z()}},
            {"quaternion_wxyz", {T.q.w(), T.q.x(), T.q.y(), T.q.z()}},
            {"yaw_pitch_roll_deg", {v[3], v[4], v[5]}}}}};
}

std::string print_moved_ply(const AlignedCloud& b, const icp::Alignment& found) {
  log::RowWriter out(' ');
  out.word("ply").end_row();
  out.word("format ascii 1.0").end_row();
  out.word("element vertex").whole(b.points.size()).end_row();
  for (const char* property : {"double x", "double y", "double z"})
    out.word("property").word(property).end_row();
  out.word("end_header").end_row();
  for (const Vec3& point : b.points) {
    const Vec3 p = found.registration.T_target_source * point;
    out.numbers(std::array<double, 3>{p.x(), p.y(), p.z()}).end_row();
  }
  return out.take();
}

std::string draw_alignment(const AlignedCloud& a, const AlignedCloud& b, const icp::Alignment& found) {
  constexpr int kWidth = 1280, kHeight = 960;
  constexpr double kDot_px = 1.6;
  render::Markers still{a.points, render::MarkerShape::kDot, render::palette::kTruth, kDot_px, a.file};
  render::Markers moved{{}, render::MarkerShape::kDot, render::palette::kEstimate, kDot_px, b.file};
  for (const Vec3& p : b.points) moved.positions.push_back(found.registration.T_target_source * p);
  render::Picture picture;
  picture.title = "hallway align";
  picture.subtitle = fmt::format("residual {:.4g} m, overlap {:.1f} %", found.registration.residual_m,
                                 100.0 * found.registration.overlap);
  picture.markers = {std::move(still), std::move(moved)};
  return render::encode_png(render::draw(picture, {}, kWidth, kHeight));
}

}  // namespace hallway::cli
