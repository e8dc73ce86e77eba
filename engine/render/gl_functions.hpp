// SPDX-License-Identifier: MIT
#pragma once

#include <GL/glcorearb.h>

#include "render/gl_context.hpp"
#include "render/gl_library.hpp"

namespace hallway::render {

/// The GL functions that surfaces are drawn with, as pointers of one context.
class GlFunctions {
  const GlContext& context_;

  /// Throws Error{kIo} naming a function that the context does not have.
  EntryPoint find(const char* name) const;

 public:
  /// Looks all of them up, in their order. Throws Error{kIo} naming the first that the context does not have. Keeps a reference.
  explicit GlFunctions(const GlContext& context) : context_(context) {}

  PFNGLATTACHSHADERPROC attach_shader = find("glAttachShader");
  PFNGLBINDBUFFERPROC bind_buffer = find("glBindBuffer");
  PFNGLBINDFRAMEBUFFERPROC bind_framebuffer = find("glBindFramebuffer");
  PFNGLBINDRENDERBUFFERPROC bind_renderbuffer = find("glBindRenderbuffer");
  PFNGLBINDTEXTUREPROC bind_texture = find("glBindTexture");
  PFNGLBINDVERTEXARRAYPROC bind_vertex_array = find("glBindVertexArray");
  PFNGLBLITFRAMEBUFFERPROC blit_framebuffer = find("glBlitFramebuffer");
  PFNGLBUFFERDATAPROC buffer_data = find("glBufferData");
  PFNGLCHECKFRAMEBUFFERSTATUSPROC check_framebuffer_status = find("glCheckFramebufferStatus");
  PFNGLCLEARBUFFERFIPROC clear_buffer_fi = find("glClearBufferfi");
  PFNGLCLEARBUFFERFVPROC clear_buffer_fv = find("glClearBufferfv");
  PFNGLCOMPILESHADERPROC compile_shader = find("glCompileShader");
  PFNGLCREATEPROGRAMPROC create_program = find("glCreateProgram");
  PFNGLCREATESHADERPROC create_shader = find("glCreateShader");
  PFNGLCULLFACEPROC cull_face = find("glCullFace");
  PFNGLDELETEBUFFERSPROC delete_buffers = find("glDeleteBuffers");
  PFNGLDELETEFRAMEBUFFERSPROC delete_framebuffers = find("glDeleteFramebuffers");
  PFNGLDELETEPROGRAMPROC delete_program = find("glDeleteProgram");
  PFNGLDELETERENDERBUFFERSPROC delete_renderbuffers = find("glDeleteRenderbuffers");
  PFNGLDELETESHADERPROC delete_shader = find("glDeleteShader");
  PFNGLDELETETEXTURESPROC delete_textures = find("glDeleteTextures");
  PFNGLDELETEVERTEXARRAYSPROC delete_vertex_arrays = find("glDeleteVertexArrays");
  PFNGLDEPTHFUNCPROC depth_func = find("glDepthFunc");
  PFNGLDISABLEPROC disable = find("glDisable");
  PFNGLDRAWARRAYSPROC draw_arrays = find("glDrawArrays");
  PFNGLDRAWBUFFERSPROC draw_buffers = find("glDrawBuffers");
  PFNGLENABLEPROC enable = find("glEnable");
  PFNGLENABLEVERTEXATTRIBARRAYPROC enable_vertex_attrib_array = find("glEnableVertexAttribArray");
  PFNGLFRAMEBUFFERRENDERBUFFERPROC framebuffer_renderbuffer = find("glFramebufferRenderbuffer");
  PFNGLFRONTFACEPROC front_face = find("glFrontFace");
  PFNGLGENBUFFERSPROC gen_buffers = find("glGenBuffers");
  PFNGLGENFRAMEBUFFERSPROC gen_framebuffers = find("glGenFramebuffers");
  PFNGLGENRENDERBUFFERSPROC gen_renderbuffers = find("glGenRenderbuffers");
  PFNGLGENTEXTURESPROC gen_textures = find("glGenTextures");
  PFNGLGENVERTEXARRAYSPROC gen_vertex_arrays = find("glGenVertexArrays");
  PFNGLGENERATEMIPMAPPROC generate_mipmap = find("glGenerateMipmap");
  PFNGLGETERRORPROC get_error = find("glGetError");
  PFNGLGETINTEGERVPROC get_integer = find("glGetIntegerv");
  PFNGLGETPROGRAMIVPROC get_program = find("glGetProgramiv");
  PFNGLGETSHADERIVPROC get_shader = find("glGetShaderiv");
  PFNGLGETUNIFORMLOCATIONPROC get_uniform_location = find("glGetUniformLocation");
  PFNGLLINKPROGRAMPROC link_program = find("glLinkProgram");
  PFNGLPIXELSTOREIPROC pixel_store = find("glPixelStorei");
  PFNGLREADBUFFERPROC read_buffer = find("glReadBuffer");
  PFNGLREADPIXELSPROC read_pixels = find("glReadPixels");
  PFNGLRENDERBUFFERSTORAGEMULTISAMPLEPROC renderbuffer_storage_multisample =
      find("glRenderbufferStorageMultisample");
  PFNGLSHADERSOURCEPROC shader_source = find("glShaderSource");
  PFNGLSTENCILFUNCPROC stencil_func = find("glStencilFunc");
  PFNGLSTENCILOPSEPARATEPROC stencil_op_separate = find("glStencilOpSeparate");
  PFNGLTEXIMAGE2DPROC tex_image_2d = find("glTexImage2D");
  PFNGLTEXPARAMETERIPROC tex_parameter_i = find("glTexParameteri");
  PFNGLUNIFORM1FPROC uniform_1f = find("glUniform1f");
  PFNGLUNIFORM4FPROC uniform_4f = find("glUniform4f");
  PFNGLUSEPROGRAMPROC use_program = find("glUseProgram");
  PFNGLVERTEXATTRIBPOINTERPROC vertex_attrib_pointer = find("glVertexAttribPointer");
  PFNGLVIEWPORTPROC viewport = find("glViewport");
};

}  // namespace hallway::render
