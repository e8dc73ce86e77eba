// SPDX-License-Identifier: MIT
#pragma once

// Sizes and offsets of the ABI on 64-bit targets, as the compiler sees them. Included by one C and one C++ file: a change
// that breaks plugins does not compile.

#include <assert.h>
#include <hallway/hallway.h>
#include <stddef.h>

#define SIZE(type, bytes) static_assert(sizeof(type) == (bytes), #type)
#define AT(type, member, bytes) static_assert(offsetof(type, member) == (bytes), #type "." #member)

SIZE(hw_version_t, 8);
AT(hw_version_t, abi_major, 0);
AT(hw_version_t, abi_minor, 4);
static_assert(HW_SAMPLE_RANGE_SCAN == 4 && HW_SAMPLE_ODOMETRY == 7 && HW_SAMPLE_IMU == 10 &&
                  HW_SAMPLE_GNSS == 11 && HW_SAMPLE_MAGNETIC == 12,
              "kinds of 1.5");

SIZE(hw_error_t, 1008);
AT(hw_error_t, size, 0);
AT(hw_error_t, status, 4);
AT(hw_error_t, message, 8);

SIZE(hw_pose_t, 56);
AT(hw_pose_t, position, 0);
AT(hw_pose_t, orientation, 24);

SIZE(hw_sample_t, 48);
AT(hw_sample_t, size, 0);
AT(hw_sample_t, kind, 4);
AT(hw_sample_t, flags, 8);
AT(hw_sample_t, sensor_id, 12);
AT(hw_sample_t, sequence, 16);
AT(hw_sample_t, t_begin_ns, 24);
AT(hw_sample_t, t_end_ns, 32);
AT(hw_sample_t, payload, 40);

SIZE(hw_bump_zone_t, 40);
AT(hw_bump_zone_t, direction, 0);
AT(hw_bump_zone_t, depth_m, 24);
AT(hw_bump_zone_t, zone, 32);
AT(hw_bump_zone_t, pressed, 36);

SIZE(hw_bump_t, 24);
AT(hw_bump_t, size, 0);
AT(hw_bump_t, stride, 4);
AT(hw_bump_t, count, 8);
AT(hw_bump_t, zones, 16);

SIZE(hw_wheel_ticks_t, 8);
AT(hw_wheel_ticks_t, ticks, 0);

SIZE(hw_encoder_t, 24);
AT(hw_encoder_t, size, 0);
AT(hw_encoder_t, stride, 4);
AT(hw_encoder_t, count, 8);
AT(hw_encoder_t, wheels, 16);

SIZE(hw_bump_zone_info_t, 40);
AT(hw_bump_zone_info_t, name, 0);
AT(hw_bump_zone_info_t, middle_rad, 8);
AT(hw_bump_zone_info_t, width_rad, 16);
AT(hw_bump_zone_info_t, bottom_m, 24);
AT(hw_bump_zone_info_t, top_m, 32);

SIZE(hw_bump_info_t, 24);
AT(hw_bump_info_t, size, 0);
AT(hw_bump_info_t, stride, 4);
AT(hw_bump_info_t, count, 8);
AT(hw_bump_info_t, zones, 16);

SIZE(hw_encoder_wheel_t, 56);
AT(hw_encoder_wheel_t, m_per_tick, 0);
AT(hw_encoder_wheel_t, position, 8);
AT(hw_encoder_wheel_t, direction, 32);

SIZE(hw_encoder_info_t, 24);
AT(hw_encoder_info_t, size, 0);
AT(hw_encoder_info_t, stride, 4);
AT(hw_encoder_info_t, count, 8);
AT(hw_encoder_info_t, wheels, 16);

SIZE(hw_point3_t, 24);
AT(hw_point3_t, x, 0);
AT(hw_point3_t, y, 8);
AT(hw_point3_t, z, 16);

SIZE(hw_points_t, 72);
AT(hw_points_t, size, 0);
AT(hw_points_t, stride, 4);
AT(hw_points_t, count, 8);
AT(hw_points_t, points, 16);
AT(hw_points_t, track, 24);
AT(hw_points_t, width, 32);
AT(hw_points_t, height, 36);
AT(hw_points_t, pixel, 40);
AT(hw_points_t, t_offset_ns, 48);
AT(hw_points_t, intensity, 56);
AT(hw_points_t, ring, 64);

