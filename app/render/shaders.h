// The painter's shaders, as GLSL 3.30 text. Vectors are in the world frame, colours linear; the
// canvas encodes sRGB.
//
// Variants are made by #define, not by uniforms: llvmpipe runs both sides of every branch.
#pragma once

#include <string>

namespace twinarm {

struct ShaderVariant {
  int shadow_taps = 4;  // 1 or 4, each the mean of 2 x 2 texels
  bool sky_sample =
      false;              // the sky is one direction with a shadow map of its own (studio quality)
  bool textured = false;  // the colour is multiplied by a texture's
};

std::string solid_vertex_shader(const ShaderVariant& variant);
std::string solid_fragment_shader(const ShaderVariant& variant);
std::string ghost_fragment_shader();  // with the solid vertex shader
std::string depth_vertex_shader();    // bodies into a shadow map
std::string depth_fragment_shader();
std::string floor_vertex_shader(const ShaderVariant& variant);
std::string floor_fragment_shader(const ShaderVariant& variant);
std::string background_vertex_shader();
std::string background_fragment_shader();

}  // namespace twinarm
