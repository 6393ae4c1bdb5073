#include "app/lab/stream/frame_bytes.h"

#include "app/robot/robot_output.h"

namespace twinarm {
namespace {

constexpr std::uint32_t kFrame = 0x31465754, kHistory = 0x31485754;  // "TWF1", "TWH1"
constexpr std::uint16_t kNoBody = 65535;
constexpr std::size_t kPose = 7;      // numbers of a pose
constexpr double kMaxDistance = 1e9;  // [m]

template <class... Values>
void put(std::string& bytes, Values... values) {
  (bytes.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
}
template <class... Arrays>
void put_all(std::string& bytes, const Arrays&... arrays) {  // in this order
  (append_array(bytes, arrays.data(), arrays.size() * sizeof(*arrays.data())), ...);
}

std::uint32_t count_of(std::size_t n) {
  return static_cast<std::uint32_t>(n);
}

bool is_near(const Vector3& v) {
  return v.cwiseAbs().maxCoeff() < kMaxDistance && v.allFinite();
}

constexpr double kSpacing = 1.25;  // offset of variants over the width of the scene
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Residual of the energy balance; NaN without a balance.
double residual_of(const LabFrame& frame, const std::vector<std::string>& rows) {
  const RecordedFrame& recorded = frame.recorded;
  for (std::size_t i = 0; i < std::min(recorded.rows.size(), recorded.works.size()); ++i)
    if (recorded.rows[i] < rows.size() && rows[recorded.rows[i]] == kNumericalRow)
      return recorded.works[i];
  return kNone;
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

void put_poses(const std::vector<Pose>& X_WL, std::size_t first, std::size_t end,
               std::vector<float>& poses) {
  for (std::size_t i = first; i < end; ++i) {
    const Eigen::Quaterniond rotation(X_WL[i].R);
    const Vector3& p = X_WL[i].p;
    std::size_t at = kPose * i;
    for (const double value :
         {p.x(), p.y(), p.z(), rotation.x(), rotation.y(), rotation.z(), rotation.w()})
      poses[at++] = static_cast<float>(value);
  }
}

std::string frame_bytes(const FrameColumns& frame) {
  std::string bytes;
  bytes.reserve(256 + 8 * (frame.channels.size() + frame.works.size()) + 48 * frame.body.size() +
                20 * frame.text_end.size() + frame.text.size() + 8 * frame.first.size() +
                8 * frame.link.size());
  put(bytes, kFrame, frame.scene, frame.time, frame.stamp, frame.age, frame.step, frame.number,
      frame.flags);
  for (const std::size_t count :
       {frame.channels.size(), frame.works.size(), frame.first.size() - 1, frame.body.size(),
        frame.text_end.size(), frame.text.size(), frame.link.size() / kPose, std::size_t{0}})
    put(bytes, count_of(count));
  const InstanceColumns& instances = frame.instances;
  put_all(bytes, frame.channels, frame.works, frame.link, frame.target, instances.position,
          instances.scale, instances.turn, frame.labels.position, frame.labels.offset,
          frame.text_end, frame.first, frame.first_label, instances.mesh, frame.body,
          instances.color, instances.flags, instances.shininess, instances.texture, frame.text);
  return bytes;
}

std::string history_bytes(const HistoryColumns& history) {
  std::string bytes;
  bytes.reserve(32 + 8 * (history.time.size() + history.channels.size() + history.works.size()));
  put(bytes, kHistory);
  for (const std::uint32_t number : {history.scene, count_of(history.time.size()),
                                     history.channel_count, history.row_count, std::uint32_t{0}})
    put(bytes, number);
  put_all(bytes, history.time, history.channels, history.works);
  return bytes;
}

VariantViews::VariantViews(ViewVariants variants, const SimulateInput& input, LabChannels& channels)
    : set_(std::move(variants.set)) {
  change(std::move(variants.plans));
  if (set_.empty()) return;
  const Coordinates& coordinates = input.robot.coordinates;
  for (const NamedJoint& joint : coordinates.all())
    if (joint.components().size() == 1) joints_.push_back(joint);
  first_channel_ = channels.all().size();
  for (const std::string& name : set_.values) {
    const auto add = [&](const std::string& quantity, const char* unit) {
      channels.add("variant/" + quantity + "/" + name, unit, "variant", name);
    };
    for (const NamedJoint& joint : joints_) {
      const JointComponent component = joint.components().front();
      add("q/" + component_name(coordinates, joint, component), component.unit());
    }
    add("total_energy", "J");
    add("numerical", "J");
  }
}

void VariantViews::change(std::vector<std::shared_ptr<const SimulatePlan>> plans) {
  snapshots_.resize(plans.size());
  for (std::size_t i = 0; i < plans.size(); ++i) {
    if (snapshots_[i])
      snapshots_[i]->change(*plans[i]);
    else
      snapshots_[i] = std::make_unique<LabSnapshots>(*plans[i]);
  }
  plans_ = std::move(plans);  // last: until here the old ones are referred to
}

// By default along the narrower side.
void VariantViews::place(const Extent& start, Extent& extent) {
  if (set_.empty() || start.empty()) return;
  const Vector3 size = extent.high() - extent.low();
  const int axis = size.x() < size.y() ? 0 : 1;
  apart_ = set_.apart.value_or(kSpacing * size[axis] * Vector3::Unit(axis));
  above_ = Vector3(extent.center().x(), extent.center().y(), start.high().z());
  const std::vector<Vector3> points = extent.points();
  for (std::size_t variant = 1; variant < set_.values.size(); ++variant)
    for (const Vector3& p : points) extent.add(p + static_cast<double>(variant) * apart_);
}

void VariantViews::look(const LabFrame& frame) {
  seen_.clear();
  for (std::size_t i = 0; i < std::min(snapshots_.size(), frame.variants.size()); ++i)
    seen_.push_back({snapshots_[i]->of(*frame.variants[i].frame), frame.variants[i]});
}

void VariantViews::show(const LabFrame* before, Snapshot& snapshot) const {
  for (std::size_t variant = 0; variant < (set_.empty() ? 0 : seen_.size() + 1); ++variant) {
    ShownVariant shown;
    shown.name = set_.values[variant];
    shown.offset_W = static_cast<double>(variant) * apart_;
    shown.above_W = above_ + shown.offset_W;
    if (variant > 0) {
      const Seen& seen = seen_[variant - 1];
      shown.X_WL = seen.snapshot.k.X_WL;
      if (before && variant - 1 < before->variants.size())
        shown.before = snapshots_[variant - 1]->poses(*before->variants[variant - 1].frame);
      if (seen.frame.stopped)
        shown.name += fmt::format(": stopped at {:.4g} s", seen.frame.frame->recorded.t);
    }
    snapshot.variants.push_back(std::move(shown));
  }
}

void VariantViews::values(const LabFrame& frame, const Snapshot& run,
                          const std::vector<std::string>& rows, std::vector<double>& values) const {
  std::size_t at = first_channel_;
  for (std::size_t variant = 0; variant < set_.values.size(); ++variant) {
    const Seen* other = variant > 0 && variant <= seen_.size() ? &seen_[variant - 1] : nullptr;
    if (other && other->frame.stopped) other = nullptr;
    const Snapshot* snapshot = variant == 0 ? &run : other ? &other->snapshot : nullptr;
    const LabFrame* own = variant == 0 ? &frame : other ? other->frame.frame.get() : nullptr;
    for (const NamedJoint& joint : joints_)
      values[at++] = snapshot ? coordinates_of(joint, snapshot->x).front() : kNone;
    values[at++] = snapshot ? snapshot->kinetic + snapshot->potential + snapshot->elastic : kNone;
    values[at++] = own ? residual_of(*own, rows) : kNone;
  }
}

}  // namespace twinarm
