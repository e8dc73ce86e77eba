// SPDX-License-Identifier: MIT
// run_driver DRIVER.so REPORT [--frames FILE] [--delay-ms N] [--twice] KEY=VALUE…
//
// The smallest host of a driver: loads it by its factory, answers every frame with numbers made from its sequence number,
// and writes what it saw to REPORT, a line each; the frames' bytes go to FILE. Ends when the driver does, or by SIGTERM.
#include <dlfcn.h>
#include <hallway/driver.h>
#include <hallway/entry.h>
#include <hallway/ext/log.h>
#include <signal.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "base/text.hpp"
#include "host/samples/frame_bytes.hpp"

namespace {

volatile sig_atomic_t end_asked = 0;
std::FILE* report = nullptr;
std::mutex report_mutex;

void write_line(const std::string& line) {
  const std::lock_guard lock(report_mutex);
  std::fprintf(report, "%s\n", line.c_str());
  std::fflush(report);
}

void write_log_line(void*, std::uint32_t level, const char* message) {
  write_line("log " + std::to_string(level) + " " + message);
}

constexpr hw_log_t kLog{&write_log_line};
constexpr hw_host_vtable_t kHostTable{
    [](void*, const hw_output_t*) -> hw_status_t { return HW_ERROR_STATE; },
    [](void*, const char* id) -> const void* { return std::strcmp(id, HW_EXT_LOG) == 0 ? &kLog : nullptr; }};

struct Options {
  std::string driver{};
  std::string frames{};
  int delay_ms = 0;
  bool twice = false;
  std::vector<std::pair<std::string, std::string>> settings{};
};

Options parse(int argc, char** argv) {
  Options options;
  options.driver = argv[1];
  for (int i = 3; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--twice") {
      options.twice = true;
    } else if (word == "--frames" && i + 1 < argc) {
      options.frames = argv[++i];
    } else if (word == "--delay-ms" && i + 1 < argc) {
      options.delay_ms = std::atoi(argv[++i]);
    } else {
      const std::size_t equals = word.find('=');
      if (equals == std::string::npos) throw std::runtime_error("what is " + word + "?");
      options.settings.emplace_back(word.substr(0, equals), word.substr(equals + 1));
    }
  }
  return options;
}

hw_driver_t make_driver(const std::string& file, const hw_host_t& host) {
  void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw std::runtime_error(::dlerror());
  const auto* entry = static_cast<const hw_entry_t*>(::dlsym(library, "hw_entry"));
  if (entry == nullptr) throw std::runtime_error("no entry");
  const auto* factory = static_cast<const hw_driver_factory_t*>(entry->get_factory(HW_DRIVER_FACTORY_ID));
  if (factory == nullptr || factory->count() != 1) throw std::runtime_error("no driver");
  hw_driver_t driver{};
  hw_error_t error{};
  error.size = sizeof error;
  if (factory->create(&host, factory->describe(0)->id, &driver, &error) != HW_OK)
    throw std::runtime_error(error.message);
  return driver;
}

class Run {
 public:
  Run(hw_driver_t driver, const Options& options) : driver_(driver), options_(options) {
    error_.size = sizeof error_;
    last_.size = sizeof last_;
  }

  ~Run() {
    if (open_) driver_.vtable->close(driver_.self);
    driver_.vtable->destroy(driver_.self);
  }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  void open() {
    std::vector<hw_setting_t> settings;
    for (const auto& [key, value] : options_.settings) settings.push_back({key.c_str(), value.c_str()});
    const hw_driver_settings_t given{sizeof given, static_cast<std::uint32_t>(settings.size()),
                                     settings.data(), "."};
    check(driver_.vtable->open(driver_.self, &given, &error_));
    open_ = true;
    const hw_robot_info_t* robot = nullptr;
    check(driver_.vtable->describe(driver_.self, &robot, &error_));
    write_line("robot " + std::string(robot->name) + " " + std::to_string(robot->flags) + " " +
               std::to_string(robot->period_ns));
    for (std::uint32_t i = 0; i < robot->n_sensors; ++i) tell_sensor(*robot->sensors[i]);
    write_line(is_default(SIGINT) && is_default(SIGTERM) ? "signals untouched" : "signals CHANGED");
    ::signal(SIGTERM, [](int) { end_asked = 1; });
  }

  void loop() {
    std::FILE* frames = options_.frames.empty() ? nullptr : std::fopen(options_.frames.c_str(), "wb");
    while (end_asked == 0) {
      std::uint32_t found = 0;
      const hw_frame_t* frame = nullptr;
      check(driver_.vtable->read(driver_.self, 100'000'000, &found, &frame, &error_));
      if (found == HW_READ_END) break;
      if (found == HW_READ_FRAME) take(*frame, frames);
    }
    if (frames != nullptr) std::fclose(frames);
    const hw_drive_command_t stop{sizeof stop, 0, 0, 0, 0};
    last_.command = &stop;
    last_.status = HW_ANSWER_END;
    check(driver_.vtable->write(driver_.self, &last_, &error_));
  }

