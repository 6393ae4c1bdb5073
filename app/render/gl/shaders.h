// Shaders, GLSL 3.30 (glsl/). World frame, linear colours; opaque shaders write sRGB, blended ones
// linear light. Variants by #define: llvmpipe executes both sides of a branch.
#pragma once

#include <string>

namespace twinarm {

struct ShaderVariant {
  bool soft_shadow = true;  // over 3 x 3 texels of the map, else 2 x 2 by the sampler
  bool sky_sample = false;  // one sky direction with its shadow map (studio quality)
  bool key_shadow = true;   // shadows of the key light
  bool textured = false;    // the colour is multiplied by a texture
  bool horizon = false;     // floor and background of a landscape
};

struct ShaderSource {
  std::string vertex, fragment;
};
ShaderSource solid_shader(const ShaderVariant& variant);
ShaderSource translucent_shader(const ShaderVariant& variant);
ShaderSource depth_shader();  // bodies into a shadow map
ShaderSource floor_shader(const ShaderVariant& variant);
ShaderSource background_shader(const ShaderVariant& variant);

}  // namespace twinarm
