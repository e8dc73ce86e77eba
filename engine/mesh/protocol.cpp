// SPDX-License-Identifier: MIT
#include "mesh/protocol.hpp"

#include <array>
#include <cstring>
#include <limits>
#include <utility>

#include "base/bytes.hpp"
#include "base/text.hpp"

namespace hallway::mesh {
namespace {

static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Triangle) == 4 * sizeof(std::uint32_t) &&
              sizeof(ModelLimits) == 6 * sizeof(std::uint64_t));

constexpr std::string_view kRequestMark = "HWMREQ01";
constexpr std::string_view kModelMark = "HWMMOD01";
constexpr std::string_view kFailureMark = "HWMERR01";
constexpr std::string_view kEndMark = "HWMEND01";
constexpr std::uint32_t kNoImage = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint64_t kMaxPathBytes = 65'536;

[[noreturn]] void refuse(const std::string& message) {
  throw Error(ErrorCode::kBadInput, "the mesh loader gave a reply that cannot be read: " + message);
}

/// Reads a message, whatever is missing in it.
template <typename Read>
auto read_message(std::string_view message, Read&& read) {
  ByteReader reader(message);
  try {
    return read(reader);
  } catch (const BadBytes&) {
    refuse("it is cut short");
  }
}

void expect_end(ByteReader& reader) {
  if (!reader.accept(kEndMark) || !reader.at_end()) refuse("it does not end where it should");
}

/// A count of items that take at least `least_bytes` each. Nothing is allocated before it is known that the message holds it.
std::size_t read_count(ByteReader& reader, std::uint64_t most, std::size_t least_bytes, const char* what) {
  const auto count = reader.get<std::uint64_t>();
  if (count > most) refuse(std::to_string(count) + " " + what + "; the limit is " + std::to_string(most));
  reader.expect(count, least_bytes);
  return static_cast<std::size_t>(count);
}

std::string read_text(ByteReader& reader, std::uint64_t most) {
  return std::string(reader.take_raw(read_count(reader, most, 1, "bytes of text")));
}

std::string read_name(ByteReader& reader) {
  return printable(read_text(reader, kMaxNameBytes), kMaxNameBytes);
}

template <typename T>
void read_array(ByteReader& reader, std::vector<T>& out, std::uint64_t most, const char* what) {
  const std::size_t items = read_count(reader, most, sizeof(T), what);
  const std::string_view bytes = reader.take_raw(items * sizeof(T));
  out.resize(items);
  // The types are plain numbers without gaps; Eigen's vectors only lack the trivial constructor.
  if (items != 0) std::memcpy(static_cast<void*>(out.data()), bytes.data(), bytes.size());
}

void read_texts(ByteReader& reader, std::vector<std::string>& out) {
  out.resize(read_count(reader, kMaxNotes, sizeof(std::uint64_t), "texts"));
  for (std::string& text : out) text = read_text(reader, kMaxNameBytes);
}

/// A reply that is given to a sink in pieces.
class Reply {
 public:
  explicit Reply(const ByteSink& sink) : sink_(sink) {}

  ByteAppender& writer() { return writer_; }
  void put_count(std::size_t count) { writer_.put(std::uint64_t{count}); }
  /// Sends what was put so far, and then an array without a copy of it.
  template <typename T>
  void send_array(const std::vector<T>& items) {
    put_count(items.size());
    flush();
    sink_({reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T)});
  }
  void put_texts(const std::vector<std::string>& texts) {
    put_count(texts.size());
    for (const std::string& text : texts) writer_.put_text(text);
  }
  void flush() { sink_(std::exchange(text_, {})); }

 private:
  const ByteSink& sink_;
  std::string text_;
  ByteAppender writer_{text_};
};

void read_materials(ByteReader& reader, const ModelLimits& limits, std::vector<Material>& out) {
  constexpr std::uint64_t kLeast = sizeof(std::uint64_t) + 4 * sizeof(float) + sizeof(std::uint32_t);
  const std::size_t items = read_count(reader, limits.materials, kLeast, "materials");
  out.reserve(items);
  for (std::size_t i = 0; i < items; ++i) {
    Material material;
    material.name = read_name(reader);
    material.base_colour = reader.get<std::array<float, 4>>();
    const auto image = reader.get<std::uint32_t>();
    if (image != kNoImage) material.image = image;
    out.push_back(std::move(material));
  }
}

