// SPDX-License-Identifier: MIT
#include "mesh/protocol.hpp"

#include <bit>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "base/text.hpp"

namespace hallway::mesh {
namespace {

static_assert(std::endian::native == std::endian::little, "messages are written in the machine's byte order");
static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Triangle) == 4 * sizeof(std::uint32_t));

constexpr std::string_view kRequestMark = "HWMREQ01";
constexpr std::string_view kModelMark = "HWMMOD01";
constexpr std::string_view kFailureMark = "HWMERR01";
constexpr std::string_view kEndMark = "HWMEND01";
constexpr std::uint32_t kNoImage = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint64_t kMaxPathBytes = 65'536;

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ErrorCode::kBadInput, "the mesh loader gave a reply that cannot be read: " + message);
}

/// Appends numbers and texts to a message.
class Writer {
 public:
  template <typename T>
  void number(T value) {
    static_assert(std::is_arithmetic_v<T>);
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    text_.append(bytes, sizeof(T));
  }
  void raw(std::string_view bytes) { text_.append(bytes); }
  void text(std::string_view bytes) {
    number<std::uint64_t>(bytes.size());
    raw(bytes);
  }
  /// Gives what was appended, and starts again with nothing.
  std::string take() { return std::exchange(text_, {}); }

 private:
  std::string text_;
};

/// Takes numbers, texts and arrays off a message. Nothing is allocated before it is known that the message holds it.
class Reader {
 public:
  explicit Reader(std::string_view rest) : rest_(rest) {}

  bool accept(std::string_view mark) {
    if (!rest_.starts_with(mark)) return false;
    rest_.remove_prefix(mark.size());
    return true;
  }
  std::string_view raw(std::uint64_t bytes) {
    if (bytes > rest_.size()) refuse("it is cut short");
    const std::string_view taken = rest_.substr(0, static_cast<std::size_t>(bytes));
    rest_.remove_prefix(taken.size());
    return taken;
  }
  template <typename T>
  T number() {
    T value{};
    std::memcpy(&value, raw(sizeof(T)).data(), sizeof(T));
    return value;
  }
  /// A count of items that take at least `least_bytes` each.
  std::size_t count(std::uint64_t most, std::uint64_t least_bytes, const char* what) {
    const auto value = number<std::uint64_t>();
    if (value > most) refuse(std::to_string(value) + " " + what + "; the limit is " + std::to_string(most));
    if (value > rest_.size() / least_bytes) refuse("it is cut short");
    return static_cast<std::size_t>(value);
  }
  std::string text(std::uint64_t most) { return std::string(raw(count(most, 1, "bytes of text"))); }
  template <typename T>
  void array(std::vector<T>& out, std::uint64_t most, const char* what) {
    const std::size_t items = count(most, sizeof(T), what);
    const std::string_view bytes = raw(items * sizeof(T));
    out.resize(items);
    // The types are plain numbers without gaps; Eigen's vectors only lack the trivial constructor.
    if (items != 0) std::memcpy(static_cast<void*>(out.data()), bytes.data(), bytes.size());
  }
  bool at_end() const { return rest_.empty(); }

 private:
  std::string_view rest_;
};

template <typename T>
std::string_view bytes_of(const std::vector<T>& items) {
  return {reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T)};
}

template <typename T>
void send_array(Writer& writer, const std::vector<T>& items, const ByteSink& sink) {
  writer.number<std::uint64_t>(items.size());
  sink(writer.take());
  sink(bytes_of(items));
}

void write_texts(Writer& writer, const std::vector<std::string>& texts) {
  writer.number<std::uint64_t>(texts.size());
  for (const std::string& text : texts) writer.text(text);
}

void read_texts(Reader& reader, std::vector<std::string>& out) {
  const std::size_t items = reader.count(kMaxNotes, sizeof(std::uint64_t), "texts");
  for (std::size_t i = 0; i < items; ++i) out.push_back(reader.text(kMaxNameBytes));
}

void read_materials(Reader& reader, const ModelLimits& limits, std::vector<Material>& out) {
  constexpr std::uint64_t kLeast = sizeof(std::uint64_t) + 4 * sizeof(float) + sizeof(std::uint32_t);
  const std::size_t items = reader.count(limits.materials, kLeast, "materials");
  out.reserve(items);
  for (std::size_t i = 0; i < items; ++i) {
    Material material;
    material.name = printable(reader.text(kMaxNameBytes), kMaxNameBytes);
    for (float& channel : material.base_colour) channel = reader.number<float>();
    const auto image = reader.number<std::uint32_t>();
    if (image != kNoImage) material.image = image;
    out.push_back(std::move(material));
  }
}