SIZE(hw_ray_t, 24);
AT(hw_ray_t, azimuth_rad, 0);
AT(hw_ray_t, elevation_rad, 8);
AT(hw_ray_t, range_m, 16);

SIZE(hw_range_scan_t, 64);
AT(hw_range_scan_t, size, 0);
AT(hw_range_scan_t, stride, 4);
AT(hw_range_scan_t, count, 8);
AT(hw_range_scan_t, rays, 16);
AT(hw_range_scan_t, width, 24);
AT(hw_range_scan_t, height, 28);
AT(hw_range_scan_t, layers, 32);
AT(hw_range_scan_t, reserved, 36);
AT(hw_range_scan_t, t_offset_ns, 40);
AT(hw_range_scan_t, intensity, 48);
AT(hw_range_scan_t, ring, 56);

SIZE(hw_range_scan_info_t, 32);
AT(hw_range_scan_info_t, size, 0);
AT(hw_range_scan_info_t, width, 4);
AT(hw_range_scan_info_t, height, 8);
AT(hw_range_scan_info_t, layers, 12);
AT(hw_range_scan_info_t, beam_rad, 16);
AT(hw_range_scan_info_t, scan_s, 24);

SIZE(hw_odometry_t, 280);
AT(hw_odometry_t, size, 0);
AT(hw_odometry_t, reserved, 4);
AT(hw_odometry_t, T_odom_sensor, 8);
AT(hw_odometry_t, linear_m_s, 64);
AT(hw_odometry_t, angular_rad_s, 88);
AT(hw_odometry_t, covariance, 112);

SIZE(hw_imu_t, 152);
AT(hw_imu_t, size, 0);
AT(hw_imu_t, reserved, 4);
AT(hw_imu_t, angular_rad_s, 8);
AT(hw_imu_t, force_m_s2, 32);
AT(hw_imu_t, angular_covariance, 56);
AT(hw_imu_t, force_covariance, 104);

SIZE(hw_gnss_t, 80);
AT(hw_gnss_t, size, 0);
AT(hw_gnss_t, fix, 4);
AT(hw_gnss_t, position_m, 8);
AT(hw_gnss_t, covariance, 32);

SIZE(hw_gnss_info_t, 32);
AT(hw_gnss_info_t, size, 0);
AT(hw_gnss_info_t, reserved, 4);
AT(hw_gnss_info_t, latitude_deg, 8);
AT(hw_gnss_info_t, longitude_deg, 16);
AT(hw_gnss_info_t, altitude_m, 24);

SIZE(hw_magnetic_t, 24);
AT(hw_magnetic_t, size, 0);
AT(hw_magnetic_t, reserved, 4);
AT(hw_magnetic_t, heading_rad, 8);
AT(hw_magnetic_t, variance_rad2, 16);

SIZE(hw_imu_info_t, 64);
AT(hw_imu_info_t, size, 0);
AT(hw_imu_info_t, reserved, 4);
AT(hw_imu_info_t, gravity_m_s2, 8);
AT(hw_imu_info_t, angular_noise, 16);
AT(hw_imu_info_t, angular_walk, 24);
AT(hw_imu_info_t, force_noise, 32);
AT(hw_imu_info_t, force_walk, 40);
AT(hw_imu_info_t, max_angular_rad_s, 48);
AT(hw_imu_info_t, max_force_m_s2, 56);

SIZE(hw_frame_t, 32);
AT(hw_frame_t, size, 0);
AT(hw_frame_t, n_samples, 4);
AT(hw_frame_t, sequence, 8);
AT(hw_frame_t, t_ns, 16);
AT(hw_frame_t, samples, 24);

SIZE(hw_output_t, 24);
AT(hw_output_t, size, 0);
AT(hw_output_t, kind, 4);
AT(hw_output_t, flags, 8);
AT(hw_output_t, reserved, 12);
AT(hw_output_t, payload, 16);

