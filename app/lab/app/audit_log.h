// Who changed what, on stderr: one line for each command that changes the run or who has control.
//
// At most twenty lines at once and one a second (30 MB a day); those left out are counted in the
// next. The movements of a drag are one line a minute.
#pragma once

#include <string>

#include "app/lab/server/rate_limiter.h"

namespace twinarm {

class AuditLog {
 public:
  using Time = RateLimiter::Time;

  // Never blocks.
  void add(const std::string& client, const std::string& change, bool is_movement);
  // The line; empty: none.
  std::string line(const std::string& client, const std::string& change, bool is_movement,
                   Time now);

 private:
  RateLimiter lines_;
  std::string movement_;  // the last one
  Time moved_at_{};
  long left_out_ = 0;
};

}  // namespace twinarm