void read_images(ByteReader& reader, const ModelLimits& limits, std::vector<Image>& out) {
  constexpr std::uint64_t kLeast = 2 * sizeof(std::uint64_t) + 2 * sizeof(std::uint32_t);
  const std::size_t items = read_count(reader, limits.images, kLeast, "images");
  std::uint64_t left = limits.image_bytes;
  for (std::size_t i = 0; i < items; ++i) {
    Image image;
    image.name = read_name(reader);
    image.width = reader.get<std::uint32_t>();
    image.height = reader.get<std::uint32_t>();
    read_array(reader, image.rgba, left, "bytes of images");
    left -= image.rgba.size();
    out.push_back(std::move(image));
  }
}

[[noreturn]] void rethrow_failure(ByteReader& reader) {
  const auto code = reader.get<std::uint32_t>();
  const std::string message = read_text(reader, kMaxPathBytes);
  const std::string file = read_text(reader, kMaxPathBytes);
  const std::string element = read_text(reader, kMaxPathBytes);
  expect_end(reader);
  const bool about_files = code == static_cast<std::uint32_t>(ErrorCode::kIo);
  throw Error(about_files ? ErrorCode::kIo : ErrorCode::kBadInput, printable(message, kMaxNameBytes),
              {.file = printable(file, kMaxNameBytes), .element = printable(element, kMaxNameBytes)});
}

}  // namespace

std::string encode_request(const LoadRequest& request) {
  std::string message;
  ByteAppender writer(message);
  writer.put_raw(kRequestMark);
  writer.put_text(request.file);
  writer.put_text(request.root);
  writer.put(request.limits);
  writer.put_raw(kEndMark);
  return message;
}

LoadRequest decode_request(std::string_view message) {
  return read_message(message, [](ByteReader& reader) {
    if (!reader.accept(kRequestMark)) refuse("no request");
    LoadRequest request;
    request.file = read_text(reader, kMaxPathBytes);
    request.root = read_text(reader, kMaxPathBytes);
    request.limits = reader.get<ModelLimits>();
    expect_end(reader);
    return request;
  });
}

void encode_model(const Model& model, const ByteSink& sink) {
  Reply reply(sink);
  ByteAppender& writer = reply.writer();
  writer.put_raw(kModelMark);
  writer.put(model.metres_per_unit);
  reply.send_array(model.vertices);
  reply.send_array(model.uv);
  reply.send_array(model.triangles);
  reply.put_count(model.materials.size());
  for (const Material& material : model.materials) {
    writer.put_text(material.name);
    writer.put(material.base_colour);
    writer.put(material.image.value_or(kNoImage));
  }
  reply.put_count(model.images.size());
  for (const Image& image : model.images) {
    writer.put_text(image.name);
    writer.put(image.width);
    writer.put(image.height);
    reply.send_array(image.rgba);
  }
  reply.put_texts(model.files);
  reply.put_texts(model.warnings);
  writer.put_raw(kEndMark);
  reply.flush();
}

std::string encode_failure(const Error& failure) {
  std::string message;
  ByteAppender writer(message);
  writer.put_raw(kFailureMark);
  writer.put(static_cast<std::uint32_t>(failure.code()));
  writer.put_text(failure.message());
  writer.put_text(failure.where().file);
  writer.put_text(failure.where().element);
  writer.put_raw(kEndMark);
  return message;
}

Model decode_reply(std::string_view message, const ModelLimits& limits) {
  Model model = read_message(message, [&](ByteReader& reader) {
    if (reader.accept(kFailureMark)) rethrow_failure(reader);
    if (!reader.accept(kModelMark)) refuse("it does not begin as one");
    Model read;
    read.metres_per_unit = reader.get<double>();
    read_array(reader, read.vertices, limits.vertices, "vertices");
    read_array(reader, read.uv, limits.vertices, "texture coordinates");
    read_array(reader, read.triangles, limits.triangles, "triangles");
    read_materials(reader, limits, read.materials);
    read_images(reader, limits, read.images);
    read_texts(reader, read.files);
    read_texts(reader, read.warnings);
    expect_end(reader);
    return read;
  });
  for (std::string& warning : model.warnings) warning = printable(warning, kMaxNameBytes);
  check_model(model, limits);
  return model;
}

}  // namespace hallway::mesh
