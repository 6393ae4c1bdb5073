// Sky of a landscape. With e the sine of the elevation:
// sky = mix(zenith, horizon, (1 - e)^5)
in vec3 line_of_sight;
uniform vec3 background_bottom, background_top;

void main() {
  float low = 1.0 - clamp(normalize(line_of_sight).z, 0.0, 1.0), square = low * low;
  color_out = finished(mix(background_top, background_bottom, square * square * low));
}
