// SPDX-License-Identifier: MIT
//
// A whole plugin in plain C that drives, to be read beside example_c.c, which explains what every plugin has.
//
// It goes straight ahead. When a contact zone is pressed, it backs off and turns away from the side that was touched,
// then goes on. It needs no samples, and takes those of contact zones where a sensor gives any. It commands no more than
// the robot's drive can do, as far as that is known.

#include <stdlib.h>
#include <string.h>

#include <hallway/hallway.h>

// 1. What the plugin is: one input that may be there, one output.

static const uint32_t kOptionalInputs[] = {HW_SAMPLE_BUMP};
static const uint32_t kOutputs[] = {HW_OUTPUT_DRIVE_COMMAND};

static const hw_plugin_info_t kInfo = {
    .size = sizeof(hw_plugin_info_t),
    .id = "drive_c",
    .name = "Drive in C",
    .version = "1.0.0",
    .vendor = "Hallway",
    .description = "Goes straight ahead, and turns away from what it touches.",
    .outputs = kOutputs,
    .n_outputs = 1,
    .optional_inputs = kOptionalInputs,
    .n_optional_inputs = 1,
};

// 2. The instance.

typedef struct plugin_t {
  const hw_host_t* host;
  double speed_m_s;  // within the limits of the drive
  double greatest_turn_rad_s;
  int has_touched;
  int64_t touched_ns;  // time of the last frame in which it did; it backs off for a while
  double turn_rad_s;   // meanwhile
} plugin_t;

static const double kSpeed_m_s = 0.3;
static const double kTurn_rad_s = 0.8;
static const uint64_t kAway_ns = 1500000000;

// 3. The algorithm.

// Whether a zone is pressed. `side` gets the sum of the directions' y: positive where the left was touched.
static int is_touching(const hw_bump_t* bump, double* side) {
  int touching = 0;
  for (uint64_t i = 0; i < bump->count; ++i) {
    const hw_bump_zone_t* zone = hw_bump_zone_at(bump, i);
    if (!zone->pressed) continue;
    touching = 1;
    *side += zone->direction[1];
  }
  return touching;
}

static hw_status_t process(void* self, const hw_frame_t* frame, hw_error_t* error) {
  plugin_t* plugin = self;
  double side = 0;
  int touching = 0;
  for (uint32_t k = 0; k < frame->n_samples; ++k) {
    const hw_sample_t* sample = frame->samples[k];
    if (sample->kind == HW_SAMPLE_BUMP && is_touching(sample->payload, &side)) touching = 1;
  }
  if (touching) {
    plugin->has_touched = 1;
    plugin->touched_ns = frame->t_ns;
    plugin->turn_rad_s = side > 0 ? -plugin->greatest_turn_rad_s : plugin->greatest_turn_rad_s;
  }
  // Times may be any: without a sign their difference does not overflow.
  const int away = plugin->has_touched && (uint64_t)frame->t_ns - (uint64_t)plugin->touched_ns < kAway_ns;
  // Members that are not named here, such as the sideways speed, are 0.
  const hw_drive_command_t command = {.size = sizeof command,
                                      .linear_m_s = away ? -0.5 * plugin->speed_m_s : plugin->speed_m_s,
                                      .angular_rad_s = away ? plugin->turn_rad_s : 0};
  const hw_output_t output = {.size = sizeof output, .kind = HW_OUTPUT_DRIVE_COMMAND, .payload = &command};
  const hw_status_t status = plugin->host->vtable->put(plugin->host->self, &output);
  return status == HW_OK ? HW_OK : hw_error_set(error, status, "the host refused the command");
}

// 4. The rest of the life cycle: there is no map.

static void forget(plugin_t* plugin) {
  plugin->has_touched = 0;
  plugin->turn_rad_s = 0;
}

static hw_status_t activate(void* self, const hw_activation_t* activation, hw_error_t* error) {
  (void)error;
  plugin_t* plugin = self;
  plugin->speed_m_s = kSpeed_m_s;
  plugin->greatest_turn_rad_s = kTurn_rad_s;
  const hw_drive_info_t* drive = hw_drive_of(activation);
  if (drive) {  // a limit that is not known is NaN, and limits nothing
    plugin->speed_m_s = hw_within_limit(kSpeed_m_s, drive->max_speed_m_s);
    plugin->greatest_turn_rad_s = hw_within_limit(kTurn_rad_s, drive->max_angular_rad_s);
  }
  forget(plugin);
  return HW_OK;
}

static void deactivate(void* self) {
  (void)self;
}

static hw_status_t reset(void* self, hw_error_t* error) {
  (void)error;
  forget(self);
  return HW_OK;
}

static hw_status_t report(void* self, const hw_report_request_t* request, hw_error_t* error) {
  (void)self;
  (void)request;
  (void)error;
  return HW_OK;
}

static const void* get_extension(void* self, const char* id) {
  (void)self;
  (void)id;
  return NULL;
}

static void destroy(void* self) {
  free(self);
}

// 5. The factory and the entry.

static const hw_plugin_vtable_t kVtable = {activate, deactivate,    reset,  process,
                                           report,   get_extension, destroy};

static uint32_t count(void) {
  return 1;
}

static const hw_plugin_info_t* describe(uint32_t index) {
  return index == 0 ? &kInfo : NULL;
}

static hw_status_t create(const hw_host_t* host, const char* id, hw_plugin_t* out, hw_error_t* error) {
  if (strcmp(id, kInfo.id) != 0) {
    return hw_error_set(error, HW_ERROR_NOT_FOUND, "no plugin of this library has that id");
  }
  plugin_t* plugin = calloc(1, sizeof *plugin);
  if (!plugin) return hw_error_set(error, HW_ERROR_MEMORY, "out of memory");
  plugin->host = host;
  *out = (hw_plugin_t){&kVtable, plugin};
  return HW_OK;
}

static const hw_plugin_factory_t kFactory = {count, describe, create};

static hw_status_t init(const char* library_path, hw_error_t* error) {
  (void)library_path;
  (void)error;
  return HW_OK;
}

static void deinit(void) {}

static const void* get_factory(const char* id) {
  return strcmp(id, HW_PLUGIN_FACTORY_ID) == 0 ? &kFactory : NULL;
}

const hw_entry_t hw_entry = {{HW_ABI_MAJOR, HW_ABI_MINOR}, init, deinit, get_factory};
