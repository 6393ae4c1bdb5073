// Light: one key light with a shadow, a sky above, the floor's bounce from below.
//
//   out = colour * (KEY * n.l * visible + SKY * sky(n) + BOUNCE * (1 - n.z) / 2) + gloss
//   sky(n) = (1 + n.z) / 2            the irradiance of an unhidden uniform sky, or
//   sky(n) = 2 * n.d * visible(d)     one direction d of it: with d uniform on the hemisphere its
//                                     mean is the same where nothing hides the sky, and ambient
//                                     occlusion where something does
#include "app/render/gl/shaders.h"

namespace twinarm {

std::string shader_header(const ShaderVariant& variant) {
  return std::string("#version 330 core\n") + (variant.soft_shadow ? "#define SOFT_SHADOW\n" : "") +
         (variant.key_shadow ? "#define KEY_SHADOW\n" : "") +
         (variant.sky_sample ? "#define SKY_SAMPLE\n" : "") +
         (variant.textured ? "#define TEXTURED\n" : "") +
         (variant.horizon ? "#define HORIZON\n" : "");
}

// The normal offset moves the point that is looked up a texel off its surface, which keeps the
// surface from shadowing itself.
const char* const kPlaceVertex = R"(
uniform mat4 clip_from_world, key_from_world, sky_from_world;
uniform float normal_offset;
out vec3 p_world, n_world, p_key, p_sky;
invariant gl_Position;  // a ghost's two passes must agree to the last bit

void place(vec3 p, vec3 n) {
  p_world = p;
  n_world = n;
  vec4 off_surface = vec4(p + normal_offset * normalize(n), 1.0);
  p_key = (key_from_world * off_surface).xyz;
#ifdef SKY_SAMPLE
  p_sky = (sky_from_world * off_surface).xyz;
#endif
  gl_Position = clip_from_world * vec4(p, 1.0);
}
)";

// sRGB by a polynomial of the square root, the best of degree 4 for colours above 0.004: within 0.2
// steps of eight bits there, below at most 2.2 steps too dark. A canvas that encodes does it for
// each of the four samples of a pixel. Eight bits show
// bands in a slow gradient: noise of half a step in either direction dissolves them. It is a fixed
// function of the pixel: the same scene gives the same bits.
const char* const kFinishColor = R"(
out vec4 color_out;

float pixel_noise() {
  return fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
}

vec4 finished(vec3 c) {
  vec3 s = sqrt(max(c, 0.0));
  vec3 encoded =
      s * (s * (s * (s * -0.2878565 + 0.7938828) - 0.9078319) + 1.4372536) - 0.0361004;
  return vec4(encoded + pixel_noise() / 255.0, 1.0);
}
)";

const char* const kArrivingLight = R"(
in vec3 p_world, n_world, p_key, p_sky;
uniform vec3 eye, key_direction, sky_direction;
uniform sampler2DShadow sky_shadow;
uniform float texel;
uniform vec2 shadow_reach;  // where the squares drawn into key and sky map end

// Nothing casts a shadow at the border of a map, nor beyond it.
vec3 within(vec3 p, float reach) {
  return clamp(p, vec3(2.0 * texel, 2.0 * texel, 0.0), vec3(reach, reach, 1.0));
}

#ifndef KEY_SHADOW
float key_visible() { return 1.0; }
#elif defined(SOFT_SHADOW)
// The share of a square of 2 x 2 texels about the place that is lit: nine looks at the map, where
// four that the sampler makes softer would be sixteen.
uniform sampler2D key_shadow;
#define LIT(x, y) step(p.z, textureOffset(key_shadow, p.xy, ivec2(x, y)).r)
float key_visible() {
  vec3 p = within(p_key, shadow_reach.x);
  vec2 right = fract(p.xy * (1.0 / texel)), left = 1.0 - right;
  float low = left.x * LIT(-1, -1) + LIT(0, -1) + right.x * LIT(1, -1);
  float middle = left.x * LIT(-1, 0) + LIT(0, 0) + right.x * LIT(1, 0);
  float high = left.x * LIT(-1, 1) + LIT(0, 1) + right.x * LIT(1, 1);
  return 0.25 * (left.y * low + middle + right.y * high);
}
#else
uniform sampler2DShadow key_shadow;
float key_visible() {
  return texture(key_shadow, within(p_key, shadow_reach.x));
}
#endif

float sky_light(vec3 n) {
#ifdef SKY_SAMPLE
  return 2.0 * max(dot(n, sky_direction), 0.0) * texture(sky_shadow, within(p_sky, shadow_reach.y));
#else
  return 0.5 + 0.5 * n.z;
#endif
}
)";

namespace {

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
  color_out = finished(paint * light + shininess * gloss);
}
)";

// A ghost is a thin shell: clear where it is looked through, dense at its silhouette. It is blended
// in linear light: the canvas encodes, and the noise is that much smaller where its slope is
// larger.
const char* const kGhostFragment = R"(
in vec3 p_world, n_world;
uniform vec3 eye;
uniform vec4 color;

void main() {
  vec3 n = normalize(n_world), v = normalize(eye - p_world);
  float rim = 1.0 - max(dot(n, v), 0.0);
  float alpha = mix(color.a, 1.0, 0.85 * rim * rim);
  vec3 c = color.rgb * (0.85 + 0.15 * n.z);
  color_out = vec4(c + pixel_noise() * (2.0 / 255.0) * sqrt(max(c, 0.0)), alpha);
}
)";

const char* const kDepthVertex = R"(#version 330 core
layout(location = 0) in vec3 position;
uniform mat4 world_from_mesh, clip_from_world;
void main() { gl_Position = clip_from_world * (world_from_mesh * vec4(position, 1.0)); }
)";

}  // namespace

ShaderSource solid_shader(const ShaderVariant& variant) {
  const std::string header = shader_header(variant);
  return {header + kPlaceVertex + kSolidVertex,
          header + kFinishColor + kArrivingLight + kSolidFragment};
}
ShaderSource ghost_shader(const ShaderVariant& variant) {
  return {shader_header(variant) + kPlaceVertex + kSolidVertex,
          shader_header({}) + kFinishColor + kGhostFragment};
}
ShaderSource depth_shader() {
  return {kDepthVertex, "#version 330 core\nvoid main() {}\n"};
}

}  // namespace twinarm
