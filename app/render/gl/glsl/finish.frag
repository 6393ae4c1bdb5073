// sRGB by a polynomial of degree 4 in the square root: within 0.2 steps of eight bits above 0.004,
// up to 2.2 steps too dark below. Dither noise of half a step avoids banding; it is a fixed function
// of the pixel.
out vec4 color_out;

float pixel_noise() {
  return fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
}

vec4 finished(vec3 c) {
  vec3 s = sqrt(max(c, 0.0));
  vec3 encoded =
      s * (s * (s * (s * -0.2878565 + 0.7938828) - 0.9078319) + 1.4372536) - 0.0361004;
  return vec4(encoded + pixel_noise() / 255.0, 1.0);
}
