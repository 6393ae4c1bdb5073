// Serialization of internal state besides q and qd: held forces, stick anchors, initial guesses of
// impulses, substep sizes. Required for bit-exact restarts.
//
// Each owner visits its fields in serialize(). A default-constructed archive appends them as bytes,
// one constructed from bytes reads them. Little-endian; sizes precede vectors.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "solver/spatial/pose.h"

namespace twinarm {

class StateArchive {
 public:
  StateArchive() = default;  // writes
  explicit StateArchive(std::string bytes) : bytes_(std::move(bytes)), reads_(true) {}
  bool reads() const { return reads_; }
  const std::string& bytes() const { return bytes_; }
  bool at_end() const { return at_ == bytes_.size(); }
  void reserve(std::size_t bytes) { bytes_.reserve(bytes); }

  // All throw std::runtime_error if too few bytes are left to read.
  template <class T>
  void visit(T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>, "field by field: no padding");
    static_assert(std::endian::native == std::endian::little);
    if (!reads_) {
      bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
      return;
    }
    need(sizeof value);
    if constexpr (std::is_same_v<T, bool>)
      value = bytes_[at_] != 0;  // bool has two valid bytes only
    else
      std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
  }
  void visit(Vector3& v) { visit_numbers(v.data(), 3); }
  template <class T>
  void visit(std::vector<T>& values) {
    resize(values, sizeof(T));
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>)
      visit_numbers(values.data(), values.size());
    else
      for (T& value : values) visit(value);
  }
  template <class T, std::size_t N>
  void visit(std::array<T, N>& values) {
    for (T& value : values) visit(value);
  }
  void visit(std::vector<std::string>& texts) {
    resize(texts, sizeof(std::uint64_t));
    for (std::string& text : texts) visit(text);
  }
  template <class First, class Second, class... Rest>
  void visit(First& first, Second& second, Rest&... rest) {
    visit(first), visit(second), (visit(rest), ...);
  }
  // Vector whose size is given by the scene.
  template <class T>
  void visit_fixed(std::vector<T>& values) {
    const std::size_t size = values.size();
    visit(values);
    if (values.size() != size) of_another_scene();
  }
  // Index below `count`.
  template <class T>
  void visit_index(T& index, std::size_t count) {
    visit(index);
    if (!std::in_range<std::size_t>(index) || static_cast<std::size_t>(index) >= count)
      of_another_scene();
  }
  void visit(std::string& text) {
    std::uint64_t size = text.size();
    visit(size);
    if (reads_) {
      need(size);
      text = bytes_.substr(at_, size);
      at_ += size;
    } else {
      bytes_ += text;
    }
  }
  // Size of a vector whose elements the caller visits, each of at least `min_bytes` bytes.
  template <class T>
  void resize(std::vector<T>& values, std::size_t min_bytes) {
    std::uint64_t size = values.size();
    visit(size);
    if (!reads_) return;
    if (size > (bytes_.size() - at_) / min_bytes) of_another_scene();
    values.resize(size);
  }

 private:
  template <class T>
  void visit_numbers(T* values, std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (!reads_) {
      bytes_.append(reinterpret_cast<const char*>(values), bytes);
      return;
    }
    need(bytes);
    std::copy_n(bytes_.data() + at_, bytes, reinterpret_cast<char*>(values));
    at_ += bytes;
  }
  void need(std::size_t bytes) const {
    if (bytes > bytes_.size() - at_) of_another_scene();
  }
  [[noreturn]] static void of_another_scene() {
    throw std::runtime_error("state data is truncated or belongs to another scene");
  }
  std::string bytes_;
  std::size_t at_ = 0;
  bool reads_ = false;
};

// The bytes of a value that has serialize(StateArchive&, T&), and the value of such bytes; empty if
// they are not those of a T.
template <class T>
std::string packed(T value) {
  StateArchive archive;
  serialize(archive, value);
  return archive.bytes();
}
template <class T>
std::optional<T> unpacked(std::string bytes) {
  StateArchive archive(std::move(bytes));
  T value;
  try {
    serialize(archive, value);
  } catch (const std::runtime_error&) {  // truncated
    return std::nullopt;
  }
  return archive.at_end() ? std::optional(std::move(value)) : std::nullopt;
}

}  // namespace twinarm
