// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/sample.h>

#include <cstddef>
#include <memory>
#include <vector>

#include "host/samples/payload.hpp"
#include "host/samples/sample_kind.hpp"

namespace hallway::host {

/// A sample of any kind that is made: the struct of its payload, and a list for each of its arrays, in memory that is used again for the next one of its
/// kind.
class Reading {
 public:
  /// @param kind  lives as long
  explicit Reading(const SampleKind& kind) : kind_(kind), lists_(kind.arrays.size()) {}

  /// Begins with a payload of zeros without elements, found in no other sample.
  void begin();
  /// Begins with a copy of a sample of this kind and of all that it refers to.
  void begin(const hw_sample_t& sample);

  const SampleKind& kind() const { return kind_; }
  hw_sample_t& sample() { return sample_; }
  /// The struct of the payload, for its members that no array has. T is what SampleKind::payload names.
  template <typename T>
  T& payload() {
    return *static_cast<T*>(static_cast<void*>(payload_.get()));
  }
  /// The list that becomes an array, empty at first; of a copy, what takes the place of the array. Where it stays empty, an optional array is null, and a copy
  /// keeps its own. Throws Error{kInternal} if the kind has no such array of elements of that size.
  /// @param data  PayloadArray::data
  template <typename T>
  std::vector<T>& list(std::size_t data) {
    std::unique_ptr<List>& kept = kept_list(data, sizeof(T));
    if (kept == nullptr) kept = std::make_unique<ListOf<T>>();
    return dynamic_cast<ListOf<T>&>(*kept).elements;
  }

  /// Has the payload refer to the lists. Throws Error{kInternal} for lists of one count that are not of one length.
  /// @return valid until the next begin()
  const hw_sample_t& finish();

 private:
  /// A list of elements of any type.
  struct List {
    virtual ~List() = default;
    virtual void clear() = 0;
    virtual std::size_t size() const = 0;
    virtual const void* data() const = 0;
  };
  template <typename T>
  struct ListOf final : List {
    void clear() override { elements.clear(); }
    std::size_t size() const override { return elements.size(); }
    const void* data() const override { return elements.data(); }
    std::vector<T> elements;
  };

  std::unique_ptr<List>& kept_list(std::size_t data, std::size_t element_bytes);
  void clear_lists();

  const SampleKind& kind_;
  hw_sample_t sample_{};
  Payload payload_;
  std::vector<std::unique_ptr<List>> lists_;  ///< by their place in SampleKind::arrays; null: never asked for
  bool is_copy_ = false;
};

}  // namespace hallway::host
