// SPDX-License-Identifier: MIT
#include "render/gl_functions.hpp"

#include <string>

#include "base/error.hpp"

namespace hallway::render {
namespace {

template <class T>
void look_up(const GlContext& context, const char* name, T& target) {
  const GlContext::Function found = context.function(name);
  if (found == nullptr)
    throw Error(ErrorCode::kIo, std::string("no picture can be drawn: OpenGL has no ") + name);
  target = reinterpret_cast<T>(found);
}

}  // namespace

GlFunctions::GlFunctions(const GlContext& context) {
  look_up(context, "glAttachShader", attach_shader);
  look_up(context, "glBindBuffer", bind_buffer);
  look_up(context, "glBindFramebuffer", bind_framebuffer);
  look_up(context, "glBindRenderbuffer", bind_renderbuffer);
  look_up(context, "glBindTexture", bind_texture);
  look_up(context, "glBindVertexArray", bind_vertex_array);
  look_up(context, "glBlitFramebuffer", blit_framebuffer);
  look_up(context, "glBufferData", buffer_data);
  look_up(context, "glCheckFramebufferStatus", check_framebuffer_status);
  look_up(context, "glClearBufferfi", clear_buffer_fi);
  look_up(context, "glClearBufferfv", clear_buffer_fv);
  look_up(context, "glCompileShader", compile_shader);
  look_up(context, "glCreateProgram", create_program);
  look_up(context, "glCreateShader", create_shader);
  look_up(context, "glCullFace", cull_face);
  look_up(context, "glDeleteBuffers", delete_buffers);
  look_up(context, "glDeleteFramebuffers", delete_framebuffers);
  look_up(context, "glDeleteProgram", delete_program);
  look_up(context, "glDeleteRenderbuffers", delete_renderbuffers);
  look_up(context, "glDeleteShader", delete_shader);
  look_up(context, "glDeleteTextures", delete_textures);
  look_up(context, "glDeleteVertexArrays", delete_vertex_arrays);
  look_up(context, "glDepthFunc", depth_func);
  look_up(context, "glDisable", disable);
  look_up(context, "glDrawArrays", draw_arrays);
  look_up(context, "glDrawBuffers", draw_buffers);
  look_up(context, "glEnable", enable);
  look_up(context, "glEnableVertexAttribArray", enable_vertex_attrib_array);
  look_up(context, "glFramebufferRenderbuffer", framebuffer_renderbuffer);
  look_up(context, "glFrontFace", front_face);
  look_up(context, "glGenBuffers", gen_buffers);
  look_up(context, "glGenFramebuffers", gen_framebuffers);
  look_up(context, "glGenRenderbuffers", gen_renderbuffers);
  look_up(context, "glGenTextures", gen_textures);
  look_up(context, "glGenVertexArrays", gen_vertex_arrays);
  look_up(context, "glGenerateMipmap", generate_mipmap);
  look_up(context, "glGetError", get_error);
  look_up(context, "glGetIntegerv", get_integer);
  look_up(context, "glGetProgramiv", get_program);
  look_up(context, "glGetShaderiv", get_shader);
  look_up(context, "glGetUniformLocation", get_uniform_location);
  look_up(context, "glLinkProgram", link_program);
  look_up(context, "glPixelStorei", pixel_store);
  look_up(context, "glReadBuffer", read_buffer);
  look_up(context, "glReadPixels", read_pixels);
  look_up(context, "glRenderbufferStorageMultisample", renderbuffer_storage_multisample);
  look_up(context, "glShaderSource", shader_source);
  look_up(context, "glStencilFunc", stencil_func);
  look_up(context, "glStencilOpSeparate", stencil_op_separate);
  look_up(context, "glTexImage2D", tex_image_2d);
  look_up(context, "glTexParameteri", tex_parameter_i);
  look_up(context, "glUniform1f", uniform_1f);
  look_up(context, "glUniform4f", uniform_4f);
  look_up(context, "glUseProgram", use_program);
  look_up(context, "glVertexAttribPointer", vertex_attrib_pointer);
  look_up(context, "glViewport", viewport);
}

}  // namespace hallway::render
