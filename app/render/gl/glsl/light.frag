// Light: one key light with a shadow, a sky above, the floor's bounce from below.
//
//   out = colour * (KEY * n.l * visible + SKY * sky(n) + BOUNCE * (1 - n.z) / 2) + gloss
//   sky(n) = (1 + n.z) / 2            the irradiance of an unhidden uniform sky, or
//   sky(n) = 2 * n.d * visible(d)     one direction d of it: with d uniform on the hemisphere its
//                                     mean is the same where nothing hides the sky, and ambient
//                                     occlusion where something does
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
