// Ground of a landscape with haze. With a the distance from the centre over the floor's radius: ground = mix(horizon, ground, exp(-(a / 0.35)^2))
uniform vec3 background_bottom, background_ground;

vec3 hazy_ground(float away) {
  return mix(background_bottom, background_ground, exp(-8.16 * away * away));
}
