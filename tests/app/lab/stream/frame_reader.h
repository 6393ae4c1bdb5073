// Decoder of frames, written from the table in docs/reference/lab_protocol.md.
#pragma once

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace twinarm {

template <class T>
T value_at(const std::string& bytes, std::size_t at) {
  REQUIRE(at + sizeof(T) <= bytes.size());
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

struct ReadFrame {
  std::uint32_t magic, scene, number, flags;
  double time, stamp, age;
  std::uint64_t step;
  std::vector<double> channels, works;
  std::vector<float> link, target, position, scale, label_position;
  std::vector<std::int16_t> turn, label_offset;
  std::vector<std::uint32_t> text_end, first, first_label;
  std::vector<std::uint16_t> mesh, body;
  std::vector<std::uint8_t> color, flag, shininess, texture;
  std::string text;
  std::size_t end = 0;  // where the last array ends

  explicit ReadFrame(const std::string& bytes)
      : magic(value_at<std::uint32_t>(bytes, 0)),
        scene(value_at<std::uint32_t>(bytes, 4)),
        number(value_at<std::uint32_t>(bytes, 40)),
        flags(value_at<std::uint32_t>(bytes, 44)),
        time(value_at<double>(bytes, 8)),
        stamp(value_at<double>(bytes, 16)),
        age(value_at<double>(bytes, 24)),
        step(value_at<std::uint64_t>(bytes, 32)) {
    const auto count = [&](std::size_t at) {
      return std::size_t{value_at<std::uint32_t>(bytes, at)};
    };
    const std::size_t C = count(48), R = count(52), L = count(56), N = count(60), M = count(64),
                      B = count(68), P = count(72);
    CHECK(count(76) == 0);
    end = 80;
    take(bytes, C, channels);
    take(bytes, R, works);
    take(bytes, 7 * P, link);
    take(bytes, 7 * P, target);
    take(bytes, 3 * N, position);
    take(bytes, 3 * N, scale);
    take(bytes, 4 * N, turn);
    take(bytes, 3 * M, label_position);
    take(bytes, 2 * M, label_offset);
    take(bytes, M, text_end);
    take(bytes, L + 1, first);
    take(bytes, L + 1, first_label);
    take(bytes, N, mesh);
    take(bytes, N, body);
    take(bytes, 4 * N, color);
    take(bytes, N, flag);
    take(bytes, N, shininess);
    take(bytes, N, texture);
    end = (end + 7) / 8 * 8;
    REQUIRE(end + B <= bytes.size());
    text = bytes.substr(end, B);
    end += B;
  }
  // Pose of a body in `link` or `target`: x y z, quaternion x y z w.
  static std::array<float, 7> pose(const std::vector<float>& poses, std::size_t body) {
    std::array<float, 7> pose{};
    for (std::size_t c = 0; c < 7; ++c) pose[c] = poses.at(7 * body + c);
    return pose;
  }
  std::size_t instances() const { return body.size(); }
  std::string label(std::size_t m) const {
    const std::size_t from = m == 0 ? 0 : text_end[m - 1];
    return text.substr(from, text_end[m] - from);
  }
  // First and one past the last of a layer.
  std::pair<std::size_t, std::size_t> layer(std::size_t l) const {
    return {first[l], first[l + 1]};
  }
  std::vector<std::string> labels_of(std::size_t l) const {
    std::vector<std::string> texts;
    for (std::size_t m = first_label[l]; m < first_label[l + 1]; ++m) texts.push_back(label(m));
    return texts;
  }

 private:
  template <class T>
  void take(const std::string& bytes, std::size_t count, std::vector<T>& values) {
    end = (end + 7) / 8 * 8;
    for (std::size_t i = 0; i < count; ++i)
      values.push_back(value_at<T>(bytes, end + i * sizeof(T)));
    end += count * sizeof(T);
  }
};

// Texts at a key of the objects in a list of a JSON message; empty key: texts in the list.
inline std::vector<std::string> texts_in(const std::string& json, const std::string& list,
                                         const std::string& key) {
  const std::size_t begin = json.find("\"" + list + "\": [");
  REQUIRE_MESSAGE(begin != std::string::npos, list);
  std::size_t at = begin + list.size() + 5, end = at;
  for (int depth = 1; depth > 0; ++end) {
    REQUIRE(end < json.size());
    depth += json[end] == '[' ? 1 : json[end] == ']' ? -1 : 0;
  }
  std::vector<std::string> found;
  const std::string before = key.empty() ? "\"" : "\"" + key + "\": \"";
  while ((at = json.find(before, at)) < end) {
    at += before.size();
    const std::size_t stop = json.find('"', at);
    found.push_back(json.substr(at, stop - at));
    at = stop + 1;
  }
  return found;
}

}  // namespace twinarm