SIZE(hw_pose_output_t, 80);
AT(hw_pose_output_t, size, 0);
AT(hw_pose_output_t, status, 4);
AT(hw_pose_output_t, T_map_body, 8);
AT(hw_pose_output_t, covariance, 64);
AT(hw_pose_output_t, t_ns, 72);

SIZE(hw_drive_command_t, 32);
AT(hw_drive_command_t, size, 0);
AT(hw_drive_command_t, reserved, 4);
AT(hw_drive_command_t, linear_m_s, 8);
AT(hw_drive_command_t, angular_rad_s, 16);
AT(hw_drive_command_t, lateral_m_s, 24);

SIZE(hw_landmark_t, 40);
AT(hw_landmark_t, id, 0);
AT(hw_landmark_t, position, 8);
AT(hw_landmark_t, observations, 32);
AT(hw_landmark_t, status, 36);

SIZE(hw_landmarks_t, 32);
AT(hw_landmarks_t, size, 0);
AT(hw_landmarks_t, stride, 4);
AT(hw_landmarks_t, count, 8);
AT(hw_landmarks_t, landmarks, 16);
AT(hw_landmarks_t, covariances, 24);

SIZE(hw_associations_t, 24);
AT(hw_associations_t, size, 0);
AT(hw_associations_t, sample, 4);
AT(hw_associations_t, count, 8);
AT(hw_associations_t, landmark_ids, 16);

SIZE(hw_submap_t, 80);
AT(hw_submap_t, id, 0);
AT(hw_submap_t, T_map_submap, 8);
AT(hw_submap_t, first_member, 64);
AT(hw_submap_t, n_members, 72);

SIZE(hw_submaps_t, 40);
AT(hw_submaps_t, size, 0);
AT(hw_submaps_t, stride, 4);
AT(hw_submaps_t, count, 8);
AT(hw_submaps_t, submaps, 16);
AT(hw_submaps_t, n_members, 24);
AT(hw_submaps_t, members, 32);

SIZE(hw_plane_t, 216);
AT(hw_plane_t, id, 0);
AT(hw_plane_t, normal, 8);
AT(hw_plane_t, offset_m, 32);
AT(hw_plane_t, centroid, 40);
AT(hw_plane_t, corners, 64);
AT(hw_plane_t, n_points, 160);
AT(hw_plane_t, rms_m, 168);
AT(hw_plane_t, exclusive_share, 176);
AT(hw_plane_t, first_hull, 184);
AT(hw_plane_t, n_hull, 192);
AT(hw_plane_t, first_member, 200);
AT(hw_plane_t, n_members, 208);

SIZE(hw_planes_t, 64);
AT(hw_planes_t, size, 0);
AT(hw_planes_t, stride, 4);
AT(hw_planes_t, count, 8);
AT(hw_planes_t, planes, 16);
AT(hw_planes_t, sample, 24);
AT(hw_planes_t, hull_stride, 28);
AT(hw_planes_t, n_hull_points, 32);
AT(hw_planes_t, hull_points, 40);
AT(hw_planes_t, n_members, 48);
AT(hw_planes_t, members, 56);

SIZE(hw_mapped_corner_t, 32);
AT(hw_mapped_corner_t, position, 0);
AT(hw_mapped_corner_t, flags, 24);
AT(hw_mapped_corner_t, reserved, 28);

SIZE(hw_mapped_plane_t, 64);
AT(hw_mapped_plane_t, id, 0);
AT(hw_mapped_plane_t, normal, 8);
AT(hw_mapped_plane_t, offset_m, 32);
AT(hw_mapped_plane_t, observations, 40);
AT(hw_mapped_plane_t, status, 44);
AT(hw_mapped_plane_t, first_corner, 48);
AT(hw_mapped_plane_t, n_corners, 56);

SIZE(hw_mapped_planes_t, 48);
AT(hw_mapped_planes_t, size, 0);
AT(hw_mapped_planes_t, stride, 4);
AT(hw_mapped_planes_t, count, 8);
AT(hw_mapped_planes_t, planes, 16);
AT(hw_mapped_planes_t, corner_stride, 24);
AT(hw_mapped_planes_t, reserved, 28);
AT(hw_mapped_planes_t, n_corners, 32);
AT(hw_mapped_planes_t, corners, 40);