  void close() {
    const hw_counters_t& counters = *driver_.vtable->counters(driver_.self);
    for (std::uint64_t i = 0; i < counters.count; ++i) {
      const auto& counter = static_cast<const hw_counter_t*>(counters.counters)[i];
      write_line(std::string("counter ") + counter.name + " " + hallway::format_double(counter.value));
    }
    driver_.vtable->close(driver_.self);
    open_ = false;
    ::signal(SIGTERM, SIG_DFL);
    write_line(is_default(SIGPIPE) ? "closed" : "closed SIGPIPE CHANGED");
  }

 private:
  static bool is_default(int signal) {
    struct sigaction action {};
    ::sigaction(signal, nullptr, &action);
    return action.sa_handler == SIG_DFL;
  }

  void check(hw_status_t status) const {
    if (status != HW_OK)
      throw std::runtime_error(std::string(hw_status_name(status)) + ": " + error_.message);
  }

  static void tell_sensor(const hw_sensor_info_t& sensor) {
    std::string line = "sensor " + std::to_string(sensor.id) + " " + sensor.name;
    for (const double p : sensor.T_body_sensor.position) line += " " + hallway::format_double(p);
    for (const double q : sensor.T_body_sensor.orientation) line += " " + hallway::format_double(q);
    line +=
        " " + hallway::format_double(sensor.noise_m[1]) + " " + hallway::format_double(sensor.max_range_m);
    write_line(line);
  }

  void take(const hw_frame_t& frame, std::FILE* frames) {
    std::string bytes;
    hallway::host::FrameWriter().write_over(bytes, frame);
    if (frames != nullptr) std::fwrite(bytes.data(), 1, bytes.size(), frames);
    const hw_sample_t& sample = *frame.samples[0];
    write_line("frame " + std::to_string(frame.sequence) + " " + std::to_string(frame.t_ns) + " " +
               std::to_string(sample.sensor_id) + " " + std::to_string(sample.sequence) + " " +
               std::to_string(static_cast<const hw_points_t*>(sample.payload)->count));
    std::this_thread::sleep_for(std::chrono::milliseconds(options_.delay_ms));
    answer(frame);
  }

  /// Numbers that tell one frame from another. The fourth frame is answered late, with the robot stopped.
  void answer(const hw_frame_t& frame) {
    const double k = static_cast<double>(frame.sequence);
    const bool late = frame.sequence == 3;
    const hw_drive_command_t command{sizeof command, 0, late ? 0 : 0.25 + k, late ? 0 : -0.5, 0};
    const hw_pose_output_t pose{
        sizeof pose, late ? HW_POSE_LOST : HW_POSE_VALID, {{k, 2 * k, 0.5}, {0.6, 0, 0, 0.8}}, nullptr, 0};
    const hw_landmark_t list[2] = {{7, {k, 0.1, -1}, 3, HW_LANDMARK_MAPPED},
                                   {(1ull << 40) + frame.sequence, {0, 0, 4}, 1, HW_LANDMARK_DYNAMIC}};
    const hw_landmarks_t landmarks{sizeof landmarks, sizeof(hw_landmark_t), 2, list, nullptr};
    const hw_counter_t counter{"submaps_closed", 10 * k};
    const hw_counters_t counters{sizeof counters, sizeof(hw_counter_t), 1, &counter};
    last_ = {};
    last_.size = sizeof last_;
    last_.status = late ? HW_ANSWER_LATE : HW_ANSWER_DONE;
    last_.sequence = frame.sequence;
    last_.t_ns = frame.t_ns;
    hw_answer_t all = last_;
    all.command = &command;
    all.pose = &pose;
    all.landmarks = &landmarks;
    all.counters = &counters;
    all.message = late ? "no answer within 100 ms" : nullptr;
    check(driver_.vtable->write(driver_.self, &all, &error_));
  }

  hw_driver_t driver_;
  const Options& options_;
  hw_error_t error_{};
  hw_answer_t last_{};
  bool open_ = false;
};

void run(const Options& options) {
  const hw_host_t host{sizeof host, 0, {HW_ABI_MAJOR, HW_ABI_MINOR}, &kHostTable, nullptr, "run_driver", "1"};
  Run run(make_driver(options.driver, host), options);
  for (int time = 0; time < (options.twice ? 2 : 1); ++time) {
    run.open();
    run.loop();
    run.close();
    end_asked = 0;
  }
}

}  // namespace

int main(int argc, char** argv) {
  ::signal(SIGPIPE, SIG_DFL);  // whatever the parent did
  if (argc < 3 || (report = std::fopen(argv[2], "w")) == nullptr) return 2;
  try {
    run(parse(argc, argv));
  } catch (const std::exception& failure) {
    write_line(std::string("error ") + failure.what());
    return 1;
  }
}
