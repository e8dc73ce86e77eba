// SPDX-License-Identifier: MIT
#include "log_tables.hpp"

#include <fmt/format.h>
#include <hallway/hallway.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <span>

#include "geom/arrays.hpp"
#include "host/samples/sample_kind.hpp"
#include "log/row_file.hpp"
#include "log_readings.hpp"
#include "run/sources/abi_pose.hpp"
#include "sensor_choice.hpp"

namespace hallway::cli {
namespace {

constexpr const char* kPoseColumns = "x_m,y_m,z_m,qw,qx,qy,qz";

/// A row of a table. A number that is not known is an empty cell, an infinite one is `inf`.
class Cells {
 public:
  explicit Cells(log::RowWriter& row) : row_(row) {}
  ~Cells() { row_.end_row(); }
  Cells(const Cells&) = delete;
  Cells& operator=(const Cells&) = delete;

  Cells& whole(std::int64_t value) { return text(fmt::format("{}", value)); }
  Cells& whole(std::uint64_t value) { return text(fmt::format("{}", value)); }
  /// Empty where `value` is null, or what it points to says that there is none.
  template <typename Whole>
  Cells& whole_or_none(const Whole* value) {
    return value == nullptr || *value == static_cast<Whole>(-1) ? none() : whole(std::uint64_t{*value});
  }
  template <typename Real>
  Cells& number(Real value) {
    if (std::isfinite(value)) return text(fmt::format("{}", value));
    return std::isnan(value) ? none() : text(value > 0 ? "inf" : "-inf");
  }
  template <typename Numbers>
  Cells& numbers(const Numbers& values) {
    for (const auto value : values) number(value);
    return *this;
  }
  Cells& pose(const std::optional<Pose>& pose) {
    if (pose) return numbers(to_array(pose->t)).numbers(to_array(pose->q));
    return none(7);
  }
  Cells& text(std::string_view text) {
    row_.word(text);
    return *this;
  }
  Cells& none(std::size_t cells = 1) {
    for (std::size_t i = 0; i < cells; ++i) row_.word("");
    return *this;
  }

 private:
  log::RowWriter& row_;
};

/// A reading with what belongs to it.
struct TableReading {
  const hw_sample_t& sample;
  std::span<const log::LandmarkId> identities;  ///< of its elements, or none
  const log::SampleTruth* truth;                ///< or null

