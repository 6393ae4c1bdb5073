// Translucent body: a thin shell, clear in the middle, dense at its silhouette. Blended in linear
// light: the dither noise is scaled by the slope of the canvas's encoding.
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
