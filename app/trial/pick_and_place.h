// A task for a person: bring an object from one place of the table to another.
//
// It is told from above: the gripper takes the object where the button is pressed within `reach` of
// it, carries it while the button is held, and has placed it where it is let go within `reach` of
// the goal. Let go elsewhere, it lies there. The object has no mass: what is measured is how well
// the robot goes where the hand wants it.
#pragma once

#include "solver/spatial/pose.h"

namespace twinarm {

class PickAndPlace {
 public:
  struct Places {
    Vector3 object{0.42, 0.28, 0}, goal{0.42, -0.28, 0};  // world [m]; z is not looked at
    double reach = 0.03;                                  // [m]
  };
  explicit PickAndPlace(const Places& places) : places_(places), object_(places.object) {}

  // Once a tick, at its time [s]: where the gripper is, and whether it is closed.
  void tick(double t, const Vector3& gripper, bool closed);

  const Vector3& object() const { return object_; }
  const Places& places() const { return places_; }
  bool is_carried() const { return carried_; }
  bool is_placed() const { return placed_; }
  int picks() const { return picks_; }
  int drops() const { return drops_; }          // beside the goal
  double picked_at() const { return picked_; }  // for the first time [s]; negative: never
  double placed_at() const { return done_; }    // likewise
  double off() const;                           // the object from the goal [m]

 private:
  Places places_;
  Vector3 object_;
  bool carried_ = false, placed_ = false, closed_ = false;
  int picks_ = 0, drops_ = 0;
  double picked_ = -1, done_ = -1;
};

}  // namespace twinarm