SIZE(hw_topology_node_t, 48);
AT(hw_topology_node_t, id, 0);
AT(hw_topology_node_t, kind, 4);
AT(hw_topology_node_t, direction, 8);
AT(hw_topology_node_t, visits, 12);
AT(hw_topology_node_t, size_m, 16);
AT(hw_topology_node_t, t_ns, 24);
AT(hw_topology_node_t, x_m, 32);
AT(hw_topology_node_t, y_m, 40);

SIZE(hw_topology_edge_t, 32);
AT(hw_topology_edge_t, from, 0);
AT(hw_topology_edge_t, to, 4);
AT(hw_topology_edge_t, length_m, 8);
AT(hw_topology_edge_t, confidence, 16);
AT(hw_topology_edge_t, quarter_turns, 24);
AT(hw_topology_edge_t, reserved, 28);

SIZE(hw_topology_t, 56);
AT(hw_topology_t, size, 0);
AT(hw_topology_t, loop, 4);
AT(hw_topology_t, node_stride, 8);
AT(hw_topology_t, edge_stride, 12);
AT(hw_topology_t, n_nodes, 16);
AT(hw_topology_t, nodes, 24);
AT(hw_topology_t, n_edges, 32);
AT(hw_topology_t, edges, 40);
AT(hw_topology_t, note, 48);

SIZE(hw_drawing_point_t, 16);
AT(hw_drawing_point_t, x_m, 0);
AT(hw_drawing_point_t, y_m, 8);

SIZE(hw_drawing_item_t, 48);
AT(hw_drawing_item_t, kind, 0);
AT(hw_drawing_item_t, colour, 4);
AT(hw_drawing_item_t, flags, 8);
AT(hw_drawing_item_t, reserved, 12);
AT(hw_drawing_item_t, radius_m, 16);
AT(hw_drawing_item_t, first_point, 24);
AT(hw_drawing_item_t, n_points, 32);
AT(hw_drawing_item_t, text, 40);

SIZE(hw_drawing_t, 48);
AT(hw_drawing_t, size, 0);
AT(hw_drawing_t, stride, 4);
AT(hw_drawing_t, count, 8);
AT(hw_drawing_t, items, 16);
AT(hw_drawing_t, point_stride, 24);
AT(hw_drawing_t, reserved, 28);
AT(hw_drawing_t, n_points, 32);
AT(hw_drawing_t, points, 40);

SIZE(hw_counter_t, 16);
AT(hw_counter_t, name, 0);
AT(hw_counter_t, value, 8);

SIZE(hw_counters_t, 24);
AT(hw_counters_t, size, 0);
AT(hw_counters_t, stride, 4);
AT(hw_counters_t, count, 8);
AT(hw_counters_t, counters, 16);

SIZE(hw_sensor_info_t, 184);
AT(hw_sensor_info_t, size, 0);
AT(hw_sensor_info_t, id, 4);
AT(hw_sensor_info_t, kind, 8);
AT(hw_sensor_info_t, reserved, 12);
AT(hw_sensor_info_t, name, 16);
AT(hw_sensor_info_t, T_body_sensor, 24);
AT(hw_sensor_info_t, horizontal_fov, 80);
AT(hw_sensor_info_t, vertical_fov, 88);
AT(hw_sensor_info_t, min_range_m, 96);
AT(hw_sensor_info_t, max_range_m, 104);
AT(hw_sensor_info_t, noise_m, 112);
AT(hw_sensor_info_t, intrinsics, 136);
AT(hw_sensor_info_t, rate_hz, 144);
AT(hw_sensor_info_t, latency_s, 152);
AT(hw_sensor_info_t, noise_per_m, 160);

SIZE(hw_activation_t, 32);
AT(hw_activation_t, size, 0);
AT(hw_activation_t, n_sensors, 4);
AT(hw_activation_t, sensors, 8);
AT(hw_activation_t, drive, 16);
AT(hw_activation_t, body, 24);

