// The floor and what is behind all: a room or a landscape.
//
// A room's floor takes the background's colour wherever it is fully lit, so that no horizon is
// seen: it is there by its shadows and its grid. A landscape has a ground that a haze takes into
// the colour of the horizon, from which the sky rises: with e the sine of the elevation of a line
// of sight, and a the distance from the middle over the floor's radius,
//
//   sky = mix(zenith, horizon, (1 - e)^5)       ground = mix(horizon, ground, exp(-(a / 0.35)^2))
#include "app/render/gl/shaders.h"

namespace twinarm {
namespace {

// Corners of a square from the vertex number; ground = (centre x, y, height, half side).
const char* const kFloorVertex = R"(
uniform vec4 ground;

void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  place(vec3(ground.xy + ground.w * corner, ground.z), vec3(0.0, 0.0, 1.0));
}
)";

const char* const kRoom = R"(
uniform vec3 background_bottom, background_top;
uniform float per_height;

vec3 room() {
  return mix(background_bottom, background_top, smoothstep(0.05, 1.0, gl_FragCoord.y * per_height));
}
)";

const char* const kHaze = R"(
uniform vec3 background_bottom, background_ground;

vec3 hazy_ground(float away) {
  return mix(background_bottom, background_ground, exp(-8.16 * away * away));
}
)";

// Grid lines as box-filtered stripes: the share of the pixel's footprint that the line covers. Far
// away it tends to the line's mean cover instead of to moire.
const char* const kFloorFragment = R"(
uniform vec4 ground;
uniform vec4 grid;      // thin cell, strong cell, half width of a line [m]
uniform vec4 per_grid;  // one over: the cells, ground.w, the share of it where the grid has faded

float line_cover(float cell, float per_cell, float half_width, vec2 footprint, vec2 per_footprint) {
  vec2 half_line = max(vec2(half_width), 0.5 * footprint);   // never thinner than a pixel,
  vec2 dim = min(vec2(1.0), 2.0 * half_width * per_footprint);  // but dimmer instead
  vec2 off = abs(fract(p_world.xy * per_cell + 0.5) - 0.5) * cell;  // to the nearest line
  vec2 cover = clamp((half_line - off) * per_footprint + 0.5, 0.0, 1.0);
  cover *= 0.55 + 0.45 * dim;
  cover *= 1.0 - smoothstep(0.15, 0.5, footprint * per_cell);
  return max(cover.x, cover.y);
}

void main() {
  float away = length(p_world.xy - ground.xy) * per_grid.z;
  float near = 1.0 - smoothstep(0.25, 0.95, away * per_grid.w);
  float light = mix(1.0, 0.50 * key_visible() + 0.50 * sky_light(vec3(0.0, 0.0, 1.0)),
                    1.0 - smoothstep(0.7, 0.95, away));
  vec2 footprint = fwidth(p_world.xy), per_footprint = 1.0 / max(footprint, 1e-9);
  float cover = max(0.22 * line_cover(grid.x, per_grid.x, grid.z, footprint, per_footprint),
                    0.42 * line_cover(grid.y, per_grid.y, 1.6 * grid.z, footprint, per_footprint));
  vec3 shade = mix(vec3(0.80, 0.90, 1.04), vec3(1.0), light) * light;  // shadows a little blue
#ifdef HORIZON
  vec3 paint = hazy_ground(away);
#else
  vec3 paint = room();
#endif
  color_out = finished(paint * shade * (1.0 - near * cover));
}
)";

// One triangle over the whole picture, at the far end of the depth range.
const char* const kBackgroundVertex = R"(#version 330 core
uniform mat4 world_from_clip;
uniform vec3 eye;
out vec3 line_of_sight;
void main() {
  vec2 corner = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2) * 2.0 - 1.0;
  gl_Position = vec4(corner, 1.0, 1.0);
  vec4 far_away = world_from_clip * gl_Position;  // linear over the picture
  line_of_sight = far_away.xyz / far_away.w - eye;
}
)";

const char* const kSkyFragment = R"(
in vec3 line_of_sight;
uniform vec3 background_bottom, background_top;

void main() {
  float low = 1.0 - clamp(normalize(line_of_sight).z, 0.0, 1.0), square = low * low;
  color_out = finished(mix(background_top, background_bottom, square * square * low));
}
)";

}  // namespace

ShaderSource floor_shader(const ShaderVariant& variant) {
  const std::string header = shader_header(variant);
  return {
      header + kPlaceVertex + kFloorVertex,
      header + kFinishColor + kArrivingLight + (variant.horizon ? kHaze : kRoom) + kFloorFragment};
}
ShaderSource background_shader(const ShaderVariant& variant) {
  const std::string start = shader_header(variant) + kFinishColor;
  if (variant.horizon) return {kBackgroundVertex, start + kSkyFragment};
  return {kBackgroundVertex, start + kRoom + "void main() { color_out = finished(room()); }\n"};
}

}  // namespace twinarm
