#include "app/trial/pick_and_place.h"

namespace twinarm {
namespace {

double apart_from_above(const Vector3& a, const Vector3& b) {
  return (a - b).head<2>().norm();
}

}  // namespace

void PickAndPlace::tick(double t, const Vector3& gripper, bool closed) {
  const bool closes = closed && !closed_, opens = !closed && closed_;
  closed_ = closed;
  if (placed_) return;
  if (closes && apart_from_above(gripper, object_) <= places_.reach) {
    carried_ = true;
    ++picks_;
    if (picked_ < 0) picked_ = t;
  }
  if (carried_) object_.head<2>() = gripper.head<2>();
  if (!carried_ || !opens) return;
  carried_ = false;
  placed_ = off() <= places_.reach;
  if (placed_)
    done_ = t;
  else
    ++drops_;
}

double PickAndPlace::off() const {
  return apart_from_above(object_, places_.goal);
}

}  // namespace twinarm