SIZE(hw_drive_info_t, 120);
AT(hw_drive_info_t, size, 0);
AT(hw_drive_info_t, kind, 4);
AT(hw_drive_info_t, max_speed_m_s, 8);
AT(hw_drive_info_t, max_lateral_m_s, 16);
AT(hw_drive_info_t, max_angular_rad_s, 24);
AT(hw_drive_info_t, max_acceleration_m_s2, 32);
AT(hw_drive_info_t, max_deceleration_m_s2, 40);
AT(hw_drive_info_t, max_angular_acceleration_rad_s2, 48);
AT(hw_drive_info_t, greatest_steering_rad, 56);
AT(hw_drive_info_t, max_steering_rate_rad_s, 64);
AT(hw_drive_info_t, wheel_base_m, 72);
AT(hw_drive_info_t, axle_distance_m, 80);
AT(hw_drive_info_t, wheel_radius_m, 88);
AT(hw_drive_info_t, latency_s, 96);
AT(hw_drive_info_t, dead_band_m_s, 104);
AT(hw_drive_info_t, dead_band_rad_s, 112);

SIZE(hw_body_info_t, 40);
AT(hw_body_info_t, size, 0);
AT(hw_body_info_t, n_corners, 4);
AT(hw_body_info_t, corners, 8);
AT(hw_body_info_t, radius_m, 16);
AT(hw_body_info_t, bottom_m, 24);
AT(hw_body_info_t, top_m, 32);

SIZE(hw_host_vtable_t, 16);
AT(hw_host_vtable_t, put, 0);
AT(hw_host_vtable_t, get_extension, 8);

SIZE(hw_host_t, 48);
AT(hw_host_t, size, 0);
AT(hw_host_t, reserved, 4);
AT(hw_host_t, abi, 8);
AT(hw_host_t, vtable, 16);
AT(hw_host_t, self, 24);
AT(hw_host_t, name, 32);
AT(hw_host_t, version, 40);

SIZE(hw_report_request_t, 8);
AT(hw_report_request_t, size, 0);
AT(hw_report_request_t, flags, 4);

SIZE(hw_plugin_vtable_t, 56);
AT(hw_plugin_vtable_t, activate, 0);
AT(hw_plugin_vtable_t, deactivate, 8);
AT(hw_plugin_vtable_t, reset, 16);
AT(hw_plugin_vtable_t, process, 24);
AT(hw_plugin_vtable_t, report, 32);
AT(hw_plugin_vtable_t, get_extension, 40);
AT(hw_plugin_vtable_t, destroy, 48);

SIZE(hw_plugin_t, 16);
AT(hw_plugin_t, vtable, 0);
AT(hw_plugin_t, self, 8);

SIZE(hw_plugin_info_t, 88);
AT(hw_plugin_info_t, size, 0);
AT(hw_plugin_info_t, n_inputs, 4);
AT(hw_plugin_info_t, id, 8);
AT(hw_plugin_info_t, name, 16);
AT(hw_plugin_info_t, version, 24);
AT(hw_plugin_info_t, vendor, 32);
AT(hw_plugin_info_t, description, 40);
AT(hw_plugin_info_t, inputs, 48);
AT(hw_plugin_info_t, outputs, 56);
AT(hw_plugin_info_t, n_outputs, 64);
AT(hw_plugin_info_t, reserved, 68);
AT(hw_plugin_info_t, optional_inputs, 72);
AT(hw_plugin_info_t, n_optional_inputs, 80);
AT(hw_plugin_info_t, reserved_1_4, 84);

SIZE(hw_plugin_factory_t, 24);
AT(hw_plugin_factory_t, count, 0);
AT(hw_plugin_factory_t, describe, 8);
AT(hw_plugin_factory_t, create, 16);

SIZE(hw_entry_t, 32);
AT(hw_entry_t, abi, 0);
AT(hw_entry_t, init, 8);
AT(hw_entry_t, deinit, 16);
AT(hw_entry_t, get_factory, 24);

