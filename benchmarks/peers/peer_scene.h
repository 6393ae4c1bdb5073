// A scene in plain numbers, so that every engine gets the same one and converts it itself. No
// engine's types, none of ours, and C++17: Simbody's headers know no later one.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace twinarm::peers {

using Numbers3 = std::array<double, 3>;
using Numbers4 = std::array<double, 4>;  // a quaternion w, x, y, z

enum class Joint {
  hinge,  // about z of the body: q an angle, v its rate
  ball,   // q the quaternion body to parent, v the angular velocity in body axes
  free    // q place and quaternion, v angular velocity in body axes and velocity in world axes
};
enum class Form { none, sphere, box };

// Its joint stands at `position` in the parent, `turn` takes body axes to the parent's at q = 0.
struct Body {
  int parent = -1;  // the number of another body, before this one; -1: the world
  Joint joint = Joint::free;
  Numbers3 position{};
  Numbers4 turn{1, 0, 0, 0};
  double mass = 1;
  Numbers3 com{};                   // from the joint, body axes [m]
  std::array<double, 6> inertia{};  // xx, yy, zz, xy, xz, yz about the com [kg m^2]
  Form form = Form::none;           // about the body's origin, which then is its com
  Numbers3 half{};                  // radius of a sphere three times, half edges of a box [m]
  Numbers3 push{};                  // a constant force at the com, world axes [N]
};

struct Scene {
  std::string name;
  Numbers3 gravity{0, 0, -9.81};
  std::vector<Body> bodies;
  std::vector<double> q, v;                 // at the start, body by body as Joint says
  bool floor = false;                       // z = 0
  double floor_friction = 0, friction = 0;  // of a body with the floor; of two bodies
  double restitution = 0;                   // of every pair
  bool uncorrected = false;  // overlaps are not pushed apart where an engine can be told so

  bool has_contacts() const { return floor; }
};

inline int coordinates_of(Joint joint) {
  return joint == Joint::hinge ? 1 : joint == Joint::ball ? 4 : 7;
}
inline int velocities_of(Joint joint) {
  return joint == Joint::hinge ? 1 : joint == Joint::ball ? 3 : 6;
}

}  // namespace twinarm::peers
