// A room: its floor takes the background's colour wherever it is fully lit, so that no horizon is
// seen. It is there by its shadows and its grid.
uniform vec3 background_bottom, background_top;
uniform float per_height;

vec3 room() {
  return mix(background_bottom, background_top, smoothstep(0.05, 1.0, gl_FragCoord.y * per_height));
}
