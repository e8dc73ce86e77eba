// SPDX-License-Identifier: MIT
#include "loaders/gltf_accessor.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>

#include "loaders/refuse.hpp"

namespace hallway::loaders::gltf {
namespace {

constexpr std::int64_t kByte = 5120;
constexpr std::int64_t kUnsignedByte = 5121;
constexpr std::int64_t kShort = 5122;
constexpr std::int64_t kUnsignedShort = 5123;
constexpr std::int64_t kUnsignedInt = 5125;
constexpr std::int64_t kFloat = 5126;

std::uint64_t component_bytes(std::int64_t type) {
  switch (type) {
    case kByte:
    case kUnsignedByte:
      return 1;
    case kShort:
    case kUnsignedShort:
      return 2;
    case kUnsignedInt:
    case kFloat:
      return 4;
    default:
      refuse("component type " + std::to_string(type) + " is none of glTF's");
  }
}

/// Elements in a buffer view, known to be inside it.
struct Elements {
  const char* first = nullptr;
  std::uint64_t stride = 0;
  std::uint64_t count = 0;

  const char* at(std::uint64_t index) const { return first + index * stride; }
};

/// @param view    bytes of the buffer view
/// @param stride  0: tightly packed
Elements elements_in(std::string_view view, std::uint64_t offset, std::uint64_t stride, std::uint64_t count,
                     std::uint64_t element_bytes) {
  const std::uint64_t step = stride == 0 ? element_bytes : stride;
  if (step < element_bytes) {
    refuse("stride " + std::to_string(step) + " is less than the " + std::to_string(element_bytes) +
           " bytes of an element");
  }
  if (count == 0) return {};
  // In this order nothing can overflow, whatever the numbers.
  const bool inside = offset <= view.size() && element_bytes <= view.size() - offset &&
                      (count - 1) <= (view.size() - offset - element_bytes) / step;
  if (!inside) {
    refuse("elements at offset " + std::to_string(offset) + " reach beyond the " +
           std::to_string(view.size()) + " bytes of their buffer view");
  }
  return {view.data() + offset, step, count};
}

/// @param view  bytes of the accessor's buffer view, which it has
Elements elements_of(const Document& document, const Accessor& accessor, std::string_view view,
                     std::uint64_t element_bytes) {
  return elements_in(view, accessor.offset, document.views[static_cast<std::size_t>(accessor.view)].stride,
                     accessor.count, element_bytes);
}

template <typename T>
T value_at(const char* bytes) {
  T value{};
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

template <typename T>
float scaled(const char* bytes, bool normalized) {
  const auto value = static_cast<float>(value_at<T>(bytes));
  if (!normalized) return value;
  return std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0F);
}

float component(const char* bytes, std::int64_t type, bool normalized) {
  switch (type) {
    case kByte:
      return scaled<std::int8_t>(bytes, normalized);
    case kUnsignedByte:
      return scaled<std::uint8_t>(bytes, normalized);
    case kShort:
      return scaled<std::int16_t>(bytes, normalized);
    case kUnsignedShort:
      return scaled<std::uint16_t>(bytes, normalized);
    case kUnsignedInt:
      return scaled<std::uint32_t>(bytes, normalized);
    default:
      return value_at<float>(bytes);
  }
}

std::uint32_t whole(const char* bytes, std::int64_t type) {
  switch (type) {
    case kUnsignedByte:
      return value_at<std::uint8_t>(bytes);
    case kUnsignedShort:
      return value_at<std::uint16_t>(bytes);
    case kUnsignedInt:
      return value_at<std::uint32_t>(bytes);
    default:
      refuse("indices of component type " + std::to_string(type) + " are no unsigned whole numbers");
  }
}

template <std::size_t N>
std::array<float, N> vector_at(const char* bytes, const Accessor& accessor, std::uint64_t step) {
  std::array<float, N> value{};
  for (std::size_t i = 0; i < N; ++i) {
    value[i] = component(bytes + i * step, accessor.component_type, accessor.normalized);
  }
  return value;
}

/// Runs `work`, naming the accessor in what it throws.
template <typename Work>
auto about(std::int64_t accessor, Work work) {
  try {
    return work();
  } catch (const Error& error) {
    throw Error(error.code(), error.message(), {.element = "accessor " + std::to_string(accessor)});
  }
}

std::uint64_t not_negative(std::int64_t value) {
  if (value < 0) refuse("a negative offset or count");
  return static_cast<std::uint64_t>(value);
}

}  // namespace

const Accessor& AccessorReader::find(std::int64_t accessor) const {
  if (accessor < 0 || static_cast<std::uint64_t>(accessor) >= document_.accessors.size())
    refuse("there is no accessor " + std::to_string(accessor));
  return document_.accessors[static_cast<std::size_t>(accessor)];
}

std::string_view AccessorReader::view_bytes(std::int64_t index) const {
  if (index < 0 || static_cast<std::uint64_t>(index) >= document_.views.size())
    refuse("there is no buffer view " + std::to_string(index));
  const BufferView& view = document_.views[static_cast<std::size_t>(index)];
  if (view.buffer < 0 || static_cast<std::uint64_t>(view.buffer) >= document_.buffers.size())
    refuse("buffer view " + std::to_string(index) + " names a buffer that is not there");
  const std::string_view buffer = document_.buffers[static_cast<std::size_t>(view.buffer)];
  if (view.offset > buffer.size() || view.length > buffer.size() - view.offset) {
    refuse("buffer view " + std::to_string(index) + " reaches beyond the " + std::to_string(buffer.size()) +
           " bytes of its buffer");
  }
  return buffer.substr(static_cast<std::size_t>(view.offset), static_cast<std::size_t>(view.length));
}

template <std::size_t N>
void AccessorReader::replace_sparse(const Accessor& accessor,
                                    std::vector<std::array<float, N>>& values) const {
  const Sparse& sparse = accessor.sparse;
  const std::uint64_t count = not_negative(sparse.count);
  const std::uint64_t step = component_bytes(accessor.component_type);
  const Elements places = elements_in(view_bytes(sparse.indices_view), not_negative(sparse.indices_offset), 0,
                                      count, component_bytes(sparse.indices_type));
  const Elements others =
      elements_in(view_bytes(sparse.values_view), not_negative(sparse.values_offset), 0, count, N * step);
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint32_t place = whole(places.at(i), sparse.indices_type);
    if (place >= values.size()) refuse("a sparse index is beyond its elements");
    values[place] = vector_at<N>(others.at(i), accessor, step);
  }
}

