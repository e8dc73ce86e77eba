// SPDX-License-Identifier: MIT
#pragma once

#include "base/setting.hpp"

namespace hallway::sim {

using hallway::Override;
using hallway::Setting;

}  // namespace hallway::sim
