// One key light with a shadow, sky light from above, bounce light from below.
//
//   out = colour * (KEY * n.l * visible + SKY * sky(n) + BOUNCE * (1 - n.z) / 2) + gloss
//   sky(n) = (1 + n.z) / 2            irradiance of an unoccluded uniform sky, or
//   sky(n) = 2 * n.d * visible(d)     of one direction d; its mean over the hemisphere is the same
//                                     with ambient occlusion
in vec3 p_world, n_world, p_key, p_sky;
uniform vec3 eye, key_direction, sky_direction;
uniform sampler2DShadow sky_shadow;
uniform float texel;
uniform vec2 shadow_reach;  // ends of the used squares of key and sky map

// No shadow at and beyond the border of a map.
vec3 within(vec3 p, float reach) {
  return clamp(p, vec3(2.0 * texel, 2.0 * texel, 0.0), vec3(reach, reach, 1.0));
}

#ifndef KEY_SHADOW
float key_visible() { return 1.0; }
#elif defined(SOFT_SHADOW)
// Lit share of 2 x 2 texels about the point: nine lookups, instead of sixteen by four of the
// sampler.
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
