// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace hallway::import {

/// A number as binary files have it.
enum class Scalar { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kInt64, kUint64, kFloat32, kFloat64 };

enum class ByteOrder { kLittle, kBig };

/// Bytes of such a number.
std::size_t size_of(Scalar type);

/// The number at `bytes`, which has size_of(type) of them at any address.
double read_scalar(const char* bytes, Scalar type, ByteOrder order);

}  // namespace hallway::import
