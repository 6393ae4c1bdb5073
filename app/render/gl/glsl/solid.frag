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
  // Reflection of a bright ceiling, stronger at grazing angles.
  float grazing = 1.0 - max(dot(n, v), 0.0);
  float fresnel = grazing * grazing * grazing * grazing;
  float ceiling = smoothstep(-0.1, 0.9, reflect(-v, n).z) * (0.3 + 0.7 * min(sky, 1.0));
  float gloss = visible * (0.10 * wide + 0.45 * tight) + ceiling * (0.05 + 0.35 * fresnel);
  color_out = finished(paint * light + shininess * gloss);
}