void read_images(Reader& reader, const ModelLimits& limits, std::vector<Image>& out) {
  constexpr std::uint64_t kLeast = 2 * sizeof(std::uint64_t) + 2 * sizeof(std::uint32_t);
  const std::size_t items = reader.count(limits.images, kLeast, "images");
  std::uint64_t left = limits.image_bytes;
  for (std::size_t i = 0; i < items; ++i) {
    Image image;
    image.name = printable(reader.text(kMaxNameBytes), kMaxNameBytes);
    image.width = reader.number<std::uint32_t>();
    image.height = reader.number<std::uint32_t>();
    reader.array(image.rgba, left, "bytes of images");
    left -= image.rgba.size();
    out.push_back(std::move(image));
  }
}

[[noreturn]] void rethrow_failure(Reader& reader) {
  const auto code = reader.number<std::uint32_t>();
  const std::string message = reader.text(kMaxPathBytes);
  const std::string file = reader.text(kMaxPathBytes);
  const std::string element = reader.text(kMaxPathBytes);
  if (!reader.accept(kEndMark) || !reader.at_end()) refuse("it does not end where it should");
  const bool about_files = code == static_cast<std::uint32_t>(ErrorCode::kIo);
  throw Error(about_files ? ErrorCode::kIo : ErrorCode::kBadInput, printable(message, kMaxNameBytes),
              {.file = printable(file, kMaxNameBytes), .element = printable(element, kMaxNameBytes)});
}

}  // namespace

std::string encode_request(const LoadRequest& request) {
  Writer writer;
  writer.raw(kRequestMark);
  writer.text(request.file);
  writer.text(request.root);
  const ModelLimits& limits = request.limits;
  for (const std::uint64_t limit : {limits.triangles, limits.vertices, limits.materials, limits.images,
                                    limits.image_bytes, limits.file_bytes}) {
    writer.number(limit);
  }
  writer.raw(kEndMark);
  return writer.take();
}

LoadRequest decode_request(std::string_view message) {
  Reader reader(message);
  if (!reader.accept(kRequestMark)) refuse("no request");
  LoadRequest request;
  request.file = reader.text(kMaxPathBytes);
  request.root = reader.text(kMaxPathBytes);
  ModelLimits& limits = request.limits;
  for (std::uint64_t* limit : {&limits.triangles, &limits.vertices, &limits.materials, &limits.images,
                               &limits.image_bytes, &limits.file_bytes}) {
    *limit = reader.number<std::uint64_t>();
  }
  if (!reader.accept(kEndMark) || !reader.at_end()) refuse("it does not end where it should");
  return request;
}

void encode_model(const Model& model, const ByteSink& sink) {
  Writer writer;
  writer.raw(kModelMark);
  writer.number(model.metres_per_unit);
  send_array(writer, model.vertices, sink);
  send_array(writer, model.uv, sink);
  send_array(writer, model.triangles, sink);
  writer.number<std::uint64_t>(model.materials.size());
  for (const Material& material : model.materials) {
    writer.text(material.name);
    for (const float channel : material.base_colour) writer.number(channel);
    writer.number(material.image.value_or(kNoImage));
  }
  writer.number<std::uint64_t>(model.images.size());
  for (const Image& image : model.images) {
    writer.text(image.name);
    writer.number(image.width);
    writer.number(image.height);
    send_array(writer, image.rgba, sink);
  }
  write_texts(writer, model.files);
  write_texts(writer, model.warnings);
  writer.raw(kEndMark);
  sink(writer.take());
}

std::string encode_failure(const Error& failure) {
  Writer writer;
  writer.raw(kFailureMark);
  writer.number(static_cast<std::uint32_t>(failure.code()));
  writer.text(failure.message());
  writer.text(failure.where().file);
  writer.text(failure.where().element);
  writer.raw(kEndMark);
  return writer.take();
}

Model decode_reply(std::string_view message, const ModelLimits& limits) {
  Reader reader(message);
  if (reader.accept(kFailureMark)) rethrow_failure(reader);
  if (!reader.accept(kModelMark)) refuse("it does not begin as one");
  Model model;
  model.metres_per_unit = reader.number<double>();
  reader.array(model.vertices, limits.vertices, "vertices");
  reader.array(model.uv, limits.vertices, "texture coordinates");
  reader.array(model.triangles, limits.triangles, "triangles");
  read_materials(reader, limits, model.materials);
  read_images(reader, limits, model.images);
  read_texts(reader, model.files);
  read_texts(reader, model.warnings);
  for (std::string& warning : model.warnings) warning = printable(warning, kMaxNameBytes);
  if (!reader.accept(kEndMark) || !reader.at_end()) refuse("it does not end where it should");
  check_model(model, limits);
  return model;
}

}  // namespace hallway::mesh
