// Grid lines as box-filtered stripes: share of the pixel's footprint that the line covers, which
// avoids moire.
uniform vec4 ground;
uniform vec4 grid;      // thin cell, strong cell, half width of a line [m]
uniform vec4 per_grid;  // reciprocals: cells, ground.w, share of it where the grid has faded

float line_cover(float cell, float per_cell, float half_width, vec2 footprint, vec2 per_footprint) {
  vec2 half_line = max(vec2(half_width), 0.5 * footprint);   // at least a pixel wide,
  vec2 dim = min(vec2(1.0), 2.0 * half_width * per_footprint);  // dimmer if thinner
  vec2 off = abs(fract(p_world.xy * per_cell + 0.5) - 0.5) * cell;  // to the nearest line
  vec2 cover = clamp((half_line - off) * per_footprint + 0.5, 0.0, 1.0);
  cover *= 0.55 + 0.45 * dim;
  cover *= 1.0 - smoothstep(0.15, 0.5, footprint * per_cell);
  return max(cover.x, cover.y);
}

void main() {
  float away = length(p_world.xy - ground.xy) * per_grid.z;
  float near = 1.0 - smoothstep(0.25, 0.95, away * per_grid.w);
  float light = mix(1.0, 0.50 * key_visible() + 0.50 * sky_light(vec3(0.0, 0.0, 1.0)),
                    1.0 - smoothstep(0.7, 0.95, away));
  vec2 footprint = fwidth(p_world.xy), per_footprint = 1.0 / max(footprint, 1e-9);
  float cover = max(0.22 * line_cover(grid.x, per_grid.x, grid.z, footprint, per_footprint),
                    0.42 * line_cover(grid.y, per_grid.y, 1.6 * grid.z, footprint, per_footprint));
  vec3 shade = mix(vec3(0.80, 0.90, 1.04), vec3(1.0), light) * light;  // shadows a little blue
#ifdef HORIZON
  vec3 paint = hazy_ground(away);
#else
  vec3 paint = room();
#endif
  color_out = finished(paint * shade * (1.0 - near * cover));
}
