// Each vector as its count and its elements, in one order for both ways.
#include "collision/mesh_files/model_serialization.h"

#include <cstring>
#include <type_traits>

namespace twinarm {
namespace {

class Packer {
 public:
  std::string bytes;

  template <class T>
  bool operator()(const T& x) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes.append(reinterpret_cast<const char*>(&x), sizeof x);
    return true;
  }
  template <class T>
  bool all(const T& elements) {  // a vector or a string
    (*this)(static_cast<std::uint64_t>(elements.size()));
    bytes.append(reinterpret_cast<const char*>(elements.data()),
                 elements.size() * sizeof(*elements.data()));
    return true;
  }
  template <class T, class Each>
  bool list(const std::vector<T>& elements, Each each) {
    (*this)(static_cast<std::uint64_t>(elements.size()));
    for (const T& one : elements) each(one);
    return true;
  }
};

// False, from then on, where the bytes end too early.
class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : left_(bytes) {}
  bool at_end() const { return left_.empty(); }

  template <class T>
  bool operator()(T& x) {
    if (left_.size() < sizeof x) return false;
    std::memcpy(&x, left_.data(), sizeof x);
    left_.remove_prefix(sizeof x);
    return true;
  }
  template <class T>
  bool all(T& elements) {
    std::uint64_t count = 0;
    constexpr std::size_t size = sizeof(*elements.data());
    if (!(*this)(count) || count > left_.size() / size) return false;
    elements.resize(count);
    if (count > 0) std::memcpy(elements.data(), left_.data(), count * size);
    left_.remove_prefix(count * size);
    return true;
  }
  template <class T, class Each>
  bool list(std::vector<T>& elements, Each each) {
    std::uint64_t count = 0;
    if (!(*this)(count) || count > left_.size()) return false;  // each takes a byte at least
    elements.resize(count);
    for (T& one : elements)
      if (!each(one)) return false;
    return true;
  }

 private:
  std::string_view left_;
};

// The one order of all fields; `Model` is const for the packer.
template <class Way, class Model>
bool visit_model(Way& way, Model& model) {
  return way.list(model.parts, [&](auto& part) {
    return way.all(part.positions) && way.all(part.uv) && way.all(part.triangles) &&
           way(part.has_color) && way(part.color) && way(part.texture);
  }) && way.list(model.textures, [&](auto& texture) {
    return way.all(texture.name) && way.all(texture.bytes);
  }) && way.list(model.notes, [&](auto& note) { return way.all(note); });
}

}  // namespace

std::string pack(const ModelFile& model) {
  Packer packer;
  visit_model(packer, model);
  return std::move(packer.bytes);
}

std::optional<ModelFile> unpack_model(std::string_view bytes) {
  Unpacker unpacker(bytes);
  ModelFile model;
  if (!visit_model(unpacker, model) || !unpacker.at_end()) return std::nullopt;
  return model;
}

}  // namespace twinarm
