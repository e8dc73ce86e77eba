// SPDX-License-Identifier: MIT
// How failures are told.
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "conformance/call_mark.hpp"
#include "conformance/instance.hpp"
#include "conformance/texts.hpp"
#include "conformance/walk.hpp"
#include "host/load/error_text.hpp"

namespace hallway::conformance {
namespace {

using Attempt = std::function<hw_status_t(hw_error_t*)>;

/// Calls that fail, as far as this plugin has them.
class Failures {
 public:
  explicit Failures(const Subject& subject)
      : library_(subject.file), host_({}), plugin_(library_, subject.plain()) {}

  /// Calls `look` with each: its name, and how to make it.
  void each(const std::function<void(const char* name, const Attempt&)>& look) {
    look("create", [this](hw_error_t* error) {
      hw_plugin_t plugin{};
      return marked("create", [&] {
        return library_.factory().create(&host_.host(), "no_such_plugin", &plugin, error);
      });
    });
    const hw_plugin_t& raw = plugin_.raw();
    look("activate", [&](hw_error_t* error) {
      hw_activation_t none{};
      none.size = sizeof none;
      return deactivated(raw,
                         marked("activate", [&] { return raw.vtable->activate(raw.self, &none, error); }));
    });
    const hw_params_t* params = plugin_.parameters();
    if (params == nullptr) return;
    look("get", [&](hw_error_t* error) {
      hw_param_value_t value{};
      return marked("get", [&] { return params->get(raw.self, UINT32_MAX, &value, error); });
    });
    look("set", [&](hw_error_t* error) {
      const hw_param_value_t value{};
      return marked("set", [&] { return params->set(raw.self, UINT32_MAX, &value, error); });
    });
  }

 private:
  static hw_status_t deactivated(const hw_plugin_t& raw, hw_status_t status) {
    if (status == HW_OK) marked("deactivate", [&] { raw.vtable->deactivate(raw.self); });
    return status;
  }

  LoadedLibrary library_;
  TestHost host_;
  Instance plugin_;
};

void gives_good_reasons(const Subject& subject) {
  Failures(subject).each([](const char* name, const Attempt& attempt) {
    hw_error_t error = host::empty_error();
    std::memset(error.message + 1, 'x',
                sizeof error.message - 1);  // only what the plugin writes ends the text
    const hw_status_t status = attempt(&error);
    if (status == HW_OK) return;
    const std::string what = std::string("the reason of ") + name + "()";
    demand(error.message[0] != '\0', what + " is empty");
    demand(std::memchr(error.message, 0, sizeof error.message) != nullptr, what + " does not end with 0");
    demand_text(error.message, what);
    demand(error.message[std::strlen(error.message) - 1] != '\n', what + " ends with a line end");
    demand(error.status == status, what + " carries " + hw_status_name(error.status) +
                                       ", the call returned " + hw_status_name(status));
  });
}

void needs_no_error(const Subject& subject) {
  Failures(subject).each([](const char*, const Attempt& attempt) { attempt(nullptr); });
  Instance plugin(subject);
  plugin.give_no_errors();
  plugin.activate();
  plugin.walk(0, 3);
  plugin.must_reset();
  plugin.walk(3, 4);
}

void takes_a_larger_error(const Subject& subject) {
  struct Grown {
    hw_error_t error;
    unsigned char more[48];
  };
  Failures(subject).each([](const char* name, const Attempt& attempt) {
    Grown grown{.error = host::empty_error(), .more = {}};
    std::memset(grown.more, 0x5a, sizeof grown.more);
    grown.error.size = sizeof grown;
    if (attempt(&grown.error) == HW_OK) return;
    const std::string what = std::string(name) + "() with a larger hw_error_t";
    demand(grown.error.message[0] != '\0', what + " gave no reason");
    for (const unsigned char byte : grown.more) {
      demand(byte == 0x5a, what + " wrote behind the members that it knows");
    }
  });
}

constexpr Test kErrorTests[] = {
    {"errors-reasons",
     "A failure fills hw_error_t with the status that is returned and a reason: UTF-8, ended by 0, no line "
     "end behind it.",
     gives_good_reasons},
    {"errors-null", "A caller may pass null instead of an hw_error_t.", needs_no_error},
    {"grown-error", "An hw_error_t of a later version, which is larger, is filled as today's.",
     takes_a_larger_error},
};

}  // namespace

std::span<const Test> error_tests() {
  return kErrorTests;
}

}  // namespace hallway::conformance
