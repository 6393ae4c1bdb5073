// What the page draws of the contact cases: which coordinate of which body, and what is known of
// it in closed form.
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/analytic/support/contact_scene.h"

namespace twinarm::compare_page {

struct ContactLook {
  std::string_view name;              // of the case
  std::vector<std::string> readings;  // with unit: "height [m]"
  std::vector<double> (*read)(const ContactScene&);
  // Of curve `k` at a time; not a number where it is not known. Curves are readings, or runs.
  double (*exact)(std::size_t k, double t) = nullptr;
  std::vector<std::string> runs{};  // of one reading: a curve each. Empty: the first run
  std::size_t every = 1;            // of so many scenes one is such a run
  double until = HUGE_VAL;          // [s]
  double known_at = NAN;            // the only time at which exact() is known [s]
  bool from_start = false;          // readings count from where they begin
  // What is tried to find a limit, of which a run on either side is drawn; null: no search.
  const char* search = nullptr;
  double step = kStep;             // of the case [s]
  const char* no_steps = nullptr;  // why no error is drawn against the step; null: it is
  const char* about_steps = "";    // what is to be said of that error, where it has no order
};

namespace contact_look {
std::vector<ContactLook> impacts();    // E1, E6, E16, E17
std::vector<ContactLook> sliding();    // E2, E3, E5, E7
std::vector<ContactLook> rolling();    // E4, E8, E9, E10, E12
std::vector<ContactLook> buildings();  // E11, E13, E14
std::vector<ContactLook> engines();    // H1
}  // namespace contact_look

// Null where nothing moves.
const ContactLook* look_of(std::string_view case_name);

}  // namespace twinarm::compare_page
