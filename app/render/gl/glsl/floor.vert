// Corners of a square from the vertex number; ground = (centre x, y, height, half side).
uniform vec4 ground;

void main() {
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  place(vec3(ground.xy + ground.w * corner, ground.z), vec3(0.0, 0.0, 1.0));
}
