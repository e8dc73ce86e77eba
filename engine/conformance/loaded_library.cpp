// SPDX-License-Identifier: MIT
#include "conformance/loaded_library.hpp"

#include <dlfcn.h>

#include <utility>

#include "base/text.hpp"
#include "conformance/call_mark.hpp"
#include "host/load/error_text.hpp"

namespace hallway::conformance {

LoadedLibrary::LoadedLibrary(const std::filesystem::path& file) {
  const std::string path = std::filesystem::absolute(file).string();
  handle_ = marked("dlopen", [&] { return ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL); });
  if (handle_ == nullptr) {
    const char* reason = ::dlerror();
    throw NotLoadable("cannot be loaded: " + printable(reason != nullptr ? reason : "", 1000));
  }
  try {
    start(path);
  } catch (...) {
    ::dlclose(handle_);
    throw;
  }
}

void LoadedLibrary::start(const std::filesystem::path& file) {
  entry_ = static_cast<const hw_entry_t*>(::dlsym(handle_, HW_ENTRY_SYMBOL));
  if (entry_ == nullptr) throw NotLoadable("has no entry symbol " HW_ENTRY_SYMBOL);
  if (!entry_->init || !entry_->deinit || !entry_->get_factory)
    throw NotLoadable("has null functions in its entry");
  hw_error_t error = host::empty_error();
  const hw_status_t status = marked("init", [&] { return entry_->init(file.c_str(), &error); });
  if (status != HW_OK) throw NotLoadable("its init() failed: " + host::error_text(error, status));
  factory_ = static_cast<const hw_plugin_factory_t*>(
      marked("get_factory", [&] { return entry_->get_factory(HW_PLUGIN_FACTORY_ID); }));
  const bool whole = factory_ && factory_->count && factory_->describe && factory_->create;
  if (whole) return;
  marked("deinit", [&] { entry_->deinit(); });
  throw NotLoadable(factory_ ? "has null functions in its factory" : "has no factory " HW_PLUGIN_FACTORY_ID);
}

LoadedLibrary::~LoadedLibrary() {
  try {
    unload();
  } catch (...) {  // a test that was to notice has called unload() itself
  }
}

void LoadedLibrary::unload() {
  void* handle = std::exchange(handle_, nullptr);
  if (handle == nullptr) return;
  marked("deinit", [&] { entry_->deinit(); });
  marked("dlclose", [&] { ::dlclose(handle); });
}

const hw_plugin_info_t& LoadedLibrary::info(const std::string& id) const {
  const std::uint32_t count = marked("count", [&] { return factory_->count(); });
  for (std::uint32_t i = 0; i < count; ++i) {
    const hw_plugin_info_t* info = marked("describe", [&] { return factory_->describe(i); });
    if (info == nullptr || !HW_HAS(info, hw_plugin_info_t, n_outputs) || info->id == nullptr) continue;
    if (id.empty() || id == info->id) return *info;
  }
  throw NotLoadable(id.empty() ? "describes no plugin" : "holds no plugin `" + printable(id) + "`");
}

std::vector<std::uint32_t> inputs_of(const hw_plugin_info_t& info) {
  std::vector<std::uint32_t> kinds;
  if (info.inputs != nullptr) kinds.assign(info.inputs, info.inputs + info.n_inputs);
  if (HW_HAS(&info, hw_plugin_info_t, n_optional_inputs) && info.optional_inputs != nullptr)
    kinds.insert(kinds.end(), info.optional_inputs, info.optional_inputs + info.n_optional_inputs);
  return kinds;
}

std::vector<std::uint32_t> outputs_of(const hw_plugin_info_t& info) {
  if (info.outputs == nullptr) return {};
  return {info.outputs, info.outputs + info.n_outputs};
}

}  // namespace hallway::conformance
