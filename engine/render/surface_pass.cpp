// SPDX-License-Identifier: MIT
#include "render/surface_pass.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <string>

#include "base/error.hpp"
#include "render/gl_context.hpp"
#include "render/gl_functions.hpp"

namespace hallway::render {
namespace {

/// Side of the square that is drawn at once, in samples: bounds the memory of the multisampled buffers (48 MB).
constexpr int kTileSide = 1024;
constexpr int kMultisamples = 4;

struct Vertex {
  std::array<float, 3> camera;  // right, down, forward, metres
  std::array<float, 3> normal;  // world
  std::array<float, 3> colour;
  std::array<float, 2> uv;  // on the texture
  float below_cut;          // metres below the cut
};

const char* const kVertexShader = R"(#version 330 core
layout(location = 0) in vec3 camera;
layout(location = 1) in vec3 normal_in;
layout(location = 2) in vec3 colour_in;
layout(location = 3) in vec2 uv_in;
layout(location = 4) in float below_cut;
uniform vec4 scale_shift;  // metres (perspective: slopes) to the tile's [-1, 1]
uniform vec4 depth;        // clip z = x * forward + y; clip w = z * forward + w
flat out vec3 normal;
flat out vec3 colour;
out vec2 uv;
void main() {
  float w = depth.z * camera.z + depth.w;
  gl_Position = vec4(scale_shift.xy * camera.xy + scale_shift.zw * w, depth.x * camera.z + depth.y, w);
  gl_ClipDistance[0] = below_cut;
  normal = normal_in;
  colour = colour_in;
  uv = uv_in;
}
)";

const char* const kFragmentShader = R"(#version 330 core
flat in vec3 normal;
flat in vec3 colour;
in vec2 uv;
uniform sampler2D image;
uniform float cut;  // 1 for the section of cut solids, which is not lit
layout(location = 0) out vec4 colour_out;
layout(location = 1) out vec4 normal_out;
const vec3 kSun = vec3(0.45, -0.58, 0.68);
const vec3 kFill = vec3(-0.90, 0.25, 0.36);
void main() {
  vec4 texel = texture(image, uv);
  if (texel.a < 0.5) discard;
  float sky = 0.5 + 0.5 * normal.z;
  float light = 0.69 + 0.09 * sky + 0.24 * max(dot(normal, kSun), 0.0) + 0.05 * max(dot(normal, kFill), 0.0);
  colour_out = vec4(colour * texel.rgb * mix(light, 1.0, cut), 1.0);
  normal_out = vec4(0.5 * normal + 0.5, 1.0 - 0.5 * cut);
}
)";

[[noreturn]] void fail(const std::string& cause) {
  throw Error(ErrorCode::kIo, "no picture can be drawn: " + cause);
}

std::array<float, 3> unit_colour(Rgb c) {
  return {static_cast<float>(c.r) / 255.0f, static_cast<float>(c.g) / 255.0f,
          static_cast<float>(c.b) / 255.0f};
}