  template <typename T>
  const T& payload() const {
    return *static_cast<const T*>(sample.payload);
  }
  /// Values of the truth by their name; null where there are not so many.
  const std::vector<double>* true_values(const char* name, std::uint64_t count) const {
    if (truth == nullptr) return nullptr;
    const auto found = truth->values.find(name);
    return found != truth->values.end() && found->second.size() == count ? &found->second : nullptr;
  }
  const log::LandmarkId* identity(std::uint64_t i) const {
    return identities.empty() ? nullptr : &identities[i];
  }
};

template <typename T>
const T* at_or_null(const T* list, std::uint64_t i) {
  return list == nullptr ? nullptr : list + i;
}

void add_points(log::RowFile& file, const TableReading& reading) {
  const auto& points = reading.payload<hw_points_t>();
  const std::int64_t* times = hw_point_times_of(&points);
  const float* intensities = hw_point_intensities_of(&points);
  for (std::uint64_t i = 0; i < points.count; ++i) {
    const hw_point3_t& point = *hw_point_at(&points, i);
    Cells row(file.next_row());
    row.whole(reading.sample.sequence).whole(reading.sample.t_begin_ns + (times != nullptr ? times[i] : 0));
    row.number(point.x).number(point.y).number(point.z);
    row.number(intensities != nullptr ? intensities[i] : std::nanf(""));
    row.whole_or_none(at_or_null(hw_point_rings_of(&points), i));
    row.whole_or_none(at_or_null(points.track, i)).whole_or_none(reading.identity(i));
  }
}

void add_scan(log::RowFile& file, const TableReading& reading) {
  const auto& scan = reading.payload<hw_range_scan_t>();
  const std::vector<double>* labels = reading.true_values("label", scan.count);
  const std::uint64_t in_layer = scan.layers > 0 ? scan.count / scan.layers : scan.count;
  const std::vector<double>* true_ranges = reading.true_values("range_m", in_layer);  // -1: nothing in range
  for (std::uint64_t i = 0; i < scan.count; ++i) {
    const hw_ray_t& ray = *hw_ray_at(&scan, i);
    Cells row(file.next_row());
    row.whole(reading.sample.sequence).whole(hw_ray_time_ns(&reading.sample, &scan, i));
    row.whole_or_none(at_or_null(scan.ring, i));
    row.number(ray.azimuth_rad).number(ray.elevation_rad).number(ray.range_m);
    row.number(scan.intensity != nullptr ? scan.intensity[i] : std::nanf(""));
    row.whole(in_layer > 0 ? i / in_layer : 0);
    if (true_ranges == nullptr) {
      row.none();
    } else {
      const double range_m = (*true_ranges)[i % in_layer];
      row.number(range_m < 0.0 ? std::numeric_limits<double>::infinity() : range_m);
    }
    const bool has_label = labels != nullptr && (*labels)[i] >= 0.0;
    if (has_label) {
      row.whole(static_cast<std::uint64_t>((*labels)[i]));
    } else {
      row.none();
    }
  }
}

void add_planes(log::RowFile& file, const TableReading& reading) {
  const auto& planes = reading.payload<hw_planes_t>();
  for (std::uint64_t i = 0; i < planes.count; ++i) {
    const hw_plane_t& plane = *hw_plane_at(&planes, i);
    Cells row(file.next_row());
    row.whole(reading.sample.sequence).whole(reading.sample.t_end_ns).whole(plane.id);
    row.numbers(plane.normal).number(plane.offset_m).numbers(plane.centroid);
    for (const auto& corner : plane.corners) row.numbers(corner);
    row.number(plane.rms_m).whole_or_none(reading.identity(i));
  }
}

void add_bump(log::RowFile& file, const TableReading& reading) {
  const auto& bump = reading.payload<hw_bump_t>();
  for (std::uint64_t i = 0; i < bump.count; ++i) {
    const hw_bump_zone_t& zone = *hw_bump_zone_at(&bump, i);
    Cells row(file.next_row());
    row.whole(reading.sample.sequence).whole(reading.sample.t_end_ns);
    row.whole(std::uint64_t{zone.zone}).whole(std::uint64_t{zone.pressed}).number(zone.depth_m);
    row.numbers(zone.direction);
  }
}

void add_ticks(log::RowFile& file, const TableReading& reading) {
  const auto& encoder = reading.payload<hw_encoder_t>();
  for (std::uint64_t i = 0; i < encoder.count; ++i)
    Cells(file.next_row())
        .whole(reading.sample.sequence)
        .whole(reading.sample.t_end_ns)
        .whole(i)
        .whole(hw_wheel_ticks_at(&encoder, i));
}

void add_odometry(log::RowFile& file, const TableReading& reading) {
  const auto& odometry = reading.payload<hw_odometry_t>();
  Cells row(file.next_row());
  row.whole(reading.sample.sequence).whole(reading.sample.t_end_ns);
  row.pose(run::pose_of(odometry.T_odom_sensor));
  row.numbers(odometry.linear_m_s).numbers(odometry.angular_rad_s).numbers(odometry.covariance);
}

void add_imu(log::RowFile& file, const TableReading& reading) {
  const auto& imu = reading.payload<hw_imu_t>();
  Cells row(file.next_row());
  row.whole(reading.sample.sequence).whole(reading.sample.t_begin_ns).whole(reading.sample.t_end_ns);
  row.numbers(imu.angular_rad_s).numbers(imu.force_m_s2);
  for (const char* name : {"angular_rad_s", "force_m_s2", "angular_bias_rad_s", "force_bias_m_s2"}) {
    if (const std::vector<double>* values = reading.true_values(name, 3)) {
      row.numbers(*values);
    } else {
      row.none(3);
    }
  }
}

void add_gnss(log::RowFile& file, const TableReading& reading) {
  const auto& gnss = reading.payload<hw_gnss_t>();
  Cells row(file.next_row());
  row.whole(reading.sample.sequence).whole(reading.sample.t_end_ns).whole(std::uint64_t{gnss.fix});
  row.numbers(gnss.position_m).numbers(gnss.covariance);
  for (const char* name : {"position_m", "correlated_m"}) {
    if (const std::vector<double>* values = reading.true_values(name, 3)) {
      row.numbers(*values);
    } else {
      row.none(3);
    }
  }
}

void add_magnetic(log::RowFile& file, const TableReading& reading) {
  const auto& magnetic = reading.payload<hw_magnetic_t>();
  Cells row(file.next_row());
  row.whole(reading.sample.sequence).whole(reading.sample.t_end_ns);
  row.number(magnetic.heading_rad).number(magnetic.variance_rad2);
  for (const char* name : {"heading_rad", "deviation_rad", "bias_rad"}) {
    if (const std::vector<double>* values = reading.true_values(name, 1)) {
      row.numbers(*values);
    } else {
      row.none(1);
    }
  }
}

/// How the elements of a kind are written.
struct ElementTable {
  std::string columns;
  void (*add)(log::RowFile& file, const TableReading& reading);
};

std::string covariance_columns() {
  std::string columns;
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) columns += fmt::format(",cov_{}{}", row, column);
  }
  return columns;
}

