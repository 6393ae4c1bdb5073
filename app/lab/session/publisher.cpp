#include "app/lab/session/publisher.h"

#include <utility>

namespace twinarm {

LabNow Publisher::now() const {
  const std::lock_guard lock(mutex_);
  LabNow now = now_;
  now.wakes = wakes_;
  return now;
}

void Publisher::wait(const LabNow& seen, double longest) const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, std::chrono::duration<double>(longest),
                    [&] { return now_.number != seen.number || wakes_ != seen.wakes; });
}

void Publisher::wake() {
  {
    const std::lock_guard lock(mutex_);
    ++wakes_;
  }
  changed_.notify_all();
}

void Publisher::publish(LabNow now) {
  {
    const std::lock_guard lock(mutex_);
    now.number = now_.number + 1;
    if (!now.status) now.status = now_.status;
    now_ = std::move(now);
  }
  changed_.notify_all();
}

}  // namespace twinarm
