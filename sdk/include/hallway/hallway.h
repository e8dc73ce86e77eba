// SPDX-License-Identifier: MIT
#pragma once

// The whole C ABI of Hallway's plugins. Each header holds one concept and can be included alone.
//
// Threads. The comment of every function ends with one tag:
//   [main]        called on one thread, the one that loaded the library; never at the same time as a [loop]
//   function [loop]        called on one thread at a time for one plugin, not always the same one
//   [background]  called on a thread of its own, at the same time as anything but [main]
//   [any]         may be called on any thread, at any time
//
// Ownership. What a call is given lives until the call returns; what a host is given it copies before it
// returns; nothing is freed on the other side of the border.

#include "body.h"
#include "bump.h"
#include "drawing.h"
#include "drive.h"
#include "driver.h"
#include "encoder.h"
#include "entry.h"
#include "ext/log.h"
#include "ext/params.h"
#include "factory.h"
#include "gnss.h"
#include "growth.h"
#include "host.h"
#include "imu.h"
#include "magnetic.h"
#include "mapped_planes.h"
#include "odometry.h"
#include "output.h"
#include "planes.h"
#include "plugin.h"
#include "pose.h"
#include "range_scan.h"
#include "robot.h"
#include "sample.h"
#include "status.h"
#include "topology.h"
#include "version.h"
