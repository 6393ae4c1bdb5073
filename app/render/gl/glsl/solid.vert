layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 world_from_mesh;
uniform mat3 normal_from_mesh;
#ifdef TEXTURED
layout(location = 2) in vec2 uv;
out vec2 uv_picture;
#endif

void main() {
#ifdef TEXTURED
  uv_picture = uv;
#endif
  place((world_from_mesh * vec4(position, 1.0)).xyz, normal_from_mesh * normal);
}
