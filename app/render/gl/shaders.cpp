#include "app/render/gl/gl_objects.h"

#include <algorithm>

#include "solver/support/embedded_file.h"

namespace twinarm {

const std::vector<EmbeddedFile>& shader_files();  // glsl/

namespace {

std::string header(const ShaderVariant& variant) {
  return std::string("#version 330 core\n") + (variant.soft_shadow ? "#define SOFT_SHADOW\n" : "") +
         (variant.key_shadow ? "#define KEY_SHADOW\n" : "") +
         (variant.sky_sample ? "#define SKY_SAMPLE\n" : "") +
         (variant.textured ? "#define TEXTURED\n" : "") +
         (variant.horizon ? "#define HORIZON\n" : "");
}

// Concatenates the named files after the header of the variant.
std::string shader(const ShaderVariant& variant, std::initializer_list<const char*> names) {
  std::string text = header(variant);
  for (const char* name : names)
    text += std::ranges::find(shader_files(), name, &EmbeddedFile::name)->text;
  return text;
}

}  // namespace

ShaderSource solid_shader(const ShaderVariant& variant) {
  return {shader(variant, {"place.vert", "solid.vert"}),
          shader(variant, {"finish.frag", "light.frag", "solid.frag"})};
}
ShaderSource translucent_shader(const ShaderVariant& variant) {
  return {shader(variant, {"place.vert", "solid.vert"}),
          shader({}, {"finish.frag", "translucent.frag"})};
}
ShaderSource depth_shader() {
  return {shader({}, {"depth.vert"}), "#version 330 core\nvoid main() {}\n"};
}
ShaderSource floor_shader(const ShaderVariant& variant) {
  return {shader(variant, {"place.vert", "floor.vert"}),
          shader(variant, {"finish.frag", "light.frag", variant.horizon ? "haze.frag" : "room.frag",
                           "floor.frag"})};
}
ShaderSource background_shader(const ShaderVariant& variant) {
  const std::string vertex = shader({}, {"background.vert"});
  if (variant.horizon) return {vertex, shader(variant, {"finish.frag", "sky.frag"})};
  return {vertex, shader(variant, {"finish.frag", "room.frag"}) +
                      "void main() { color_out = finished(room()); }\n"};
}

}  // namespace twinarm
