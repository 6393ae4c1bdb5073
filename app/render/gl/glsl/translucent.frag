// A ghost is a thin shell: clear where it is looked through, dense at its silhouette. It is blended
// in linear light: the canvas encodes, and the noise is that much smaller where its slope is
// larger.
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