template <std::size_t N>
std::vector<std::array<float, N>> AccessorReader::vectors(std::int64_t index, std::uint64_t most) const {
  return about(index, [&] {
    const Accessor& accessor = find(index);
    if (accessor.components != static_cast<std::int64_t>(N))
      refuse("has " + std::to_string(accessor.components) + " numbers in an element where " +
             std::to_string(N) + " are needed");
    if (accessor.count > most)
      refuse(std::to_string(accessor.count) + " elements are over the limit of vertices");
    const std::uint64_t step = component_bytes(accessor.component_type);
    const Elements elements = accessor.view >= 0
                                  ? elements_of(document_, accessor, view_bytes(accessor.view), N * step)
                                  : Elements{};
    std::vector<std::array<float, N>> values(static_cast<std::size_t>(accessor.count));
    for (std::uint64_t i = 0; i < elements.count; ++i)
      values[i] = vector_at<N>(elements.at(i), accessor, step);
    if (accessor.is_sparse) replace_sparse<N>(accessor, values);
    return values;
  });
}

std::vector<std::array<float, 3>> AccessorReader::vectors3(std::int64_t accessor, std::uint64_t most) const {
  return vectors<3>(accessor, most);
}

std::vector<std::array<float, 2>> AccessorReader::vectors2(std::int64_t accessor, std::uint64_t most) const {
  return vectors<2>(accessor, most);
}

std::vector<std::uint32_t> AccessorReader::indices(std::int64_t index, std::uint64_t most) const {
  return about(index, [&] {
    const Accessor& accessor = find(index);
    if (accessor.components != 1) refuse("indices are not single numbers");
    if (accessor.is_sparse) refuse("sparse indices are not read");
    if (accessor.count > most)
      refuse(std::to_string(accessor.count) + " elements are over the limit of indices");
    const std::string_view bytes = view_bytes(accessor.view);
    const Elements elements =
        elements_of(document_, accessor, bytes, component_bytes(accessor.component_type));
    std::vector<std::uint32_t> values(static_cast<std::size_t>(accessor.count));
    for (std::uint64_t i = 0; i < elements.count; ++i)
      values[i] = whole(elements.at(i), accessor.component_type);
    return values;
  });
}

}  // namespace hallway::loaders::gltf
