// SPDX-License-Identifier: MIT
#include "sense/motion_integral.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/error.hpp"
#include "base/text.hpp"

namespace hallway::sense {
namespace {

constexpr double kTolerance = 1e-10;
/// Panels that are so small a part of the interval that a difference of this share of it does not matter: a break that a trajectory does not name.
constexpr double kNegligible = 1e-14;
constexpr std::size_t kMostPanels = std::size_t{1} << 18;
constexpr double kRounding = 1e-12;

struct KronrodNode {
  double place;   ///< in [0, 1]; others at its negative
  double weight;  ///< of the rule of fifteen nodes
  double gauss;   ///< of the rule of seven nodes
};

constexpr std::array<KronrodNode, 7> kKronrod{
    {{0.991455371120812639206854697526329, 0.022935322010529224963732008058970, 0.0},
     {0.949107912342758524526189684047851, 0.063092092629978553290700663189204,
      0.129484966168869693270611432679082},
     {0.864864423359769072789712788640926, 0.104790010322250183839876322541518, 0.0},
     {0.741531185599394439863864773280788, 0.140653259715525918745189590510238,
      0.279705391489276667901467771423780},
     {0.586087235467691130294144691258130, 0.169004726639267902826583426598550, 0.0},
     {0.405845151377397166906606412076961, 0.190350578064785409913256402421014,
      0.381830050505118944950369775488975},
     {0.207784955007898467600689403773245, 0.204432940075298892414161999234649, 0.0}}};
constexpr double kMiddleKronrod = 0.209482141084727828012999174891714;
constexpr double kMiddleGauss = 0.417959183673469387755102040816327;

[[noreturn]] void refuse_motion(const std::string& sensor, std::int64_t begin_ns, std::int64_t end_ns,
                                const std::string& problem) {
  throw Error(
      ErrorCode::kBadInput,
      "the motion from " + std::to_string(begin_ns) + " to " + std::to_string(end_ns) + " ns " + problem,
      {.element = "sensor `" + printable(sensor) + "`"});
}

bool differs(const Vec3& a, const Vec3& b) {
  return !((a - b).norm() <= kRounding * (1.0 + a.norm()));
}

bool has_jump(const Kinematics& before, const Kinematics& after) {
  return differs(before.velocity, after.velocity) ||
         differs(before.angular_velocity, after.angular_velocity) ||
         !(angle_between(before.T_world_body.q, after.T_world_body.q) <= kRounding);
}

/// An interval of a motion, of which parts are summed up.
class MotionInterval {
 public:
  MotionInterval(const Trajectory& trajectory, std::int64_t begin_ns, std::int64_t end_ns,
                 const MotionIntegrand& integrand, const std::string& sensor)
      : trajectory_(trajectory),
        begin_ns_(begin_ns),
        end_ns_(end_ns),
        integrand_(integrand),
        sensor_(sensor),
        duration_s_(1e-9 * static_cast<double>(end_ns - begin_ns)) {}

  double duration_s() const { return duration_s_; }

  MotionSum jump_at(double after_s) const {
    const Kinematics before = trajectory_.kinematics_at(begin_ns_, after_s, Side::kBefore);
    const Kinematics after = trajectory_.kinematics_at(begin_ns_, after_s, Side::kAfter);
    if (!has_jump(before, after)) return MotionSum::Zero();
    return finite(integrand_.jump(before, after));
  }

  /// Between two moments with no break between them.
  MotionSum smooth_part(double from_s, double to_s) {
    MotionSum sum = MotionSum::Zero();
    std::vector<std::array<double, 2>> open{{from_s, to_s}};
    while (!open.empty()) {
      const auto [from, to] = open.back();
      open.pop_back();
      if (!(from < to)) continue;
      if (++panels_ > kMostPanels) refuse_motion(sensor_, begin_ns_, end_ns_, "changes too fast");
      const Panel panel = look_at(from, to);
      const double middle = 0.5 * (from + to);
      const double bound = panel.size * std::max(kTolerance * (to - from), kNegligible * duration_s_);
      if (panel.difference <= bound || middle <= from || middle >= to) {
        sum += panel.sum;
      } else {
        open.push_back({middle, to});
        open.push_back({from, middle});
      }
    }
    return sum;
  }

 private:
  struct Panel {
    MotionSum sum;
    double difference;  ///< of the two rules
    double size;        ///< 1 + the largest number
  };

  const MotionSum& finite(const MotionSum& sum) const {
    if (!sum.allFinite()) refuse_motion(sensor_, begin_ns_, end_ns_, "is not finite, or too great a number");
    return sum;
  }

  MotionSum rate_at(double after_s) const {
    return finite(integrand_.rate(trajectory_.kinematics_at(begin_ns_, after_s, Side::kAfter)));
  }

  Panel look_at(double from, double to) const {
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    const MotionSum at_middle = rate_at(middle);
    MotionSum kronrod = kMiddleKronrod * at_middle, gauss = kMiddleGauss * at_middle;
    double largest = at_middle.lpNorm<Eigen::Infinity>();
    for (const KronrodNode& node : kKronrod) {
      const MotionSum low = rate_at(middle - half * node.place), high = rate_at(middle + half * node.place);
      kronrod += node.weight * (low + high);
      gauss += node.gauss * (low + high);
      largest = std::max({largest, low.lpNorm<Eigen::Infinity>(), high.lpNorm<Eigen::Infinity>()});
    }
    return {finite(half * kronrod), half * (kronrod - gauss).lpNorm<Eigen::Infinity>(), 1.0 + largest};
  }

  const Trajectory& trajectory_;
  std::int64_t begin_ns_, end_ns_;
  const MotionIntegrand& integrand_;
  const std::string& sensor_;
  double duration_s_;
  std::size_t panels_ = 0;
};

}  // namespace

Quat halfway(const Quat& before, const Quat& after) {
  return before * rotation_by(0.5 * rotation_vector(before.conjugate() * after));
}

MotionSum integrate_motion(const Trajectory& trajectory, std::int64_t begin_ns, std::int64_t end_ns,
                           const MotionIntegrand& integrand, const std::string& sensor) {
  MotionSum sum = MotionSum::Zero();
  if (end_ns <= begin_ns) return sum;
  MotionInterval interval(trajectory, begin_ns, end_ns, integrand, sensor);
  double from = 0.0;
  for (const double named : trajectory.breaks_in(begin_ns, end_ns)) {
    const double at = std::clamp(named, from, interval.duration_s());
    sum += interval.smooth_part(from, at);
    sum += interval.jump_at(named);
    from = at;
  }
  return sum + interval.smooth_part(from, interval.duration_s());
}

}  // namespace hallway::sense
