// One triangle over the whole picture, at maximum depth.
uniform mat4 world_from_clip;
uniform vec3 eye;
out vec3 line_of_sight;
void main() {
  vec2 corner = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2) * 2.0 - 1.0;
  gl_Position = vec4(corner, 1.0, 1.0);
  vec4 far_away = world_from_clip * gl_Position;  // linear over the picture
  line_of_sight = far_away.xyz / far_away.w - eye;
}
