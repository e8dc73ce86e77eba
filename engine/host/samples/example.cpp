// SPDX-License-Identifier: MIT
#include "host/samples/example.hpp"

#include <hallway/planes.h>

#include "base/random.hpp"

namespace hallway::host {
namespace {

/// Arrays of any small numbers.
void fill_arrays(Payload& payload, const ExampleOf& of) {
  const SampleKind& kind = payload.kind();
  const Random random(of.seed, stream_id(kind.name));
  std::uint64_t drawn = 0;
  for (std::size_t i = 0; i < kind.arrays.size(); ++i) {
    const PayloadArray& array = kind.arrays[i];
    if (array.optional && of.step % 2 == 0) continue;
    std::byte* element = payload.make_array(i, of.elements);
    for (std::uint64_t k = 0; k < of.elements; ++k, element += array.element_bytes) {
      for (std::size_t d = 0; d < array.n_finite; ++d)
        store(element + d * sizeof(double), random.uniform(static_cast<std::uint32_t>(of.step), drawn++));
    }
  }
}

}  // namespace

void make_example(Payload& payload, const SampleKind& kind, const ExampleOf& of) {
  store(payload.begin(kind), static_cast<std::uint32_t>(kind.size));
  if (kind.found_in != kNoMember) store(payload.get() + kind.found_in, HW_NO_SAMPLE);
  (kind.example != nullptr ? kind.example : &fill_arrays)(payload, of);
}

}  // namespace hallway::host
