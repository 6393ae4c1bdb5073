// Light: one key light with a shadow, a sky above, the floor's bounce from below.
//
//   out = colour * (KEY * n.l * visible + SKY * sky(n) + BOUNCE * (1 - n.z) / 2) + gloss
//   sky(n) = (1 + n.z) / 2            the irradiance of an unhidden uniform sky, or
//   sky(n) = 2 * n.d * visible(d)     one direction d of it: with d uniform on the hemisphere its
//                                     mean is the same where nothing hides the sky, and ambient
//                                     occlusion where something does
//
// The floor takes the background's colour wherever it is fully lit, so that no horizon is seen: it
// is there by its shadows and its grid.
#include "app/render/shaders.h"

namespace twinarm {
namespace {

std::string header(const ShaderVariant& variant) {
  return "#version 330 core\n#define SHADOW_TAPS " + std::to_string(variant.shadow_taps) + "\n" +
         (variant.sky_sample ? "#define SKY_SAMPLE\n" : "") +
         (variant.textured ? "#define TEXTURED\n" : "");
}

// Shared by the vertex shaders of lit surfaces. The normal offset moves the point that is looked up
// a texel off its surface, which keeps the surface from shadowing itself.
const char* const kLitVertex = R"(
uniform mat4 clip_from_world, key_from_world, sky_from_world;
uniform float normal_offset;
out vec3 p_world, n_world, p_key, p_sky;
invariant gl_Position;  // a ghost's two passes must agree to the last bit

void place(vec3 p, vec3 n) {
  p_world = p;
  n_world = n;
  vec4 off_surface = vec4(p + normal_offset * normalize(n), 1.0);
  p_key = 0.5 + 0.5 * (key_from_world * off_surface).xyz;
#ifdef SKY_SAMPLE
  p_sky = 0.5 + 0.5 * (sky_from_world * off_surface).xyz;
#endif
  gl_Position = clip_from_world * vec4(p, 1.0);
}
)";

const char* const kSolidVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 world_from_mesh;
uniform mat3 normal_from_mesh;
#ifdef TEXTURED
layout(location = 2) in vec2 uv;
out vec2 uv_picture;
#endif

void main() {
#ifdef TEXTURED
  uv_picture = uv;
#endif
  place((world_from_mesh * vec4(position, 1.0)).xyz, normal_from_mesh * normal);
}
)";

// Corners of a square from the vertex number; ground = (centre x, y, height, half side).
const char* const kFloorVertex = R"(
uniform vec4 ground;

void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  place(vec3(ground.xy + ground.w * corner, ground.z), vec3(0.0, 0.0, 1.0));
}
)";

// Eight bits show bands in a slow gradient; noise of half a step in either direction, before the
// canvas encodes (whose slope is about 1 / (2 sqrt(c))), dissolves them. The noise is a fixed
// function of the pixel: the same scene gives the same bits.
const char* const kDither = R"(
out vec4 color_out;

vec4 dithered(vec3 c, float alpha) {
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  return vec4(c + (noise - 0.5) * (2.0 / 255.0) * sqrt(max(c, 0.0)), alpha);
}
)";

const char* const kLight = R"(
in vec3 p_world, n_world, p_key, p_sky;
uniform vec3 eye, key_direction, sky_direction;
uniform sampler2DShadow key_shadow, sky_shadow;
uniform float texel;

float key_visible() {
#if SHADOW_TAPS == 4
  // Four taps on a square turned by 27 degrees: more distinct distances than an upright one.
  vec2 a = 1.1 * texel * vec2(0.45, 0.89), b = vec2(-a.y, a.x);
  return 0.25 * (texture(key_shadow, p_key + vec3(a, 0.0)) +
                 texture(key_shadow, p_key - vec3(a, 0.0)) +
                 texture(key_shadow, p_key + vec3(b, 0.0)) +
                 texture(key_shadow, p_key - vec3(b, 0.0)));
#else
  return texture(key_shadow, p_key);
#endif
}

float sky_light(vec3 n) {
#ifdef SKY_SAMPLE
  return 2.0 * max(dot(n, sky_direction), 0.0) * texture(sky_shadow, p_sky);
#else
  return 0.5 + 0.5 * n.z;
#endif
}
)";

const char* const kSolidFragment = R"(
uniform vec4 color;
uniform float shininess;
const vec3 KEY = vec3(0.86, 0.82, 0.76), SKY = vec3(0.33, 0.36, 0.40), BOUNCE = vec3(0.17);
#ifdef TEXTURED
in vec2 uv_picture;
uniform sampler2D picture;
#endif

