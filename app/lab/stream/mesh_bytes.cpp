#include "app/lab/stream/mesh_bytes.h"

#include <fmt/format.h>

#include <cstdint>

namespace twinarm {
namespace {

template <class T>
void append_values(std::string& bytes, const std::vector<T>& values) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

// FNV-1a, 64 bits, from a start of its own.
std::uint64_t fnv(const std::string& bytes, std::uint64_t hash) {
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

}  // namespace

std::string mesh_bytes(const DrawMesh& mesh) {
  const std::vector<std::uint32_t> head{static_cast<std::uint32_t>(mesh.positions.size()),
                                        static_cast<std::uint32_t>(3 * mesh.triangles.size()),
                                        (mesh.two_sided ? 1u : 0u) | (mesh.uv.empty() ? 0u : 2u),
                                        0u};
  std::string bytes;
  append_values(bytes, head);
  append_values(bytes, mesh.positions);
  append_values(bytes, mesh.normals);
  append_values(bytes, mesh.uv);
  append_values(bytes, mesh.triangles);
  return bytes;
}

std::string content_name(const std::string& bytes) {
  return fmt::format("{:016x}{:016x}", fnv(bytes, 0xcbf29ce484222325u),
                     fnv(bytes, 0x9ae16a3b2f90404fu));
}

}  // namespace twinarm
