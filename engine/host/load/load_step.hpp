// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>

namespace hallway::host {

/// The steps of loading a plugin in which code of its library runs, in their order.
enum class LoadStep : std::uint32_t {
  kLoad = 0,    ///< the file is opened: constructors of static objects
  kInit,        ///< hw_entry_t.init()
  kDescribe,    ///< hw_entry_t.get_factory(), and what the factory says of its plugins
  kCreate,      ///< hw_plugin_factory_t.create()
  kParameters,  ///< what the new plugin says of its parameters
};

/// Its name in messages and verdicts: "load", "init", "describe", "create", "parameters". Of a number that is none of them "load".
const char* load_step_name(std::uint32_t step);

/// From now on this thread notes each step in `word` before it takes it, so that another process can say where this one ended. Null: nowhere.
void note_load_steps_in(std::atomic<std::uint32_t>* word);

/// Notes a step, where this thread notes them.
void enter(LoadStep step);

}  // namespace hallway::host
