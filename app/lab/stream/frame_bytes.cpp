#include "app/lab/stream/frame_bytes.h"

#include <Eigen/Geometry>
#include <utility>

namespace twinarm {
namespace {

constexpr std::uint32_t kFrame = 0x31465754, kHistory = 0x31485754;  // "TWF1", "TWH1"
constexpr std::uint16_t kNoBody = 65535;
constexpr std::size_t kPlace = 7;  // numbers of a body's place
constexpr double kFarthest = 1e9;  // [m]: a run that flies apart

class Block {
 public:
  template <class T>
  void put(T value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class Values>
  void put_all(const Values& values) {
    append_array(bytes_, values.data(), values.size() * sizeof(*values.data()));
  }
  void reserve(std::size_t size) { bytes_.reserve(size); }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

std::uint32_t count_of(std::size_t n) {
  return static_cast<std::uint32_t>(n);
}

bool is_near(const Vector3& v) {
  return v.cwiseAbs().maxCoeff() < kFarthest && v.allFinite();
}

}  // namespace

void FrameColumns::clear_entries() {
  InstanceColumns::each(instances, [](const char*, auto& column) { column.clear(); });
  body.clear();
  labels.position.clear();
  labels.offset.clear();
  text_end.clear();
  text.clear();
  first.assign(1, 0);
  first_label.assign(1, 0);
}

void FrameColumns::end_layer() {
  first.push_back(count_of(body.size()));
  first_label.push_back(count_of(text_end.size()));
}

void FrameColumns::add(const Instance& instance) {
  if (!is_near(instance.X_WM.p) || !is_near(instance.scale) || !instance.X_WM.R.allFinite()) return;
  instances.add(instance);
  body.push_back(instance.body < 0 ? kNoBody : static_cast<std::uint16_t>(instance.body));
}

void FrameColumns::add(const Label& label) {
  if (!is_near(label.p_W) || !labels.add(label)) return;
  text += label.text;
  text_end.push_back(count_of(text.size()));
}

void put_places(const std::vector<Pose>& X_WL, std::size_t first, std::size_t end,
                std::vector<float>& places) {
  for (std::size_t i = first; i < end; ++i) {
    const Eigen::Quaterniond turn(X_WL[i].R);
    const Vector3& p = X_WL[i].p;
    std::size_t at = kPlace * i;
    for (const double value : {p.x(), p.y(), p.z(), turn.x(), turn.y(), turn.z(), turn.w()})
      places[at++] = static_cast<float>(value);
  }
}

std::string frame_bytes(const FrameColumns& frame) {
  Block block;
  block.reserve(256 + 8 * (frame.channels.size() + frame.works.size()) + 48 * frame.body.size() +
                20 * frame.text_end.size() + frame.text.size() + 8 * frame.first.size() +
                8 * frame.link.size());
  block.put(kFrame);
  block.put(frame.scene);
  block.put(frame.time);
  block.put(frame.stamp);
  block.put(frame.age);
  block.put(frame.step);
  block.put(frame.number);
  block.put(frame.flags);
  for (const std::size_t count :
       {frame.channels.size(), frame.works.size(), frame.first.size() - 1, frame.body.size(),
        frame.text_end.size(), frame.text.size(), frame.link.size() / kPlace, std::size_t{0}})
    block.put(count_of(count));
  block.put_all(frame.channels);
  block.put_all(frame.works);
  block.put_all(frame.link);
  block.put_all(frame.twin);
  block.put_all(frame.instances.position);
  block.put_all(frame.instances.scale);
  block.put_all(frame.instances.turn);
  block.put_all(frame.labels.position);
  block.put_all(frame.labels.offset);
  block.put_all(frame.text_end);
  block.put_all(frame.first);
  block.put_all(frame.first_label);
  block.put_all(frame.instances.mesh);
  block.put_all(frame.body);
  block.put_all(frame.instances.color);
  block.put_all(frame.instances.flags);
  block.put_all(frame.instances.shininess);
  block.put_all(frame.instances.texture);
  block.put_all(frame.text);
  return block.take();
}

std::string history_bytes(const HistoryColumns& history) {
  Block block;
  block.reserve(32 + 8 * (history.time.size() + history.channels.size() + history.works.size()));
  block.put(kHistory);
  for (const std::uint32_t number : {history.scene, count_of(history.time.size()),
                                     history.channel_count, history.row_count, std::uint32_t{0}})
    block.put(number);
  block.put_all(history.time);
  block.put_all(history.channels);
  block.put_all(history.works);
  return block.take();
}

}  // namespace twinarm
