// SPDX-License-Identifier: MIT
#include "host/load/library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <set>
#include <string>

#include "base/error.hpp"
#include "base/text.hpp"
#include "host/load/error_text.hpp"
#include "host/load/load_step.hpp"
#include "host/machine/elf.hpp"

namespace hallway::host {
namespace {

constexpr std::uint32_t kMaxPlugins = 1000;

[[noreturn]] void fail(const std::string& message) {
  throw Error(ErrorCode::kPluginLoad, message);
}

/// Calls into the library and takes an exception that it lets escape for its fault.
template <typename Call>
auto guarded(const char* name, Call&& call) {
  try {
    return call();
  } catch (...) {
    fail(fmt::format("let a C++ exception escape from {}()", name));
  }
}

void* open_library(const std::filesystem::path& file) {
  enter(LoadStep::kLoad);
  // An absolute path: a bare name would be looked for in the system's folders.
  if (void* handle = ::dlopen(std::filesystem::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL)) return handle;
  const char* reason = ::dlerror();
  const std::string text = printable(reason != nullptr ? reason : "the loader gives no reason", 1000);
  const bool missing = text.find("cannot open shared object file") != std::string::npos;
  fail((missing ? "needs a library that is missing: " : "cannot be loaded: ") + text);
}

const hw_entry_t& find_entry(void* handle) {
  const void* symbol = ::dlsym(handle, HW_ENTRY_SYMBOL);
  if (symbol == nullptr) fail("has no entry symbol hw_entry: it is not a Hallway plugin");
  const auto& entry = *static_cast<const hw_entry_t*>(symbol);
  if (entry.abi.abi_major != HW_ABI_MAJOR) {
    fail(fmt::format("was built for version {}.{} of the plugin ABI, this program speaks version {}.x",
                     entry.abi.abi_major, entry.abi.abi_minor, HW_ABI_MAJOR));
  }
  if (!entry.init || !entry.deinit || !entry.get_factory) fail("has null functions in its entry");
  return entry;
}

/// The factory of that id, null where the library has none.
template <typename Factory>
const Factory* find_factory(const hw_entry_t& entry, const char* id) {
  const void* found = guarded("get_factory", [&] { return entry.get_factory(id); });
  const auto* factory = static_cast<const Factory*>(found);
  if (factory != nullptr && (!factory->count || !factory->describe || !factory->create)) {
    fail("has null functions in its factory");
  }
  return factory;
}

/// What a factory makes.
/// @param noun  "plugin" or "driver"
template <typename Factory, typename Read>
auto describe_all(const Factory* factory, const char* noun, Read read) {
  std::vector<decltype(read(nullptr))> infos;
  if (factory == nullptr) return infos;
  const std::uint32_t count = guarded("count", [&] { return factory->count(); });
  if (count > kMaxPlugins) {
    fail(fmt::format("says that it holds {} {}s, more than {}", count, noun, kMaxPlugins));
  }
  std::set<std::string> ids;
  for (std::uint32_t i = 0; i < count; ++i) {
    infos.push_back(read(guarded("describe", [&] { return factory->describe(i); })));
    if (!ids.insert(infos.back().id).second) {
      fail(fmt::format("has two {}s of the id `{}`", noun, infos.back().id));
    }
  }
  return infos;
}

/// Makes the plugin or driver of that id. Throws Error{kPluginLoad}.
template <typename Made, typename Factory>
Made make(const Factory* factory, const std::string& id, const hw_host_t& host) {
  Made made{};
  hw_error_t error = empty_error();
  const hw_status_t status =
      guarded("create", [&] { return factory->create(&host, id.c_str(), &made, &error); });
  if (status != HW_OK) fail("its create() failed: " + error_text(error, status));
  return made;
}

/// Calls `work` and says in what it throws which part of which file is meant.
template <typename Work>
auto located(const std::filesystem::path& file, const std::string& element, Work&& work) {
  try {
    return work();
  } catch (const Error& failure) {
    throw Error(failure.code(), failure.message(), {file.string(), 0, element});
  }
}

}  // namespace

/// What is shared by all Library objects of one loaded file.
struct Library::Loaded {
  explicit Loaded(const std::filesystem::path& file) : handle(open_library(file)) {
    try {
      entry = &find_entry(handle);
      start(file);
    } catch (...) {
      ::dlclose(handle);
      throw;
    }
  }
  ~Loaded() {
    stop();
    ::dlclose(handle);
  }
  Loaded(const Loaded&) = delete;
  Loaded& operator=(const Loaded&) = delete;

