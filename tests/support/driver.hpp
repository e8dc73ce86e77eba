// SPDX-License-Identifier: MIT
#pragma once

#include <dlfcn.h>
#include <hallway/driver.h>
#include <hallway/entry.h>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace hallway::test {

/// A driver of a library, used as its host does: by the functions of the ABI alone.
class Driver {
 public:
  explicit Driver(const std::filesystem::path& file) {
    library_ = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library_ == nullptr) throw std::runtime_error(::dlerror());
    const auto& entry = *static_cast<const hw_entry_t*>(::dlsym(library_, HW_ENTRY_SYMBOL));
    factory_ = static_cast<const hw_driver_factory_t*>(entry.get_factory(HW_DRIVER_FACTORY_ID));
    host_.size = sizeof host_;
    host_.vtable = &kHostVtable;
    host_.name = host_.version = "test";
    check(factory_->create(&host_, factory_->describe(0)->id, &driver_, clear()));
  }
  ~Driver() {
    close();
    driver_.vtable->destroy(driver_.self);
    ::dlclose(library_);
  }
  Driver(const Driver&) = delete;
  Driver& operator=(const Driver&) = delete;

  const hw_driver_info_t& info() const { return *factory_->describe(0); }
  hw_status_t open(const std::vector<std::pair<std::string, std::string>>& settings) {
    std::vector<hw_setting_t> list;
    for (const auto& [key, value] : settings) list.push_back({key.c_str(), value.c_str()});
    const hw_driver_settings_t all{sizeof all, static_cast<std::uint32_t>(list.size()), list.data(), "."};
    const hw_status_t status = driver_.vtable->open(driver_.self, &all, clear());
    open_ = status == HW_OK;
    return status;
  }
  const hw_robot_info_t* describe() {
    const hw_robot_info_t* robot = nullptr;
    return driver_.vtable->describe(driver_.self, &robot, clear()) == HW_OK ? robot : nullptr;
  }
  /// @return HW_READ_…; throws for a status that is not HW_OK
  std::uint32_t read(std::int64_t wait_ns, const hw_frame_t** frame) {
    std::uint32_t found = HW_READ_NOTHING;
    check(driver_.vtable->read(driver_.self, wait_ns, &found, frame, clear()));
    return found;
  }
  void write(const hw_answer_t& answer) { check(driver_.vtable->write(driver_.self, &answer, clear())); }
  double counter(const std::string& name) {
    const hw_counters_t* counters = driver_.vtable->counters(driver_.self);
    for (std::uint64_t i = 0; i < counters->count; ++i) {
      const auto* at = static_cast<const char*>(counters->counters) + i * counters->stride;
      const auto& counter = *static_cast<const hw_counter_t*>(static_cast<const void*>(at));
      if (name == counter.name) return counter.value;
    }
    throw std::runtime_error("no counter " + name);
  }
  void close() {
    if (std::exchange(open_, false)) driver_.vtable->close(driver_.self);
  }
  /// Why the last call failed.
  std::string message() const { return error_.message; }

 private:
  hw_error_t* clear() {
    error_ = {};
    error_.size = sizeof error_;
    return &error_;
  }
  void check(hw_status_t status) const {
    if (status != HW_OK) throw std::runtime_error(error_.message);
  }

  static constexpr hw_host_vtable_t kHostVtable{
      [](void*, const hw_output_t*) -> hw_status_t { return HW_ERROR_UNSUPPORTED; },
      [](void*, const char*) -> const void* { return nullptr; }};

  void* library_ = nullptr;
  const hw_driver_factory_t* factory_ = nullptr;
  hw_host_t host_{};
  hw_driver_t driver_{};
  hw_error_t error_{};
  bool open_ = false;
};

}  // namespace hallway::test