std::array<float, 3> to_float(const Vec3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

bool drawable_polygon(const Polygon& polygon) {
  return polygon.vertices.size() >= 3 && polygon.plane.normal.allFinite() &&
         std::all_of(polygon.vertices.begin(), polygon.vertices.end(), drawable);
}

/// The normal that a face is lit by: of a sheet, that of the side that is seen.
Vec3 lit_normal(const Surface& surface, const Camera& camera) {
  const Vec3& normal = surface.polygon.plane.normal;
  if (surface.kind != SurfaceKind::kSheet) return normal;
  const Vec3 view = camera.kind() == ViewKind::kTop ? Vec3(camera.axes().row(2))
                                                    : Vec3(surface.polygon.vertices[0] - camera.eye());
  return normal.dot(view) > 0.0 ? Vec3(-normal) : normal;
}

bool textured(const Surface& surface) {
  if (!surface.texture || surface.uv.size() != surface.polygon.vertices.size()) return false;
  return std::all_of(surface.uv.begin(), surface.uv.end(), [](const std::array<float, 2>& uv) {
    return std::isfinite(uv[0]) && std::isfinite(uv[1]);
  });
}

/// The textures of a drawing, each once, in the order of their first use. Number 0 is white, for faces without one.
class TextureTable {
 public:
  explicit TextureTable(const std::vector<Surface>& surfaces) {
    for (const Surface& surface : surfaces) {
      if (!textured(surface) || !surface.texture->whole()) continue;
      if (numbers_.emplace(surface.texture.get(), textures_.size()).second)
        textures_.push_back(surface.texture.get());
    }
  }

  std::size_t number_of(const Surface& surface) const {
    if (!textured(surface)) return 0;
    const auto found = numbers_.find(surface.texture.get());
    return found == numbers_.end() ? 0 : found->second;
  }
  const std::vector<const Texture*>& textures() const { return textures_; }

 private:
  static inline const Texture kWhite{1, 1, {255, 255, 255, 255}};
  std::vector<const Texture*> textures_{&kWhite};
  std::map<const Texture*, std::size_t> numbers_;  // looked up, never walked through
};

/// Texture coordinates of a face, moved by whole repeats to near 0, where single precision is finest.
std::vector<std::array<float, 2>> near_zero(std::vector<std::array<float, 2>> uv) {
  for (const std::size_t axis : {0u, 1u}) {
    float low = uv.front()[axis];
    for (const auto& at : uv) low = std::min(low, at[axis]);
    for (auto& at : uv) at[axis] -= std::floor(low);
  }
  return uv;
}

/// The triangles of the surfaces of one kind, for each texture.
std::vector<std::vector<Vertex>> make_vertices(const std::vector<Surface>& surfaces, SurfaceKind kind,
                                               const TextureTable& textures, const Camera& camera,
                                               std::optional<double> cut_z_m) {
  std::vector<std::vector<Vertex>> out(textures.textures().size());
  for (const Surface& surface : surfaces) {
    if (surface.kind != kind || !drawable_polygon(surface.polygon)) continue;
    const std::vector<Vec3>& corners = surface.polygon.vertices;
    const std::array<float, 3> normal = to_float(lit_normal(surface, camera));
    const std::size_t texture = textures.number_of(surface);
    const auto uv = texture > 0 ? near_zero(surface.uv) : std::vector<std::array<float, 2>>(corners.size());
    const auto add = [&](std::size_t i) {
      const double below = cut_z_m ? *cut_z_m - corners[i].z() : 1.0;
      out[texture].push_back({to_float(camera.to_camera(corners[i])), normal, unit_colour(surface.colour),
                              uv[i], static_cast<float>(below)});
    };
    for (std::size_t i = 2; i < corners.size(); ++i) {
      add(0);
      add(i - 1);
      add(i);
    }
  }
  return out;
}

/// Two triangles at the height of the cut that cover all of the surfaces.
std::vector<Vertex> make_section(const std::vector<Surface>& surfaces, const Camera& camera, double cut_z_m) {
  Eigen::AlignedBox3d box;
  for (const Surface& surface : surfaces) {
    if (!drawable_polygon(surface.polygon)) continue;
    for (const Vec3& corner : surface.polygon.vertices) box.extend(corner);
  }
  const Vec2 low = box.min().head<2>() - Vec2::Ones();
  const Vec2 high = box.max().head<2>() + Vec2::Ones();
  const auto vertex = [&](double x, double y) {
    return Vertex{to_float(camera.to_camera({x, y, cut_z_m})),
                  {0.0f, 0.0f, 1.0f},
                  unit_colour(palette::kCut),
                  {0.0f, 0.0f},
                  1.0f};
  };
  const std::array<Vertex, 4> corner{vertex(low.x(), low.y()), vertex(high.x(), low.y()),
                                     vertex(high.x(), high.y()), vertex(low.x(), high.y())};
  return {corner[0], corner[1], corner[2], corner[0], corner[2], corner[3]};
}

/// Nearest and farthest distance that the depth buffer must tell apart.
struct DepthRange {
  double near_m, far_m;
};

DepthRange depth_range(const std::vector<Vertex>& vertices, const Camera& camera) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Vertex& v : vertices) {
    low = std::min<double>(low, static_cast<double>(v.camera[2]));
    high = std::max<double>(high, static_cast<double>(v.camera[2]));
  }
  const double margin = 0.01 + 1e-3 * (high - low);
  if (camera.kind() == ViewKind::kTop) return {low - margin, high + margin};
  const double near_m = std::max(low - margin, Camera::near_m());
  return {near_m, std::max(high + margin, 2.0 * near_m)};
}

/// A run of vertices.
struct VertexRange {
  GLint first = 0;
  GLsizei count = 0;
};

/// Vertices that are drawn with one texture.
struct Batch {
  VertexRange range{};
  std::size_t texture = 0;  ///< number in the TextureTable
};