SIZE(hw_param_value_t, 16);
AT(hw_param_value_t, type, 0);
AT(hw_param_value_t, reserved, 4);
AT(hw_param_value_t, as, 8);

SIZE(hw_param_info_t, 112);
AT(hw_param_info_t, size, 0);
AT(hw_param_info_t, type, 4);
AT(hw_param_info_t, name, 8);
AT(hw_param_info_t, unit, 16);
AT(hw_param_info_t, help, 24);
AT(hw_param_info_t, default_value, 32);
AT(hw_param_info_t, minimum, 48);
AT(hw_param_info_t, maximum, 64);
AT(hw_param_info_t, choices, 80);
AT(hw_param_info_t, n_choices, 88);
AT(hw_param_info_t, reserved, 92);
AT(hw_param_info_t, default_text, 96);
AT(hw_param_info_t, flags, 104);
AT(hw_param_info_t, reserved_2, 108);

SIZE(hw_params_t, 32);
AT(hw_params_t, count, 0);
AT(hw_params_t, describe, 8);
AT(hw_params_t, get, 16);
AT(hw_params_t, set, 24);

SIZE(hw_params_2_t, 24);
AT(hw_params_2_t, get_text, 0);
AT(hw_params_2_t, set_text, 8);
AT(hw_params_2_t, origin, 16);

SIZE(hw_log_t, 8);
AT(hw_log_t, write, 0);

// Numbers are never given a second meaning.
static_assert(HW_OK == 0 && HW_ERROR_ARGUMENT == 1 && HW_ERROR_STATE == 2 && HW_ERROR_NOT_FOUND == 3,
              "status");
static_assert(HW_ERROR_RANGE == 4 && HW_ERROR_UNSUPPORTED == 5 && HW_ERROR_MEMORY == 6, "status");
static_assert(HW_ERROR_IO == 7 && HW_ERROR_DATA == 8 && HW_ERROR_INTERNAL == 9, "status");
static_assert(HW_SAMPLE_POINTS == 1 && HW_SAMPLE_PLANES == 2 && HW_SAMPLE_SEGMENTS == 3, "samples");
static_assert(HW_SAMPLE_RANGE_SCAN == 4 && HW_SAMPLE_BUMP == 5 && HW_SAMPLE_ENCODER == 6, "samples");
static_assert(HW_SAMPLE_ODOMETRY == 7 && HW_SAMPLE_IMAGE == 8 && HW_SAMPLE_DEPTH == 9, "samples");
static_assert(HW_OUTPUT_POSE == 1 && HW_OUTPUT_LANDMARKS == 2 && HW_OUTPUT_ASSOCIATIONS == 3, "outputs");
static_assert(HW_OUTPUT_SUBMAPS == 4 && HW_OUTPUT_COUNTERS == 5 && HW_OUTPUT_PLANES == 6, "outputs");
static_assert(HW_OUTPUT_SEGMENTS == 7 && HW_OUTPUT_TOPOLOGY == 8 && HW_OUTPUT_DRIVE_COMMAND == 9, "outputs");
static_assert(HW_OUTPUT_DRAWING == 10 && HW_OUTPUT_MAPPED_PLANES == 11, "outputs");
static_assert(HW_TOPOLOGY_DISCONTINUITY == 1 && HW_TOPOLOGY_SWEEP == 2 && HW_TOPOLOGY_ROOM == 3 &&
                  HW_TOPOLOGY_HALLWAY_END == 4 && HW_TOPOLOGY_JUNCTION == 5,
              "places");
static_assert(HW_LOOP_OPEN == 0 && HW_LOOP_CLOSED == 1 && HW_LOOP_UNCERTAIN == 2, "loops");
static_assert(HW_DRAWING_POLYLINE == 1 && HW_DRAWING_CIRCLE == 2 && HW_DRAWING_TEXT == 3, "drawings");
static_assert(HW_COLOUR_PLAIN == 0 && HW_COLOUR_FAINT == 1 && HW_COLOUR_SENSED == 2 &&
                  HW_COLOUR_FOLLOWED == 3,
              "colours");
