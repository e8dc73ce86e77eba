// SPDX-License-Identifier: MIT
#pragma once

// Turns a C++ class into a driver. Header only, C++17; every exception becomes a status and a message.
//
//     class Base final : public hallway::sdk::Driver {
//      public:
//       static const hw_driver_info_t* info();            // see driver_info()
//       explicit Base(const hw_host_t* host) : Driver(host) {}
//       void open(const DriverSettings& settings) override;
//       const hw_robot_info_t& describe() override;
//       Reading read(std::int64_t wait_ns) override;
//       void write(const hw_answer_t& answer) override;
//       void close() override;
//     };
//     HALLWAY_DRIVER(Base);

#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <utility>

#include "driver.h"
#include "plugin.hpp"

namespace hallway::sdk {

/// The settings that a driver is opened with.
class DriverSettings {
 public:
  explicit DriverSettings(const hw_driver_settings_t& settings) : settings_(settings) {}

  const hw_driver_settings_t& c_settings() const { return settings_; }
  /// What relative file names are relative to.
  std::string folder() const { return settings_.folder; }
  /// The value of `key`, or `otherwise` where it is not set.
  std::string text(const char* key, const std::string& otherwise = {}) const {
    for (std::uint32_t i = 0; i < settings_.n_settings; ++i) {
      if (std::strcmp(settings_.settings[i].key, key) == 0) return settings_.settings[i].value;
    }
    return otherwise;
  }
  /// Throws Failure if a key is set that is not among `known`.
  template <std::size_t N>
  void expect_only(const char* const (&known)[N]) const {
    for (std::uint32_t i = 0; i < settings_.n_settings; ++i) {
      bool found = false;
      std::string names;
      for (const char* name : known) {
        found = found || std::strcmp(settings_.settings[i].key, name) == 0;
        names += std::string(names.empty() ? "" : ", ") + name;
      }
      if (!found) {
        throw Failure(HW_ERROR_NOT_FOUND, std::string("there is no setting \"") + settings_.settings[i].key +
                                              "\"; there are: " + names);
      }
    }
  }

 private:
  const hw_driver_settings_t& settings_;
};

/// What a driver is, for Driver::info(). Everything given must live as long as the library.
constexpr hw_driver_info_t driver_info(const char* id, const char* name, const char* version,
                                       const char* vendor, const char* description, const char* settings) {
  hw_driver_info_t info{};
  info.size = sizeof info;
  info.id = id;
  info.name = name;
  info.version = version;
  info.vendor = vendor;
  info.description = description;
  info.settings = settings;
  return info;
}

/// Base of a driver's class. A derived class has, besides, a constructor from `const hw_host_t*` and
/// `static const hw_driver_info_t* info()`. What these functions throw reaches the host as a status and a message.
class Driver {
 public:
  /// What read() gives; `frame` where `found` is HW_READ_FRAME.
  struct Reading {
    std::uint32_t found = HW_READ_NOTHING;
    const hw_frame_t* frame = nullptr;
  };

  virtual ~Driver() = default;
  Driver(const Driver&) = delete;
  Driver& operator=(const Driver&) = delete;

  virtual void open(const DriverSettings& settings) = 0;
  /// Lives until close().
  virtual const hw_robot_info_t& describe() = 0;
  /// The frame lives until the next read() or close().
  virtual Reading read(std::int64_t wait_ns) = 0;
  /// May be called by another thread while one is in read().
  virtual void write(const hw_answer_t& answer) = 0;
  /// Numbers worth watching, or null.
  virtual const hw_counters_t* counters() { return nullptr; }
  /// Must not throw.
  virtual void close() = 0;

 protected:
  explicit Driver(const hw_host_t* host) : host_(host) {}
  const Host& host() const { return host_; }

 private:
  friend struct DriverBorder;
  Host host_;
  bool open_ = false;
};

/// The C functions in front of a Driver.
struct DriverBorder {
  static Driver& driver(void* self) { return *static_cast<Driver*>(self); }

  static void demand(bool condition, hw_status_t status, const char* message) {
    if (!condition) throw Failure(status, message);
  }