void main() {
  vec3 n = normalize(gl_FrontFacing ? n_world : -n_world), v = normalize(eye - p_world);
  vec3 paint = color.rgb;
#ifdef TEXTURED
  paint *= texture(picture, uv_picture).rgb;
#endif
  float visible = key_visible(), sky = sky_light(n);
  vec3 light = KEY * max(dot(n, key_direction), 0.0) * visible + SKY * sky +
               BOUNCE * (0.5 - 0.5 * n.z);

  // Highlight of the key light, by squaring instead of pow(): (n.h)^16 wide, (n.h)^64 tight.
  float wide = max(dot(n, normalize(key_direction + v)), 0.0);
  wide *= wide; wide *= wide; wide *= wide; wide *= wide;
  float tight = wide * wide;
  tight *= tight;
  // A bright ceiling mirrored in the surface, stronger at grazing angles.
  float grazing = 1.0 - max(dot(n, v), 0.0);
  float fresnel = grazing * grazing * grazing * grazing;
  float ceiling = smoothstep(-0.1, 0.9, reflect(-v, n).z) * (0.3 + 0.7 * min(sky, 1.0));
  float gloss = visible * (0.10 * wide + 0.45 * tight) + ceiling * (0.05 + 0.35 * fresnel);
  color_out = dithered(paint * light + shininess * gloss, 1.0);
}
)";

// A ghost is a thin shell: clear where it is looked through, dense at its silhouette.
const char* const kGhostFragment = R"(
in vec3 p_world, n_world;
uniform vec3 eye;
uniform vec4 color;

void main() {
  vec3 n = normalize(n_world), v = normalize(eye - p_world);
  float rim = 1.0 - max(dot(n, v), 0.0);
  float alpha = mix(color.a, 1.0, 0.85 * rim * rim);
  color_out = dithered(color.rgb * (0.85 + 0.15 * n.z), alpha);
}
)";

const char* const kBackdrop = R"(
uniform vec3 background_bottom, background_top;
uniform vec2 size_px;

vec3 backdrop() {
  return mix(background_bottom, background_top, smoothstep(0.05, 1.0, gl_FragCoord.y / size_px.y));
}
)";

// Grid lines as box-filtered stripes: the share of the pixel's footprint that the line covers. Far
// away it tends to the line's mean cover instead of to moire.
const char* const kFloorFragment = R"(
uniform vec4 ground;
uniform vec4 grid;  // thin cell, strong cell, half width of a line, all in metres; 0

float line_cover(vec2 p, float cell, float half_width) {
  vec2 footprint = fwidth(p);
  vec2 half_line = max(vec2(half_width), 0.5 * footprint);  // never thinner than a pixel,
  vec2 dim = half_width / half_line;                        // but dimmer instead
  vec2 off = abs(fract(p / cell + 0.5) - 0.5) * cell;       // distance to the nearest line
  vec2 cover = clamp((half_line + 0.5 * footprint - off) / max(footprint, 1e-9), 0.0, 1.0);
  cover *= mix(vec2(1.0), dim, 0.45);
  cover *= 1.0 - smoothstep(0.15, 0.5, footprint / cell);
  return max(cover.x, cover.y);
}

void main() {
  float away = length(p_world.xy - ground.xy) / ground.w;
  float near = 1.0 - smoothstep(0.25, 0.95, away);
  float light = mix(1.0, 0.50 * key_visible() + 0.50 * sky_light(vec3(0.0, 0.0, 1.0)),
                    1.0 - smoothstep(0.7, 0.95, away));
  float cover = max(0.22 * line_cover(p_world.xy, grid.x, grid.z),
                    0.42 * line_cover(p_world.xy, grid.y, 1.6 * grid.z));
  vec3 shade = mix(vec3(0.80, 0.90, 1.04), vec3(1.0), light) * light;  // shadows a little blue
  color_out = dithered(backdrop() * shade * (1.0 - near * cover), 1.0);
}
)";

// One triangle over the whole picture, at the far end of the depth range.
const char* const kBackgroundVertex = R"(#version 330 core
void main() {
  vec2 corner = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2) * 2.0 - 1.0;
  gl_Position = vec4(corner, 1.0, 1.0);
}
)";

const char* const kDepthVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
uniform mat4 world_from_mesh, clip_from_world;
void main() { gl_Position = clip_from_world * (world_from_mesh * vec4(position, 1.0)); }
)";

}  // namespace

std::string solid_vertex_shader(const ShaderVariant& variant) {
  return header(variant) + kLitVertex + kSolidVertex;
}
std::string solid_fragment_shader(const ShaderVariant& variant) {
  return header(variant) + kDither + kLight + kSolidFragment;
}
std::string ghost_fragment_shader() {
  return header({}) + kDither + kGhostFragment;
}
std::string depth_vertex_shader() {
  return kDepthVertex;
}
std::string depth_fragment_shader() {
  return "#version 330 core\nvoid main() {}\n";
}
std::string floor_vertex_shader(const ShaderVariant& variant) {
  return header(variant) + kLitVertex + kFloorVertex;
}
std::string floor_fragment_shader(const ShaderVariant& variant) {
  return header(variant) + kDither + kLight + kBackdrop + kFloorFragment;
}
std::string background_vertex_shader() {
  return kBackgroundVertex;
}
std::string background_fragment_shader() {
  return header({}) + kDither + kBackdrop +
         "void main() { color_out = dithered(backdrop(), 1.0); }\n";
}

}  // namespace twinarm