static_assert(HW_COLOUR_PLANNED == 4 && HW_COLOUR_LANDMARK == 5 && HW_COLOUR_WARNING == 6 &&
                  HW_COLOUR_HIGHLIGHT == 7,
              "colours");
static_assert(HW_POSE_LOST == 0 && HW_POSE_VALID == 1, "pose status");
static_assert(HW_LANDMARK_TEMPORARY == 0 && HW_LANDMARK_MAPPED == 1 && HW_LANDMARK_DYNAMIC == 2,
              "landmark status");
static_assert(HW_PARAM_BOOL == 1 && HW_PARAM_INT == 2 && HW_PARAM_DOUBLE == 3 && HW_PARAM_CHOICE == 4,
              "parameters");
static_assert(HW_LOG_DEBUG == 0 && HW_LOG_INFO == 1 && HW_LOG_WARNING == 2 && HW_LOG_ERROR == 3,
              "log levels");
static_assert(HW_SAMPLE_TRACKED == 1u && HW_REPORT_REFINE == 1u && HW_NO_LANDMARK == UINT64_MAX, "flags");
static_assert(HW_NO_SAMPLE == UINT32_MAX, "no sample");
static_assert(HW_DRIVE_UNKNOWN == 0 && HW_DRIVE_DIFFERENTIAL == 1 && HW_DRIVE_TRACKED == 2, "drives");
static_assert(HW_DRIVE_ACKERMANN == 3 && HW_DRIVE_OMNIDIRECTIONAL == 4, "drives");

SIZE(hw_setting_t, 16);
AT(hw_setting_t, key, 0);
AT(hw_setting_t, value, 8);

SIZE(hw_driver_settings_t, 24);
AT(hw_driver_settings_t, size, 0);
AT(hw_driver_settings_t, n_settings, 4);
AT(hw_driver_settings_t, settings, 8);
AT(hw_driver_settings_t, folder, 16);

SIZE(hw_robot_info_t, 56);
AT(hw_robot_info_t, size, 0);
AT(hw_robot_info_t, flags, 4);
AT(hw_robot_info_t, name, 8);
AT(hw_robot_info_t, period_ns, 16);
AT(hw_robot_info_t, sensors, 24);
AT(hw_robot_info_t, n_sensors, 32);
AT(hw_robot_info_t, reserved, 36);
AT(hw_robot_info_t, drive, 40);
AT(hw_robot_info_t, body, 48);

SIZE(hw_answer_t, 64);
AT(hw_answer_t, size, 0);
AT(hw_answer_t, status, 4);
AT(hw_answer_t, sequence, 8);
AT(hw_answer_t, t_ns, 16);
AT(hw_answer_t, command, 24);
AT(hw_answer_t, pose, 32);
AT(hw_answer_t, landmarks, 40);
AT(hw_answer_t, counters, 48);
AT(hw_answer_t, message, 56);

SIZE(hw_driver_vtable_t, 64);
AT(hw_driver_vtable_t, open, 0);
AT(hw_driver_vtable_t, describe, 8);
AT(hw_driver_vtable_t, read, 16);
AT(hw_driver_vtable_t, write, 24);
AT(hw_driver_vtable_t, counters, 32);
AT(hw_driver_vtable_t, get_extension, 40);
AT(hw_driver_vtable_t, close, 48);
AT(hw_driver_vtable_t, destroy, 56);

SIZE(hw_driver_t, 16);
AT(hw_driver_t, vtable, 0);
AT(hw_driver_t, self, 8);

SIZE(hw_driver_info_t, 56);
AT(hw_driver_info_t, size, 0);
AT(hw_driver_info_t, reserved, 4);
AT(hw_driver_info_t, id, 8);
AT(hw_driver_info_t, name, 16);
AT(hw_driver_info_t, version, 24);
AT(hw_driver_info_t, vendor, 32);
AT(hw_driver_info_t, description, 40);
AT(hw_driver_info_t, settings, 48);

SIZE(hw_driver_factory_t, 24);
AT(hw_driver_factory_t, count, 0);
AT(hw_driver_factory_t, describe, 8);
AT(hw_driver_factory_t, create, 16);

#undef SIZE
#undef AT