/// The vertices of a drawing in one array.
struct VertexArray {
  std::vector<Vertex> vertices{};
  std::vector<Batch> solid{};  ///< faces of closed things
  VertexRange closed{};        ///< those and the faces that only close them
  std::vector<Batch> sheets{};
  VertexRange section{};

  /// Appends a part and says where it stands.
  VertexRange add(const std::vector<Vertex>& part) {
    const VertexRange range{static_cast<GLint>(vertices.size()), static_cast<GLsizei>(part.size())};
    vertices.insert(vertices.end(), part.begin(), part.end());
    return range;
  }
  std::vector<Batch> add(const std::vector<std::vector<Vertex>>& by_texture) {
    std::vector<Batch> batches;
    for (std::size_t texture = 0; texture < by_texture.size(); ++texture) {
      if (!by_texture[texture].empty()) batches.push_back({add(by_texture[texture]), texture});
    }
    return batches;
  }
};

/// GL objects of one drawing; all die with it.
class SurfacePainter {
 public:
  SurfacePainter(const VertexArray& array, const std::vector<const Texture*>& textures, const Camera& camera,
                 Renderer renderer)
      : context_(make_offscreen_context(renderer)),
        gl_(*context_),
        camera_(camera),
        range_(depth_range(array.vertices, camera)),
        solid_(array.solid),
        closed_(array.closed),
        sheets_(array.sheets),
        section_(array.section) {
    make_program();
    upload(array.vertices);
    upload(textures);
    make_buffers();
  }

  SurfacePainter(const SurfacePainter&) = delete;
  SurfacePainter& operator=(const SurfacePainter&) = delete;

  ~SurfacePainter() {
    gl_.delete_framebuffers(2, framebuffers_.data());
    gl_.delete_renderbuffers(6, renderbuffers_.data());
    gl_.delete_textures(static_cast<GLsizei>(textures_.size()), textures_.data());
    gl_.delete_vertex_arrays(1, &vertex_array_);
    gl_.delete_buffers(1, &vertex_buffer_);
    gl_.delete_program(program_);
  }

  void draw_tile(SurfaceLayer& layer, int left, int top) {
    const int width = std::min(kTileSide, layer.width - left);
    const int height = std::min(kTileSide, layer.height - top);
    gl_.bind_framebuffer(GL_FRAMEBUFFER, framebuffers_[0]);
    gl_.viewport(0, 0, width, height);
    clear();
    set_projection(layer, left, top, width, height);
    draw_faces();
    resolve(width, height);
    read_back(layer, left, top, width, height);
    if (gl_.get_error() != GL_NO_ERROR) fail("OpenGL reports an error");
  }

 private:
  GLuint compile(GLenum kind, const char* source) {
    const GLuint shader = gl_.create_shader(kind);
    gl_.shader_source(shader, 1, &source, nullptr);
    gl_.compile_shader(shader);
    GLint done = 0;
    gl_.get_shader(shader, GL_COMPILE_STATUS, &done);
    if (done == 0) fail("OpenGL does not compile a shader");
    return shader;
  }

  void make_program() {
    const GLuint vertex = compile(GL_VERTEX_SHADER, kVertexShader);
    const GLuint fragment = compile(GL_FRAGMENT_SHADER, kFragmentShader);
    program_ = gl_.create_program();
    gl_.attach_shader(program_, vertex);
    gl_.attach_shader(program_, fragment);
    gl_.link_program(program_);
    gl_.delete_shader(vertex);
    gl_.delete_shader(fragment);
    GLint done = 0;
    gl_.get_program(program_, GL_LINK_STATUS, &done);
    if (done == 0) fail("OpenGL does not link the shaders");
    gl_.use_program(program_);
    cut_location_ = gl_.get_uniform_location(program_, "cut");
  }

  void attribute(GLuint location, GLint size, std::size_t offset) {
    gl_.enable_vertex_attrib_array(location);
    gl_.vertex_attrib_pointer(location, size, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                              reinterpret_cast<const void*>(offset));
  }

