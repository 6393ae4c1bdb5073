// A landscape: the haze takes its ground into the colour of the horizon. With a the distance from the
// middle over the floor's radius: ground = mix(horizon, ground, exp(-(a / 0.35)^2))
uniform vec3 background_bottom, background_ground;

vec3 hazy_ground(float away) {
  return mix(background_bottom, background_ground, exp(-8.16 * away * away));
}
