// SPDX-License-Identifier: MIT
//
// A whole plugin in plain C, to be read from top to bottom.
//
// It does the simplest thing that still is mapping: it takes the robot to stand still. The points of the
// first frame that has any are the map; each later point is taken for the nearest landmark within `bound_m`,
// or for none. Where the robot does stand still, that is right; where it moves, the share of points that fit
// nothing says so.

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <hallway/hallway.h>

// 1. What the plugin is. Everything that lives as long as the library is a constant.

static const uint32_t kInputs[] = {HW_SAMPLE_POINTS};
static const uint32_t kOutputs[] = {HW_OUTPUT_POSE, HW_OUTPUT_LANDMARKS, HW_OUTPUT_ASSOCIATIONS,
                                    HW_OUTPUT_COUNTERS};

static const hw_plugin_info_t kInfo = {
    .size = sizeof(hw_plugin_info_t),
    .n_inputs = 1,
    .id = "example_c",
    .name = "Example in C",
    .version = "1.0.0",
    .vendor = "Hallway",
    .description = "Takes the robot to stand still: the points of the first frame are the map.",
    .inputs = kInputs,
    .outputs = kOutputs,
    .n_outputs = 4,
};

// 2. The instance. The host holds it as a `void *self` and gives it back with every call.

typedef struct plugin_t {
  const hw_host_t* host;
  const hw_log_t* log;  // null where the host keeps no log
  double bound_m;
  int active;
  uint32_t sensor_id;        // the one sensor that is listened to
  hw_landmark_t* landmarks;  // in that sensor's frame
  uint64_t n_landmarks;
  uint64_t* associations;  // one for each point of the frame, reused
  uint64_t capacity;       // of `associations`
} plugin_t;

static void forget(plugin_t* plugin) {
  free(plugin->landmarks);
  plugin->landmarks = NULL;
  plugin->n_landmarks = 0;
}

// Hands one answer to the host, which copies it before put() returns: `payload` may stand on the stack.
static hw_status_t put(const plugin_t* plugin, uint32_t kind, const void* payload) {
  const hw_output_t output = {.size = sizeof output, .kind = kind, .payload = payload};
  return plugin->host->vtable->put(plugin->host->self, &output);
}

// 3. The algorithm.

static uint64_t nearest_landmark(const plugin_t* plugin, const hw_point3_t* point) {
  uint64_t best = HW_NO_LANDMARK;
  double best_squared = plugin->bound_m * plugin->bound_m;
  for (uint64_t i = 0; i < plugin->n_landmarks; ++i) {
    const double* at = plugin->landmarks[i].position;
    const double dx = point->x - at[0], dy = point->y - at[1], dz = point->z - at[2];
    const double squared = dx * dx + dy * dy + dz * dz;
    if (squared <= best_squared) {
      best_squared = squared;
      best = i;
    }
  }
  return best;
}

static int is_finite(const hw_point3_t* point) {
  return isfinite(point->x) && isfinite(point->y) && isfinite(point->z);
}

static hw_status_t start_map(plugin_t* plugin, const hw_points_t* points, hw_error_t* error) {
  if (points->count > SIZE_MAX / sizeof(hw_landmark_t)) {
    return hw_error_set(error, HW_ERROR_MEMORY, "too many points");
  }
  plugin->landmarks = malloc(points->count * sizeof(hw_landmark_t));
  if (!plugin->landmarks) return hw_error_set(error, HW_ERROR_MEMORY, "out of memory for the first frame");
  for (uint64_t i = 0; i < points->count; ++i) {
    const hw_point3_t* point = hw_point_at(points, i);
    if (!is_finite(point)) continue;
    hw_landmark_t* landmark = &plugin->landmarks[plugin->n_landmarks];
    *landmark = (hw_landmark_t){
        .id = plugin->n_landmarks, .position = {point->x, point->y, point->z}, .status = HW_LANDMARK_MAPPED};
    ++plugin->n_landmarks;
  }
  if (plugin->log) plugin->log->write(plugin->host->self, HW_LOG_INFO, "the map is made");
  return HW_OK;
}

static hw_status_t associate(plugin_t* plugin, uint32_t sample, const hw_points_t* points,
                             hw_error_t* error) {
  if (points->count > plugin->capacity) {
    uint64_t* larger = NULL;
    if (points->count <= SIZE_MAX / sizeof *larger) {
      larger = realloc(plugin->associations, points->count * sizeof *larger);
    }
    if (!larger) return hw_error_set(error, HW_ERROR_MEMORY, "out of memory for the associations");
    plugin->associations = larger;
    plugin->capacity = points->count;
  }

  uint64_t unmatched = 0;
  for (uint64_t i = 0; i < points->count; ++i) {
    const uint64_t id = nearest_landmark(plugin, hw_point_at(points, i));
    plugin->associations[i] = id;
    if (id == HW_NO_LANDMARK) {
      ++unmatched;
    } else if (plugin->landmarks[id].observations < UINT32_MAX) {
      ++plugin->landmarks[id].observations;
    }
  }

  const hw_associations_t associations = {.size = sizeof associations,
                                          .sample = sample,
                                          .count = points->count,
                                          .landmark_ids = plugin->associations};
  const hw_status_t status = put(plugin, HW_OUTPUT_ASSOCIATIONS, &associations);
  if (status != HW_OK) return hw_error_set(error, status, "the host refused the associations");

  const hw_counter_t counter = {"unmatched", (double)unmatched};
  const hw_counters_t counters = {
      .size = sizeof counters, .stride = sizeof counter, .count = 1, .counters = &counter};
  return put(plugin, HW_OUTPUT_COUNTERS, &counters);
}