  static hw_status_t open(void* self, const hw_driver_settings_t* settings, hw_error_t* error) noexcept {
    return guard(error, [&] {
      demand(settings != nullptr, HW_ERROR_ARGUMENT, "open: the settings are null");
      demand(!driver(self).open_, HW_ERROR_STATE, "open: the driver is open");
      driver(self).open(DriverSettings(*settings));
      driver(self).open_ = true;
    });
  }

  static hw_status_t describe(void* self, const hw_robot_info_t** robot, hw_error_t* error) noexcept {
    return guard(error, [&] {
      demand(robot != nullptr, HW_ERROR_ARGUMENT, "describe: the argument is null");
      demand(driver(self).open_, HW_ERROR_STATE, "describe: the driver is not open");
      *robot = &driver(self).describe();
    });
  }

  static hw_status_t read(void* self, std::int64_t wait_ns, std::uint32_t* found, const hw_frame_t** frame,
                          hw_error_t* error) noexcept {
    return guard(error, [&] {
      demand(found != nullptr && frame != nullptr, HW_ERROR_ARGUMENT, "read: an argument is null");
      demand(driver(self).open_, HW_ERROR_STATE, "read: the driver is not open");
      const Driver::Reading reading = driver(self).read(wait_ns);
      *found = reading.found;
      *frame = reading.frame;
    });
  }

  static hw_status_t write(void* self, const hw_answer_t* answer, hw_error_t* error) noexcept {
    return guard(error, [&] {
      demand(answer != nullptr, HW_ERROR_ARGUMENT, "write: the answer is null");
      demand(driver(self).open_, HW_ERROR_STATE, "write: the driver is not open");
      driver(self).write(*answer);
    });
  }

  static const hw_counters_t* counters(void* self) noexcept {
    const hw_counters_t* counters = nullptr;
    guard(nullptr, [&] { counters = driver(self).counters(); });
    return counters;
  }

  static const void* get_extension(void*, const char*) noexcept { return nullptr; }

  static void close(void* self) noexcept {
    guard(nullptr, [&] {
      if (std::exchange(driver(self).open_, false)) driver(self).close();
    });
  }

  static void destroy(void* self) noexcept { delete &driver(self); }

  static constexpr hw_driver_vtable_t kVtable{&open,     &describe,      &read,  &write,
                                              &counters, &get_extension, &close, &destroy};
};

/// The factory and entry of a library whose driver is the class `Class`.
template <typename Class>
struct DriverFactory {
  static std::uint32_t count() noexcept { return 1; }

  static const hw_driver_info_t* describe(std::uint32_t index) noexcept {
    const hw_driver_info_t* info = nullptr;
    guard(nullptr, [&] { info = index == 0 ? Class::info() : nullptr; });
    return info;
  }

  static hw_status_t create(const hw_host_t* host, const char* id, hw_driver_t* driver,
                            hw_error_t* error) noexcept {
    return guard(error, [&] {
      DriverBorder::demand(host && id && driver, HW_ERROR_ARGUMENT, "create: an argument is null");
      DriverBorder::demand(std::strcmp(id, Class::info()->id) == 0, HW_ERROR_NOT_FOUND,
                           "create: no driver of this library has that id");
      driver->self = static_cast<Driver*>(std::make_unique<Class>(host).release());
      driver->vtable = &DriverBorder::kVtable;
    });
  }

  static hw_status_t init(const char*, hw_error_t*) noexcept { return HW_OK; }
  static void deinit() noexcept {}

  static const void* get_factory(const char* id) noexcept {
    return id && std::strcmp(id, HW_DRIVER_FACTORY_ID) == 0 ? &kFactory : nullptr;
  }

  static constexpr hw_driver_factory_t kFactory{&count, &describe, &create};
  static constexpr hw_entry_t kEntry{{HW_ABI_MAJOR, HW_ABI_MINOR}, &init, &deinit, &get_factory};
};

}  // namespace hallway::sdk

/// Defines the exported symbol of a library whose driver is the given class. Once per library, outside of namespaces.
#define HALLWAY_DRIVER(...) \
  extern "C" HW_EXPORT constexpr hw_entry_t hw_entry = ::hallway::sdk::DriverFactory<__VA_ARGS__>::kEntry