const std::map<std::uint32_t, ElementTable>& element_tables() {
  static const std::map<std::uint32_t, ElementTable> kTables{
      {HW_SAMPLE_POINTS, {"sequence,t_ns,x_m,y_m,z_m,intensity,ring,track,true_landmark", add_points}},
      {HW_SAMPLE_PLANES,
       {"sequence,t_ns,id,nx,ny,nz,offset_m,cx_m,cy_m,cz_m,x0_m,y0_m,z0_m,x1_m,y1_m,z1_m,x2_m,y2_m,z2_m,"
        "x3_m,y3_m,z3_m,rms_m,true_plane",
        add_planes}},
      {HW_SAMPLE_RANGE_SCAN,
       {"sequence,t_ns,ring,azimuth_rad,elevation_rad,range_m,intensity,layer,true_range_m,true_label",
        add_scan}},
      {HW_SAMPLE_BUMP, {"sequence,t_ns,zone,pressed,depth_m,dx,dy,dz", add_bump}},
      {HW_SAMPLE_ENCODER, {"sequence,t_ns,wheel,ticks", add_ticks}},
      {HW_SAMPLE_ODOMETRY,
       {"sequence,t_ns,x_m,y_m,z_m,qw,qx,qy,qz,vx_m_s,vy_m_s,vz_m_s,wx_rad_s,wy_rad_s,wz_rad_s" +
            covariance_columns(),
        add_odometry}},
      {HW_SAMPLE_IMU,
       {"sequence,t_begin_ns,t_end_ns,wx_rad_s,wy_rad_s,wz_rad_s,fx_m_s2,fy_m_s2,fz_m_s2,"
        "true_wx_rad_s,true_wy_rad_s,true_wz_rad_s,true_fx_m_s2,true_fy_m_s2,true_fz_m_s2,"
        "bias_wx_rad_s,bias_wy_rad_s,bias_wz_rad_s,bias_fx_m_s2,bias_fy_m_s2,bias_fz_m_s2",
        add_imu}},
      {HW_SAMPLE_GNSS,
       {"sequence,t_ns,fix,x_m,y_m,z_m,cov_xx,cov_xy,cov_xz,cov_yy,cov_yz,cov_zz,"
        "true_x_m,true_y_m,true_z_m,correlated_x_m,correlated_y_m,correlated_z_m",
        add_gnss}},
      {HW_SAMPLE_MAGNETIC,
       {"sequence,t_ns,heading_rad,variance_rad2,true_heading_rad,deviation_rad,bias_rad", add_magnetic}},
  };
  return kTables;
}

/// The tables of a sensor.
class SensorTables {
 public:
  SensorTables(const std::filesystem::path& folder, const std::string& stem, std::uint32_t kind)
      : readings_(folder / (stem + "_readings.csv"), ',',
                  std::string("frame,sequence,t_begin_ns,t_end_ns,elements,true_begin_ns,true_end_ns,") +
                      kPoseColumns) {
    const auto table = element_tables().find(kind);
    if (table == element_tables().end()) return;
    elements_ = std::make_unique<log::RowFile>(folder / (stem + ".csv"), ',', table->second.columns);
    add_elements_ = table->second.add;
  }