  void upload(const std::vector<Vertex>& vertices) {
    gl_.gen_vertex_arrays(1, &vertex_array_);
    gl_.bind_vertex_array(vertex_array_);
    gl_.gen_buffers(1, &vertex_buffer_);
    gl_.bind_buffer(GL_ARRAY_BUFFER, vertex_buffer_);
    gl_.buffer_data(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)),
                    vertices.data(), GL_STATIC_DRAW);
    attribute(0, 3, offsetof(Vertex, camera));
    attribute(1, 3, offsetof(Vertex, normal));
    attribute(2, 3, offsetof(Vertex, colour));
    attribute(3, 2, offsetof(Vertex, uv));
    attribute(4, 1, offsetof(Vertex, below_cut));
  }

  void upload(const std::vector<const Texture*>& textures) {
    GLint longest_side = 0;
    gl_.get_integer(GL_MAX_TEXTURE_SIZE, &longest_side);
    textures_.resize(textures.size());
    gl_.gen_textures(static_cast<GLsizei>(textures_.size()), textures_.data());
    for (std::size_t i = 0; i < textures.size(); ++i) {
      gl_.bind_texture(GL_TEXTURE_2D, textures_[i]);
      // It repeats as it is. From afar the mean of what a pixel covers is seen, so that it does not shimmer.
      gl_.tex_parameter_i(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
      const auto side = static_cast<std::uint32_t>(longest_side);
      if (textures[i]->width > side || textures[i]->height > side) {
        fill_texture(reduced(*textures[i], side));
      } else {
        fill_texture(*textures[i]);
      }
    }
  }

  void fill_texture(const Texture& texture) {
    gl_.tex_image_2d(GL_TEXTURE_2D, 0, GL_RGBA8, static_cast<GLsizei>(texture.width),
                     static_cast<GLsizei>(texture.height), 0, GL_RGBA, GL_UNSIGNED_BYTE, texture.rgba.data());
    gl_.generate_mipmap(GL_TEXTURE_2D);
  }

  /// Framebuffer `which` (0 multisampled, 1 resolved): colour, normal, depth and stencil.
  void make_framebuffer(std::size_t which, GLsizei samples) {
    constexpr std::array<GLenum, 3> kFormats{GL_RGBA8, GL_RGBA8, GL_DEPTH32F_STENCIL8};
    constexpr std::array<GLenum, 3> kPlaces{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1,
                                            GL_DEPTH_STENCIL_ATTACHMENT};
    gl_.bind_framebuffer(GL_FRAMEBUFFER, framebuffers_[which]);
    for (std::size_t i = 0; i < kFormats.size(); ++i) {
      const GLuint buffer = renderbuffers_[3 * which + i];
      gl_.bind_renderbuffer(GL_RENDERBUFFER, buffer);
      gl_.renderbuffer_storage_multisample(GL_RENDERBUFFER, samples, kFormats[i], kTileSide, kTileSide);
      gl_.framebuffer_renderbuffer(GL_FRAMEBUFFER, kPlaces[i], GL_RENDERBUFFER, buffer);
    }
    if (gl_.check_framebuffer_status(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
      fail("OpenGL makes no multisampled framebuffer");
    }
  }

  void make_buffers() {
    GLint most = 0;
    gl_.get_integer(GL_MAX_SAMPLES, &most);
    gl_.gen_framebuffers(2, framebuffers_.data());
    gl_.gen_renderbuffers(6, renderbuffers_.data());
    make_framebuffer(0, std::min(kMultisamples, most));
    make_framebuffer(1, 0);
  }

  void clear() {
    gl_.draw_buffers(2, kBoth.data());
    const std::array<float, 3> paper = unit_colour(palette::kPaper);
    const std::array<float, 4> background{paper[0], paper[1], paper[2], 0.0f};
    constexpr std::array<float, 4> kNoNormal{0.5f, 0.5f, 0.5f, 0.0f};
    gl_.clear_buffer_fv(GL_COLOR, 0, background.data());
    gl_.clear_buffer_fv(GL_COLOR, 1, kNoNormal.data());
    gl_.clear_buffer_fi(GL_DEPTH_STENCIL, 0, 1.0f, 0);
  }

  void set_projection(const SurfaceLayer& layer, int left, int top, int width, int height) {
    const double factor = layer.factor;
    const Vec2 centre =
        (camera_.centre_px() - Vec2(layer.area.left, layer.area.top)) * factor - Vec2(left, top);
    const Vec2 half(0.5 * width, 0.5 * height);
    const Vec2 scale = Vec2::Constant(camera_.scale() * factor).cwiseQuotient(half);
    const Vec2 shift = centre.cwiseQuotient(half) - Vec2::Ones();
    const auto set = [this](const char* name, double x, double y, double z, double w) {
      gl_.uniform_4f(gl_.get_uniform_location(program_, name), static_cast<float>(x), static_cast<float>(y),
                     static_cast<float>(z), static_cast<float>(w));
    };
    set("scale_shift", scale.x(), scale.y(), shift.x(), shift.y());
    const double near_m = range_.near_m;
    const double far_m = range_.far_m;
    const double span = far_m - near_m;
    if (camera_.kind() == ViewKind::kTop) {
      set("depth", 2.0 / span, -(far_m + near_m) / span, 0.0, 1.0);
    } else {
      set("depth", (far_m + near_m) / span, -2.0 * far_m * near_m / span, 1.0, 0.0);
    }
  }

  void draw_faces() {
    gl_.enable(GL_MULTISAMPLE);
    gl_.bind_texture(GL_TEXTURE_2D, textures_[0]);
    gl_.depth_func(GL_LEQUAL);
    gl_.enable(GL_CLIP_DISTANCE0);
    // Rows run down, which mirrors the picture and with it the sense of rotation of every face.
    gl_.front_face(GL_CW);
    gl_.uniform_1f(cut_location_, 0.0f);
    if (section_.count > 0) count_solids_at_cut();
    gl_.enable(GL_DEPTH_TEST);
    draw_batches(sheets_);
    gl_.enable(GL_CULL_FACE);
    gl_.cull_face(GL_BACK);
    draw_batches(solid_);
    if (section_.count > 0) draw_section();
    gl_.disable(GL_CULL_FACE);
    gl_.disable(GL_DEPTH_TEST);
  }

  void draw_batches(const std::vector<Batch>& batches) {
    for (const Batch& batch : batches) {
      gl_.bind_texture(GL_TEXTURE_2D, textures_[batch.texture]);
      gl_.draw_arrays(GL_TRIANGLES, batch.range.first, batch.range.count);
    }
    gl_.bind_texture(GL_TEXTURE_2D, textures_[0]);
  }

  /// Leaves in the stencil the number of solids that hold the point where the ray of sight crosses the cut: behind it, a
  /// solid around that point shows one back, every other one as many fronts as backs. Right for overlapping solids too.
  void count_solids_at_cut() {
    constexpr std::array<GLenum, 2> kNone{GL_NONE, GL_NONE};
    gl_.draw_buffers(2, kNone.data());
    gl_.enable(GL_STENCIL_TEST);
    gl_.stencil_func(GL_ALWAYS, 0, 0xFF);
    gl_.stencil_op_separate(GL_FRONT, GL_KEEP, GL_KEEP, GL_DECR_WRAP);
    gl_.stencil_op_separate(GL_BACK, GL_KEEP, GL_KEEP, GL_INCR_WRAP);
    gl_.draw_arrays(GL_TRIANGLES, closed_.first, closed_.count);
    gl_.disable(GL_STENCIL_TEST);
    gl_.draw_buffers(2, kBoth.data());
  }

  void draw_section() {
    gl_.enable(GL_STENCIL_TEST);
    gl_.stencil_func(GL_NOTEQUAL, 0, 0xFF);
    gl_.stencil_op_separate(GL_FRONT_AND_BACK, GL_KEEP, GL_KEEP, GL_KEEP);
    gl_.uniform_1f(cut_location_, 1.0f);
    gl_.draw_arrays(GL_TRIANGLES, section_.first, section_.count);
    gl_.disable(GL_STENCIL_TEST);
  }

  void resolve(int width, int height) {
    gl_.bind_framebuffer(GL_READ_FRAMEBUFFER, framebuffers_[0]);
    gl_.bind_framebuffer(GL_DRAW_FRAMEBUFFER, framebuffers_[1]);
    for (const GLenum place : kBoth) {
      gl_.read_buffer(place);
      gl_.draw_buffers(place == GL_COLOR_ATTACHMENT0 ? 1 : 2,
                       place == GL_COLOR_ATTACHMENT0 ? kBoth.data() : kOnlySecond.data());
      gl_.blit_framebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    }
    gl_.blit_framebuffer(0, 0, width, height, 0, 0, width, height, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  }

  void read_back(SurfaceLayer& layer, int left, int top, int width, int height) {
    const std::size_t count = pixel_index(0, height, width);
    colours_.resize(4 * count);
    normals_.resize(4 * count);
    depths_.resize(count);
    gl_.bind_framebuffer(GL_READ_FRAMEBUFFER, framebuffers_[1]);
    gl_.pixel_store(GL_PACK_ALIGNMENT, 1);
    gl_.read_buffer(GL_COLOR_ATTACHMENT0);
    gl_.read_pixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, colours_.data());
    gl_.read_buffer(GL_COLOR_ATTACHMENT1);
    gl_.read_pixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, normals_.data());
    gl_.read_pixels(0, 0, width, height, GL_DEPTH_COMPONENT, GL_FLOAT, depths_.data());
    for_each_pixel({0, 0, width, height}, [&](int x, int y) {
      store(layer, layer.index(left + x, top + y), pixel_index(x, y, width));
    });
  }

  void store(SurfaceLayer& layer, std::size_t to, std::size_t from) const {
    const std::uint8_t* c = &colours_[4 * from];
    layer.colour[to] = {c[0], c[1], c[2]};
    const std::uint8_t* n = &normals_[4 * from];
    const bool nothing = depths_[from] >= 1.0f;
    Eigen::Vector3f normal(static_cast<float>(n[0]) - 127.5f, static_cast<float>(n[1]) - 127.5f,
                           static_cast<float>(n[2]) - 127.5f);
    layer.normal[to] =
        nothing || normal.norm() < 1.0f ? Eigen::Vector3f(Eigen::Vector3f::Zero()) : normal.normalized();
    layer.distance_m[to] = nothing ? std::numeric_limits<float>::infinity() : distance_of(depths_[from]);
    layer.cut[to] = !nothing && section_.count > 0 && n[3] < 192 ? 1 : 0;
  }

  float distance_of(float depth) const {
    const double z = 2.0 * static_cast<double>(depth) - 1.0;
    const double near_m = range_.near_m;
    const double far_m = range_.far_m;
    if (camera_.kind() == ViewKind::kTop)
      return static_cast<float>(0.5 * (far_m + near_m + z * (far_m - near_m)));
    return static_cast<float>(2.0 * far_m * near_m / (far_m + near_m - z * (far_m - near_m)));
  }

  static constexpr std::array<GLenum, 2> kBoth{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
  static constexpr std::array<GLenum, 2> kOnlySecond{GL_NONE, GL_COLOR_ATTACHMENT1};

  std::unique_ptr<GlContext> context_;
  GlFunctions gl_;
  const Camera& camera_;
  DepthRange range_;
  std::vector<Batch> solid_;
  VertexRange closed_;
  std::vector<Batch> sheets_;
  VertexRange section_;
  GLint cut_location_ = -1;
  GLuint program_ = 0;
  GLuint vertex_array_ = 0;
  GLuint vertex_buffer_ = 0;
  std::vector<GLuint> textures_;
  std::array<GLuint, 2> framebuffers_{};
  std::array<GLuint, 6> renderbuffers_{};
  std::vector<std::uint8_t> colours_;
  std::vector<std::uint8_t> normals_;
  std::vector<float> depths_;
};

SurfaceLayer empty_layer(const PixelRect& area, int factor) {
  SurfaceLayer layer;
  layer.area = area;
  layer.factor = factor;
  layer.width = area.width() * factor;
  layer.height = area.height() * factor;
  const std::size_t count = layer.index(0, layer.height);
  layer.colour.assign(count, palette::kPaper);
  layer.normal.assign(count, Eigen::Vector3f::Zero());
  layer.distance_m.assign(count, std::numeric_limits<float>::infinity());
  layer.cut.assign(count, 0);
  return layer;
}

}  // namespace

SurfaceLayer render_surfaces(const std::vector<Surface>& surfaces, const Camera& camera,
                             const PixelRect& area, int factor, const View& view) {
  const std::optional<double> cut_z_m = view.cut_z_m;
  SurfaceLayer layer = empty_layer(area, factor);
  VertexArray array;
  const TextureTable textures(surfaces);
  const auto add = [&](SurfaceKind kind) {
    return array.add(make_vertices(surfaces, kind, textures, camera, cut_z_m));
  };
  array.solid = add(SurfaceKind::kSolid);
  add(SurfaceKind::kUnseen);
  array.closed = {0, static_cast<GLsizei>(array.vertices.size())};
  array.sheets = add(SurfaceKind::kSheet);
  if (array.vertices.empty()) return layer;
  if (cut_z_m && (camera.kind() == ViewKind::kTop || camera.eye().z() > *cut_z_m)) {
    array.section = array.add(make_section(surfaces, camera, *cut_z_m));
  }
  SurfacePainter painter(array, textures.textures(), camera, view.renderer);
  for (int top = 0; top < layer.height; top += kTileSide) {
    for (int left = 0; left < layer.width; left += kTileSide) painter.draw_tile(layer, left, top);
  }
  return layer;
}

}  // namespace hallway::render
