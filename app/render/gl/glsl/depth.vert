layout(location = 0) in vec3 position;
uniform mat4 world_from_mesh, clip_from_world;
void main() { gl_Position = clip_from_world * (world_from_mesh * vec4(position, 1.0)); }
