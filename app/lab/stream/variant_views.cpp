#include "app/lab/stream/variant_views.h"

#include <fmt/format.h>

#include <limits>

#include "app/accounting/energy_balance.h"
#include "app/robot/robot_output.h"

namespace twinarm {
namespace {

constexpr double kRoom = 1.25;  // from one lane to the next, over the width of the scene
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double energy_of(const Moment& moment) {
  return moment.kinetic + moment.potential + moment.elastic;
}

// What the method has made or lost since the ledger began; without a ledger unknown.
double numerical_work(const LabFrame& frame, const std::vector<std::string>& rows) {
  const RecordedFrame& recorded = frame.recorded;
  for (std::size_t i = 0; i < std::min(recorded.rows.size(), recorded.works.size()); ++i)
    if (recorded.rows[i] < rows.size() && rows[recorded.rows[i]] == kNumericalRow)
      return recorded.works[i];
  return kNone;
}

}  // namespace

LaneViews::LaneViews(ViewLanes lanes, const SimulateInput& input, LabChannels& channels)
    : set_(std::move(lanes.set)) {
  change(std::move(lanes.plans));
  if (set_.empty()) return;
  const Coordinates& coordinates = input.robot.coordinates;
  for (const NamedJoint& joint : coordinates.all())
    if (joint.components().size() == 1) joints_.push_back(joint);
  first_channel_ = channels.all().size();
  for (const std::string& name : set_.values) {
    const auto add = [&](const std::string& quantity, const char* unit) {
      channels.add("lane/" + quantity + "/" + name, unit, "lane", name);
    };
    for (const NamedJoint& joint : joints_) {
      const JointComponent component = joint.components().front();
      add("q/" + component_name(coordinates, joint, component), component.unit());
    }
    add("total_energy", "J");
    add("numerical", "J");
  }
}

void LaneViews::change(std::vector<std::shared_ptr<const SimulatePlan>> plans) {
  moments_.resize(plans.size());
  for (std::size_t i = 0; i < plans.size(); ++i) {
    if (moments_[i])
      moments_[i]->change(*plans[i]);
    else
      moments_[i] = std::make_unique<LabMoments>(*plans[i]);
  }
  plans_ = std::move(plans);  // the old ones go when nothing looks at them any more
}

// Along the narrower side, where nobody says otherwise.
void LaneViews::place(const Extent& start, Extent& extent) {
  if (set_.empty() || start.empty()) return;
  const Vector3 size = extent.high() - extent.low();
  const int axis = size.x() < size.y() ? 0 : 1;
  apart_ = set_.apart.value_or(kRoom * size[axis] * Vector3::Unit(axis));
  above_ = Vector3(extent.center().x(), extent.center().y(), start.high().z());
  const std::vector<Vector3> points = extent.points();
  for (std::size_t lane = 1; lane < set_.values.size(); ++lane)
    for (const Vector3& p : points) extent.add(p + static_cast<double>(lane) * apart_);
}

void LaneViews::look(const LabFrame& frame) {
  seen_.clear();
  for (std::size_t i = 0; i < std::min(moments_.size(), frame.lanes.size()); ++i)
    seen_.push_back({moments_[i]->of(*frame.lanes[i].frame), frame.lanes[i]});
}

void LaneViews::show(const LabFrame* before, Moment& moment) const {
  for (std::size_t lane = 0; lane < (set_.empty() ? 0 : seen_.size() + 1); ++lane) {
    ShownLane shown;
    shown.name = set_.values[lane];
    shown.offset_W = static_cast<double>(lane) * apart_;
    shown.above_W = above_ + shown.offset_W;
    if (lane > 0) {
      const Seen& seen = seen_[lane - 1];
      shown.X_WL = seen.moment.k.X_WL;
      if (before && lane - 1 < before->lanes.size())
        shown.before = moments_[lane - 1]->places(*before->lanes[lane - 1].frame);
      if (seen.frame.stopped)
        shown.name += fmt::format(": stopped at {:.4g} s", seen.frame.frame->recorded.t);
    }
    moment.lanes.push_back(std::move(shown));
  }
}

void LaneViews::values(const LabFrame& frame, const Moment& run,
                       const std::vector<std::string>& rows, std::vector<double>& values) const {
  std::size_t at = first_channel_;
  for (std::size_t lane = 0; lane < set_.values.size(); ++lane) {
    const bool is_known = lane == 0 || (lane <= seen_.size() && !seen_[lane - 1].frame.stopped);
    const Moment* moment = lane == 0 ? &run : is_known ? &seen_[lane - 1].moment : nullptr;
    for (const NamedJoint& joint : joints_)
      values[at++] = moment ? coordinates_of(joint, moment->x).front() : kNone;
    values[at++] = moment ? energy_of(*moment) : kNone;
    const LabFrame* own = lane == 0  ? &frame
                          : is_known ? seen_[lane - 1].frame.frame.get()
                                     : nullptr;
    values[at++] = own ? numerical_work(*own, rows) : kNone;
  }
}

}  // namespace twinarm