  void add(std::uint32_t iteration, const run::SourceFrame& frame, std::uint32_t k) {
    const hw_sample_t& sample = frame.sample(k);
    const TrueReading truth = true_reading(frame, k);
    Cells(readings_.next_row())
        .whole(std::uint64_t{iteration})
        .whole(sample.sequence)
        .whole(sample.t_begin_ns)
        .whole(sample.t_end_ns)
        .whole(frame.elements_of(k))
        .whole(truth.begin_ns)
        .whole(truth.end_ns)
        .pose(truth.T_world_body);
    if (!elements_) return;
    const auto of_sample = std::ranges::find(frame.sample_truths, k, &log::SampleTruth::sample);
    add_elements_(*elements_, {sample, frame.identities_of(k),
                               of_sample == frame.sample_truths.end() ? nullptr : &*of_sample});
  }

  void close() {
    readings_.close();
    if (elements_) elements_->close();
  }

 private:
  log::RowFile readings_;
  std::unique_ptr<log::RowFile> elements_;  ///< null of a kind that is not known
  void (*add_elements_)(log::RowFile& file, const TableReading& reading) = nullptr;
};

void write_sensor_list(const std::filesystem::path& path, const std::vector<host::SensorInfo>& sensors) {
  log::RowFile file(path, ',', std::string("id,name,kind,rate_hz,latency_s,") + kPoseColumns);
  for (const host::SensorInfo& sensor : sensors)
    Cells(file.next_row())
        .whole(std::uint64_t{sensor.id})
        .text(plain_name(sensor.name))
        .text(host::sample_kind_name(sensor.kind))
        .number(sensor.rate_hz)
        .number(sensor.latency_s)
        .pose(run::pose_of(sensor.T_body_sensor));
  file.close();
}

/// A text as a field of a table, in quotes as RFC 4180 has them.
std::string in_quotes(std::string_view text) {
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? std::string("\"\"") : std::string(1, c);
  return field + "\"";
}

void write_labels(const std::filesystem::path& path, const std::vector<log::SurfaceLabel>& labels) {
  log::RowFile file(path, ',', "id,thing,material,mover");
  for (const log::SurfaceLabel& label : labels)
    Cells(file.next_row())
        .whole(label.id)
        .text(in_quotes(label.thing))
        .text(in_quotes(label.material))
        .text(in_quotes(label.mover));
  file.close();
}

}  // namespace

void write_tables(OpenedLog& opened, const std::string& sensor, const std::filesystem::path& folder,
                  bool quiet) {
  run::Source& source = *opened.source;
  std::vector<host::SensorInfo> chosen = source.sensors();
  if (!sensor.empty()) chosen = {find_named_sensor(source.sensors(), sensor)};
  write_sensor_list(folder / "sensors.csv", chosen);
  if (!source.facts().labels.empty()) write_labels(folder / "labels.csv", source.facts().labels);
  std::map<std::uint32_t, SensorTables> tables;
  std::set<std::string> taken{"frames", "sensors", "labels"};
  for (const host::SensorInfo& info : chosen) {
    std::string stem = plain_name(info.name);
    if (taken.contains(stem) || taken.contains(stem + "_readings")) stem += fmt::format("_{}", info.id);
    taken.insert({stem, stem + "_readings"});
    tables.try_emplace(info.id, folder, stem, info.kind);
  }
  log::RowFile frames(folder / "frames.csv", ',', std::string("frame,t_ns,") + kPoseColumns);
  each_frame(source, quiet, [&](std::uint32_t i, const run::SourceFrame& frame) {
    Cells(frames.next_row()).whole(std::uint64_t{i}).whole(frame.t_ns()).pose(true_pose(frame));
    for (std::uint32_t k = 0; k < frame.n_samples(); ++k) {
      const auto table = tables.find(frame.sample(k).sensor_id);
      if (table != tables.end()) table->second.add(i, frame, k);
    }
  });
  frames.close();
  for (auto& [id, table] : tables) table.close();
}

}  // namespace hallway::cli
