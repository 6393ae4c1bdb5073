// A room: where fully lit, the floor has the colour of the background.
uniform vec3 background_bottom, background_top;
uniform float per_height;

vec3 room() {
  return mix(background_bottom, background_top, smoothstep(0.05, 1.0, gl_FragCoord.y * per_height));
}
