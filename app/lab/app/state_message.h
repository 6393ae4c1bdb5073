// The message `state` of docs/lab_protocol.md.
#pragma once

#include <string>
#include <vector>

#include "app/lab/app/clients.h"
#include "app/lab/parameters/gallery.h"
#include "app/lab/parameters/parameters.h"
#include "app/lab/session/lab_status.h"

namespace twinarm {

// For all clients alike, but for `you` and `secret`: addressed() puts them in.
std::string state_message(const LabStatus& status, const Audience::View& audience,
                          const std::vector<Knob>& knobs, const std::vector<GalleryScene>& gallery);
std::string addressed(const std::string& state, ClientId you, const std::string& secret);

}  // namespace twinarm
