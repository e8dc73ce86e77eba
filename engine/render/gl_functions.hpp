// SPDX-License-Identifier: MIT
#pragma once

#include <GL/glcorearb.h>

#include "render/gl_context.hpp"

namespace hallway::render {

/// The GL functions that surfaces are drawn with, as pointers of one context.
struct GlFunctions {
  /// Looks all of them up. Throws Error{kIo} naming the first that the context does not have.
  explicit GlFunctions(const GlContext& context);

  PFNGLATTACHSHADERPROC attach_shader;
  PFNGLBINDBUFFERPROC bind_buffer;
  PFNGLBINDFRAMEBUFFERPROC bind_framebuffer;
  PFNGLBINDRENDERBUFFERPROC bind_renderbuffer;
  PFNGLBINDTEXTUREPROC bind_texture;
  PFNGLBINDVERTEXARRAYPROC bind_vertex_array;
  PFNGLBLITFRAMEBUFFERPROC blit_framebuffer;
  PFNGLBUFFERDATAPROC buffer_data;
  PFNGLCHECKFRAMEBUFFERSTATUSPROC check_framebuffer_status;
  PFNGLCLEARBUFFERFIPROC clear_buffer_fi;
  PFNGLCLEARBUFFERFVPROC clear_buffer_fv;
  PFNGLCOMPILESHADERPROC compile_shader;
  PFNGLCREATEPROGRAMPROC create_program;
  PFNGLCREATESHADERPROC create_shader;
  PFNGLCULLFACEPROC cull_face;
  PFNGLDELETEBUFFERSPROC delete_buffers;
  PFNGLDELETEFRAMEBUFFERSPROC delete_framebuffers;
  PFNGLDELETEPROGRAMPROC delete_program;
  PFNGLDELETERENDERBUFFERSPROC delete_renderbuffers;
  PFNGLDELETESHADERPROC delete_shader;
  PFNGLDELETETEXTURESPROC delete_textures;
  PFNGLDELETEVERTEXARRAYSPROC delete_vertex_arrays;
  PFNGLDEPTHFUNCPROC depth_func;
  PFNGLDISABLEPROC disable;
  PFNGLDRAWARRAYSPROC draw_arrays;
  PFNGLDRAWBUFFERSPROC draw_buffers;
  PFNGLENABLEPROC enable;
  PFNGLENABLEVERTEXATTRIBARRAYPROC enable_vertex_attrib_array;
  PFNGLFRAMEBUFFERRENDERBUFFERPROC framebuffer_renderbuffer;
  PFNGLFRONTFACEPROC front_face;
  PFNGLGENBUFFERSPROC gen_buffers;
  PFNGLGENFRAMEBUFFERSPROC gen_framebuffers;
  PFNGLGENRENDERBUFFERSPROC gen_renderbuffers;
  PFNGLGENTEXTURESPROC gen_textures;
  PFNGLGENVERTEXARRAYSPROC gen_vertex_arrays;
  PFNGLGENERATEMIPMAPPROC generate_mipmap;
  PFNGLGETERRORPROC get_error;
  PFNGLGETINTEGERVPROC get_integer;
  PFNGLGETPROGRAMIVPROC get_program;
  PFNGLGETSHADERIVPROC get_shader;
  PFNGLGETUNIFORMLOCATIONPROC get_uniform_location;
  PFNGLLINKPROGRAMPROC link_program;
  PFNGLPIXELSTOREIPROC pixel_store;
  PFNGLREADBUFFERPROC read_buffer;
  PFNGLREADPIXELSPROC read_pixels;
  PFNGLRENDERBUFFERSTORAGEMULTISAMPLEPROC renderbuffer_storage_multisample;
  PFNGLSHADERSOURCEPROC shader_source;
  PFNGLSTENCILFUNCPROC stencil_func;
  PFNGLSTENCILOPSEPARATEPROC stencil_op_separate;
  PFNGLTEXIMAGE2DPROC tex_image_2d;
  PFNGLTEXPARAMETERIPROC tex_parameter_i;
  PFNGLUNIFORM1FPROC uniform_1f;
  PFNGLUNIFORM4FPROC uniform_4f;
  PFNGLUSEPROGRAMPROC use_program;
  PFNGLVERTEXATTRIBPOINTERPROC vertex_attrib_pointer;
  PFNGLVIEWPORTPROC viewport;
};

}  // namespace hallway::render
