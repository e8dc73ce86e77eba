// SPDX-License-Identifier: MIT
#pragma once

#include <hallway/sample.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace hallway::host {

// The table of sample kinds. Whatever carries frames (bytes, isolation, datagrams, logs) knows kinds by their rows alone: a new kind is its header in
// the SDK, a row here, and a sensor that makes it.

/// Of a member that a payload does not have.
inline constexpr std::size_t kNoMember = SIZE_MAX;

/// The minor version of the ABI that the bytes of every frame name at least; see frame_bytes.hpp.
inline constexpr std::uint32_t kFirstFrameMinor = 4;

/// PayloadMember::name of a member that is 0 and not read.
inline constexpr const char* kReserved = "reserved";

/// Of the numbers of a member.
enum class NumberType : std::uint8_t { kU32, kU64, kI64, kF32, kF64 };

/// How many bytes a number takes.
constexpr std::size_t number_bytes(NumberType type) {
  return type == NumberType::kU32 || type == NumberType::kF32 ? 4 : 8;
}

/// Numbers in a payload's struct, or in an element of one of its arrays, as sample_json.hpp shows them.
struct PayloadMember {
  /// In JSON; "": the element is this member alone, without a name. kReserved: a member that says nothing is not shown.
  const char* name;
  NumberType type;
  std::size_t offset;        ///< in the struct or the element, in bytes
  std::size_t n = 1;         ///< numbers that follow each other; more than one are a list
  std::size_t lists = 0;     ///< how many such lists follow each other, as a list of lists; 0: it is none
  bool may_be_none = false;  ///< of a whole number: all bits set say that there is none
};

/// An array that a payload points to. Members are told by their offsets in the payload's struct, in bytes.
struct PayloadArray {
  const char* name;   ///< in messages: "points"
  const char* one;    ///< an element of it: "point"
  std::size_t data;   ///< the pointer to the first element
  std::size_t count;  ///< u64, the number of elements
  std::size_t stride =
      kNoMember;  ///< u32, bytes from one element to the next, a multiple of 8; kNoMember: they are packed
  std::size_t element_bytes = 0;  ///< of an element, as these headers know it; packed ones are not larger
  std::size_t n_finite =
      0;  ///< with how many doubles an element begins that a sensor must give as finite numbers
  bool optional = false;  ///< null where the sample does not have it, whatever the count
  std::size_t size_without =
      0;  ///< of a payload without this array and those behind it: its struct ends here; 0: as with it
  bool checked = false;  ///< SampleKind::check looks at the elements: a reader copies them before
  std::span<const PayloadMember> members{};    ///< of an element: all of it, in the order of its bytes
  std::uint32_t abi_minor = kFirstFrameMinor;  ///< of the ABI that brought it
};

class Payload;

/// What a check is told of the sample whose payload it gets.
struct CheckedSample {
  std::uint64_t found_in_elements = 0;  ///< of the sample that it was found in
  std::uint64_t duration_ns = 0;        ///< from its begin to its end
};

/// Which example of a kind is made.
struct ExampleOf {
  std::uint64_t elements;  ///< how many
  std::uint64_t seed;      ///< of what is random
  std::uint64_t step;      ///< counts the readings of a robot that moves slowly, from 0
};

/// A row of the table.
struct SampleKind {
  std::uint32_t kind;   ///< HW_SAMPLE_…
  const char* name;     ///< in messages and files: "points"
  const char* payload;  ///< "hw_points_t"
  std::size_t
      size;  ///< of the payload's struct as these headers know it; its first member is its own `size`, u32
  std::size_t min_size;  ///< in the version that brought it
  /// In the order of their bytes; the first one are the sample's elements. None: a reading is one set of numbers and has no elements.
  std::span<const PayloadArray> arrays{};
  /// u32, the index in the frame of the sample that this one was found in, or HW_NO_SAMPLE; kNoMember: it is of no other sample.
  std::size_t found_in = kNoMember;
  /// The array of the sensor's own numbers for what it follows, a u64 for each element (its PayloadArray::data); kNoMember: no sensor follows elements.
  std::size_t track = kNoMember;
  /// What the ABI demands of the values. Gets a payload in the caller's own memory, the arrays that are `checked` among them, and may bring what
  /// says nothing into one form. Throws Malformed. Null: it demands nothing.
  void (*check)(void* payload, const CheckedSample& sample) = nullptr;
  /// Takes out of such a payload what refers to elements of the sample that it was found in. Not null where found_in is a member.
  void (*detach)(void* payload) = nullptr;
  /// None of its samples may be missed: those of a frame that a host drops go into the next frame (carried_samples.hpp). Not with found_in.
  bool carried = false;
  /// Of the struct: all but its own size and what belongs to arrays, in the order of its bytes.
  std::span<const PayloadMember> members{};
  /// Fills the arrays of a payload that make_example() (example.hpp) has begun, so that `check` accepts it. Null: any small numbers are valid.
  void (*example)(Payload& payload, const ExampleOf& of) = nullptr;
  std::int64_t example_ns = 0;                 ///< how long the measurement of such an example takes
  std::uint32_t abi_minor = kFirstFrameMinor;  ///< of the ABI that brought it
};

/// The rows of the kinds that the SDK has.
extern const SampleKind kPointSamples;
extern const SampleKind kPlaneSamples;
extern const SampleKind kBumpSamples;
extern const SampleKind kEncoderSamples;
extern const SampleKind kRangeScanSamples;
extern const SampleKind kOdometrySamples;
extern const SampleKind kImuSamples;
extern const SampleKind kGnssSamples;
extern const SampleKind kMagneticSamples;

/// The row of a kind; null for one that is not known.
const SampleKind* find_sample_kind(std::uint32_t kind);
/// The row of the kind of that name; null if there is none.
const SampleKind* find_sample_kind(std::string_view name);
/// All rows.
std::span<const SampleKind* const> sample_kinds();

/// Adds a row for as long as the program runs, for tests: a variable of a program's own file, made before main().
class AddedSampleKind {
 public:
  /// @param kind  lives as long; of a number and a name that no other row has
  explicit AddedSampleKind(const SampleKind& kind);
};

/// A stable name ("points", "planes", …), also of numbers that are reserved; of others "kind N".
std::string sample_kind_name(std::uint32_t kind);

/// How many elements a sample has, 0 of a kind that has none; nothing for kinds that are not known.
std::optional<std::uint64_t> count_elements(const hw_sample_t& sample);

/// Whether a sensor says of elements which they were in earlier samples: HW_SAMPLE_TRACKED is set and the array is there.
bool is_tracked(const hw_sample_t& sample);

/// What a sensor gave that is no finite number: "a point that is not finite"; empty if nothing. The sample is as frame_bytes.hpp demands. O(elements).
std::string find_not_finite(const hw_sample_t& sample);

}  // namespace hallway::host
