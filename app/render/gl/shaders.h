// The painter's shaders, GLSL 3.30 (glsl/). Vectors are in the world frame, colours linear; what is
// opaque leaves the shader as sRGB, what is blended is encoded by the canvas.
//
// Variants are made by #define, not by uniforms: llvmpipe runs both sides of every branch.
#pragma once

#include <string>

namespace twinarm {

struct ShaderVariant {
  bool soft_shadow = true;  // over 3 x 3 texels of a map, else 2 x 2, in the sampler
  bool sky_sample =
      false;               // the sky is one direction with a shadow map of its own (studio quality)
  bool key_shadow = true;  // else nothing hides the key light
  bool textured = false;   // the colour is multiplied by a texture's
  bool horizon = false;    // of floor and background: there is a sky that ends, and not one room
};

struct ShaderSource {
  std::string vertex, fragment;
};
ShaderSource solid_shader(const ShaderVariant& variant);
ShaderSource ghost_shader(const ShaderVariant& variant);
ShaderSource depth_shader();  // bodies into a shadow map
ShaderSource floor_shader(const ShaderVariant& variant);
ShaderSource background_shader(const ShaderVariant& variant);

}  // namespace twinarm
