// The normal offset moves the lookup point off the surface, against self-shadowing.
uniform mat4 clip_from_world, key_from_world, sky_from_world;
uniform float normal_offset;
out vec3 p_world, n_world, p_key, p_sky;
invariant gl_Position;  // both passes of a translucent body give the same bits

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
