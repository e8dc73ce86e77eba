// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

#include "host.h"
#include "output.h"
#include "robot.h"
#include "sample.h"
#include "status.h"

// A driver stands between `hallway-robot` and a robot: it gives the frames that plugins are fed with and takes what they
// answer. It is a library like a plugin's, with the entry of entry.h and a factory of its own; it runs in the process of
// its host, which trusts it.

/// Id under which hw_entry_t.get_factory() gives a hw_driver_factory_t.
#define HW_DRIVER_FACTORY_ID "hw.driver-factory/1"

/// A setting of a driver, as it stands in the robot's configuration. Frozen.
typedef struct hw_setting_t {
  const char* key;    ///< UTF-8, never null
  const char* value;  ///< UTF-8, never null
} hw_setting_t;

/// What a driver is opened with.
typedef struct hw_driver_settings_t {
  uint32_t size;                 ///< sizeof(hw_driver_settings_t) of the host
  uint32_t n_settings;           ///< number of settings
  const hw_setting_t* settings;  ///< keys are distinct and among hw_driver_info_t.settings
  const char* folder;            ///< that relative file names in settings are relative to; never null
} hw_driver_settings_t;

/// Flag of a robot: time is the driver's own (a simulation, a log read as fast as it can be). The host answers every frame before it reads
/// the next, however long that takes, and drops none.
#define HW_ROBOT_LOCK_STEP 1u

/// What is known of the robot behind a driver.
typedef struct hw_robot_info_t {
  uint32_t size;                           ///< sizeof(hw_robot_info_t) of the driver
  uint32_t flags;                          ///< HW_ROBOT_LOCK_STEP
  const char* name;                        ///< UTF-8, never null
  int64_t period_ns;                       ///< from frame to frame; 0 where it is not regular
  const hw_sensor_info_t* const* sensors;  ///< n_sensors pointers; ids are distinct
  uint32_t n_sensors;                      ///< number of sensors
  uint32_t reserved;                       ///< 0
  const hw_drive_info_t* drive;            ///< null where it is not known. Since 1.4.
  const hw_body_info_t* body;              ///< null where it is not known. Since 1.4.
} hw_robot_info_t;

/// What read() found.
enum {
  HW_READ_NOTHING = 0,  ///< no frame within the time
  HW_READ_FRAME = 1,    ///< a frame
  HW_READ_END = 2       ///< there will be no more frames
};

/// hw_answer_t.status.
enum {
  HW_ANSWER_DONE = 0,    ///< the plugins answered in time
  HW_ANSWER_LATE = 1,    ///< they have not answered within the watchdog's time; the command stops the robot
  HW_ANSWER_FAILED = 2,  ///< they have failed; the command stops the robot
  HW_ANSWER_END = 3      ///< the host ends; the command stops the robot
};

/// What the host answers to a frame. What is not known is null.
typedef struct hw_answer_t {
  uint32_t size;                      ///< sizeof(hw_answer_t) of the host
  uint32_t status;                    ///< HW_ANSWER_…
  uint64_t sequence;                  ///< of the frame
  int64_t t_ns;                       ///< time of the frame
  const hw_drive_command_t* command;  ///< how to move from now on
  const hw_pose_output_t* pose;       ///< where the body is
  const hw_landmarks_t*
      landmarks;  ///< the map, where the host has asked for it since the answer before; of the frame before this one
  const hw_counters_t* counters;  ///< of the plugins and of the host
  const char* message;            ///< UTF-8: what went wrong, for people
} hw_answer_t;

/// The functions of a driver. Frozen; more is reached through get_extension(). No exception or exit may cross, and nothing is
/// written to stdout or stderr. The life cycle is
///
///     create → open → describe → { read | write | counters }* → close → destroy
typedef struct hw_driver_vtable_t {
  /// Opens the robot. Settings live until open() returns. On failure the driver stays closed. [main]
  hw_status_t (*open)(void* self, const hw_driver_settings_t* settings, hw_error_t* error);
  /// What robot it is; lives until close(). May wait for the robot to say so. [main]
  hw_status_t (*describe)(void* self, const hw_robot_info_t** robot, hw_error_t* error);
  /// Waits for a frame, `wait_ns` at most, and says in `found` (HW_READ_…) what came. The frame lives until the
  /// next read() or close(). [loop]
  hw_status_t (*read)(void* self, int64_t wait_ns, uint32_t* found, const hw_frame_t** frame,
                      hw_error_t* error);
  /// Hands an answer to the robot, and does not wait for it. Called by one thread at a time, also while another one is in
  /// read(). [background]
  hw_status_t (*write)(void* self, const hw_answer_t* answer, hw_error_t* error);
  /// Numbers worth watching, e.g. how many frames were lost on their way; lives until the next call of
  /// counters() or close(). [loop]
  const hw_counters_t* (*counters)(void* self);
  /// The driver's extension of that id, or null; lives as long as the driver. [main]
  const void* (*get_extension)(void* self, const char* id);
  /// Ends what open() began; only called while open. [main]
  void (*close)(void* self);
  /// Frees the driver; close() has been called if it was open. [main]
  void (*destroy)(void* self);
} hw_driver_vtable_t;

/// A driver instance. Frozen.
typedef struct hw_driver_t {
  const hw_driver_vtable_t* vtable;  ///< never null, no function in it is null
  void* self;                        ///< first argument of every function of the vtable
} hw_driver_t;

/// What a driver is; lives as long as its library is loaded. Texts are UTF-8 and never null, but may be empty
/// except `id`.
typedef struct hw_driver_info_t {
  uint32_t size;            ///< sizeof(hw_driver_info_t) of the driver
  uint32_t reserved;        ///< 0
  const char* id;           ///< unique and stable; letters, digits and _ - . only
  const char* name;         ///< for people
  const char* version;      ///< of the driver
  const char* vendor;       ///< who made it
  const char* description;  ///< one sentence
  const char*
      settings;  ///< a line for each setting: its key, a blank, and for people what it means, with its default.
                 ///< The host refuses settings of other keys
} hw_driver_info_t;

/// Counts, describes and makes the drivers of a library. Frozen.
typedef struct hw_driver_factory_t {
  /// Number of drivers in this library. [main]
  uint32_t (*count)(void);
  /// What driver `index` is; null if there is none. [main]
  const hw_driver_info_t* (*describe)(uint32_t index);
  /// Makes the driver of that id, closed, and fills `driver`, which the caller owns. `host` outlives it; its put() takes
  /// nothing from drivers. HW_ERROR_NOT_FOUND: no such id. [main]
  hw_status_t (*create)(const hw_host_t* host, const char* id, hw_driver_t* driver, hw_error_t* error);
} hw_driver_factory_t;