// 4. The functions of the vtable, in the order of the life cycle. A function that fails says why in `error`.

static hw_status_t activate(void* self, const hw_activation_t* activation, hw_error_t* error) {
  plugin_t* plugin = self;
  for (uint32_t i = 0; i < activation->n_sensors; ++i) {
    // Structs may be larger than this file knows, so that they are reached by pointer, never as an array.
    const hw_sensor_info_t* sensor = activation->sensors[i];
    if (sensor->kind == HW_SAMPLE_POINTS) {
      plugin->sensor_id = sensor->id;
      plugin->active = 1;
      return HW_OK;
    }
  }
  return hw_error_set(error, HW_ERROR_ARGUMENT, "no sensor gives points");
}

static void deactivate(void* self) {
  plugin_t* plugin = self;
  forget(plugin);
  plugin->active = 0;
}

static hw_status_t reset(void* self, hw_error_t* error) {
  (void)error;
  forget(self);
  return HW_OK;
}

static hw_status_t process(void* self, const hw_frame_t* frame, hw_error_t* error) {
  plugin_t* plugin = self;
  for (uint32_t k = 0; k < frame->n_samples; ++k) {
    const hw_sample_t* sample = frame->samples[k];
    if (sample->kind != HW_SAMPLE_POINTS || sample->sensor_id != plugin->sensor_id) continue;
    const hw_points_t* points = sample->payload;
    hw_status_t status = HW_OK;
    if (plugin->n_landmarks == 0 && points->count > 0) {
      forget(plugin);
      status = start_map(plugin, points, error);
    }
    if (status == HW_OK) status = associate(plugin, k, points, error);
    if (status != HW_OK) return status;
  }
  // The body stands at the origin of its map, and always will.
  const hw_pose_output_t pose = {.size = sizeof pose,
                                 .status = plugin->n_landmarks > 0 ? HW_POSE_VALID : HW_POSE_LOST,
                                 .T_map_body = {.orientation = {1, 0, 0, 0}}};
  const hw_status_t status = put(plugin, HW_OUTPUT_POSE, &pose);
  return status == HW_OK ? HW_OK : hw_error_set(error, status, "the host refused the pose");
}

static hw_status_t report(void* self, const hw_report_request_t* request, hw_error_t* error) {
  (void)request;  // there is nothing to refine
  plugin_t* plugin = self;
  const hw_landmarks_t landmarks = {.size = sizeof landmarks,
                                    .stride = sizeof(hw_landmark_t),
                                    .count = plugin->n_landmarks,
                                    .landmarks = plugin->landmarks};
  const hw_status_t status = put(plugin, HW_OUTPUT_LANDMARKS, &landmarks);
  return status == HW_OK ? HW_OK : hw_error_set(error, status, "the host refused the landmarks");
}

static void destroy(void* self) {
  plugin_t* plugin = self;
  forget(plugin);
  free(plugin->associations);
  free(plugin);
}

// 5. An extension: one parameter.

static const hw_param_info_t kBound = {
    .size = sizeof(hw_param_info_t),
    .type = HW_PARAM_DOUBLE,
    .name = "bound_m",
    .unit = "m",
    .help =
        "Farthest a point may lie from the landmark it is taken for; about five times the sensor's noise.",
    .default_value = {.type = HW_PARAM_DOUBLE, .as.real = 0.25},
    .minimum = {.type = HW_PARAM_DOUBLE, .as.real = 0.0},
    .maximum = {.type = HW_PARAM_DOUBLE, .as.real = 100.0},
};

static uint32_t count_params(void* self) {
  (void)self;
  return 1;
}

static const hw_param_info_t* describe_param(void* self, uint32_t index) {
  (void)self;
  return index == 0 ? &kBound : NULL;
}

static hw_status_t get_param(void* self, uint32_t index, hw_param_value_t* value, hw_error_t* error) {
  const plugin_t* plugin = self;
  if (index != 0) return hw_error_set(error, HW_ERROR_NOT_FOUND, "no parameter has that index");
  *value = (hw_param_value_t){.type = HW_PARAM_DOUBLE, .as.real = plugin->bound_m};
  return HW_OK;
}

static hw_status_t set_param(void* self, uint32_t index, const hw_param_value_t* value, hw_error_t* error) {
  plugin_t* plugin = self;
  if (plugin->active) return hw_error_set(error, HW_ERROR_STATE, "parameters are set before activation");
  if (index != 0) return hw_error_set(error, HW_ERROR_NOT_FOUND, "no parameter has that index");
  if (value->type != HW_PARAM_DOUBLE) return hw_error_set(error, HW_ERROR_ARGUMENT, "bound_m is a double");
  if (!(value->as.real >= kBound.minimum.as.real && value->as.real <= kBound.maximum.as.real)) {
    return hw_error_set(error, HW_ERROR_RANGE, "bound_m must be between 0 and 100");
  }
  plugin->bound_m = value->as.real;
  return HW_OK;
}

static const hw_params_t kParams = {count_params, describe_param, get_param, set_param};

static const void* get_extension(void* self, const char* id) {
  (void)self;
  return strcmp(id, HW_EXT_PARAMS) == 0 ? &kParams : NULL;
}

// 6. The factory makes instances …

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
  plugin->log = host->vtable->get_extension(host->self, HW_EXT_LOG);
  plugin->bound_m = kBound.default_value.as.real;
  *out = (hw_plugin_t){&kVtable, plugin};
  return HW_OK;
}

static const hw_plugin_factory_t kFactory = {count, describe, create};

// 7. … and the entry, the one symbol that the library shows, leads to the factory.

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