  void start(const std::filesystem::path& file) {
    enter(LoadStep::kInit);
    hw_error_t error = empty_error();
    const hw_status_t status = guarded("init", [&] { return entry->init(file.c_str(), &error); });
    if (status != HW_OK) fail("its init() failed: " + error_text(error, status));
    try {
      enter(LoadStep::kDescribe);
      factory = find_factory<hw_plugin_factory_t>(*entry, HW_PLUGIN_FACTORY_ID);
      find_driver_factory();
      if (!factory && !driver_factory) {
        fail("has no factory " HW_PLUGIN_FACTORY_ID " and no " HW_DRIVER_FACTORY_ID);
      }
      plugins = describe_all(factory, "plugin", read_plugin_info);
      drivers = describe_all(driver_factory, "driver", read_driver_info);
    } catch (...) {
      stop();
      throw;
    }
  }

  /// A library that gives its one factory for every id has plugins, and no drivers.
  void find_driver_factory() {
    const void* found = guarded("get_factory", [&] { return entry->get_factory(HW_DRIVER_FACTORY_ID); });
    if (found == nullptr || found == factory) return;
    driver_factory = find_factory<hw_driver_factory_t>(*entry, HW_DRIVER_FACTORY_ID);
  }

  void stop() noexcept {
    try {
      entry->deinit();
    } catch (...) {  // the library goes away in any case, and there is nobody left to tell
    }
  }

  void* handle;
  const hw_entry_t* entry = nullptr;
  const hw_plugin_factory_t* factory = nullptr;
  const hw_driver_factory_t* driver_factory = nullptr;
  std::vector<PluginInfo> plugins;
  std::vector<DriverInfo> drivers;
  std::size_t users = 0;
};

/// The libraries that are loaded, by the loader's handle: a file that is loaded twice is initialised once.
struct Library::Registry {
  static std::map<void*, std::unique_ptr<Loaded>>& all() {
    static std::map<void*, std::unique_ptr<Loaded>> libraries;
    return libraries;
  }

  static Loaded* acquire(const std::filesystem::path& file) {
    if (void* handle =
            ::dlopen(std::filesystem::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NOLOAD)) {
      ::dlclose(handle);  // the Loaded holds a count of its own
      const auto known = all().find(handle);
      if (known != all().end()) return use(*known->second);
    }
    auto loaded = std::make_unique<Loaded>(file);
    return use(*(all()[loaded->handle] = std::move(loaded)));
  }

  static Loaded* use(Loaded& loaded) {
    ++loaded.users;
    return &loaded;
  }

  static void release(Loaded* loaded) {
    if (--loaded->users == 0) all().erase(loaded->handle);
  }
};

std::shared_ptr<const Library> Library::load(const std::filesystem::path& file) {
  check_library_file(file);
  try {
    return std::shared_ptr<const Library>(new Library(file, Registry::acquire(file)));
  } catch (const Error& error) {
    throw Error(error.code(), error.message(), {file.string()});
  }
}

Library::Library(std::filesystem::path file, Loaded* loaded) : file_(std::move(file)), loaded_(loaded) {}

Library::~Library() {
  Registry::release(loaded_);
}

hw_version_t Library::abi() const {
  return loaded_->entry->abi;
}

const std::vector<PluginInfo>& Library::plugins() const {
  return loaded_->plugins;
}

const PluginInfo* Library::find(std::string_view id) const {
  const auto found = std::ranges::find_if(plugins(), [&](const PluginInfo& p) { return p.id == id; });
  return found == plugins().end() ? nullptr : &*found;
}

const std::vector<DriverInfo>& Library::drivers() const {
  return loaded_->drivers;
}

hw_plugin_t Library::create(const PluginInfo& info, const hw_host_t& host) const {
  enter(LoadStep::kCreate);
  return located(file_, fmt::format("plugin `{}`", info.id), [&] {
    const auto plugin = make<hw_plugin_t>(loaded_->factory, info.id, host);
    const hw_plugin_vtable_t* v = plugin.vtable;
    if (!v || !v->activate || !v->deactivate || !v->reset || !v->process || !v->report || !v->get_extension ||
        !v->destroy) {
      fail("has null functions in its vtable");
    }
    return plugin;
  });
}

hw_driver_t Library::create(const DriverInfo& info, const hw_host_t& host) const {
  return located(file_, fmt::format("driver `{}`", info.id), [&] {
    const auto driver = make<hw_driver_t>(loaded_->driver_factory, info.id, host);
    const hw_driver_vtable_t* v = driver.vtable;
    if (!v || !v->open || !v->describe || !v->read || !v->write || !v->counters || !v->get_extension ||
        !v->close || !v->destroy) {
      fail("has null functions in its vtable");
    }
    return driver;
  });
}

}  // namespace hallway::host
