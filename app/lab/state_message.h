// The message `state` of docs/lab_protocol.md.
#pragma once

#include <string>
#include <vector>

#include "app/lab/audience.h"
#include "app/lab/knobs/gallery.h"
#include "app/lab/knobs/knobs.h"
#include "app/lab/lab_status.h"

namespace twinarm {

// For all clients alike, but for `you`: addressed() puts that in.
std::string state_message(const LabStatus& status, const Audience::View& audience,
                          const std::vector<Knob>& knobs, const std::vector<GalleryScene>& gallery);
std::string addressed(const std::string& state, ClientId you);

}  // namespace twinarm
