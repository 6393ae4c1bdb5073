// Every way into the program, as a function of bytes. Whatever the bytes: it comes back, within
// seconds and a gigabyte, and throws nothing.
#pragma once

#include <string_view>
#include <vector>

namespace twinarm::fuzz {

using Bytes = std::string_view;

void command_line(Bytes bytes);
void gestures(Bytes bytes);
void hand_file(Bytes bytes);
void http(Bytes bytes);
void image(Bytes bytes);
void lab_message(Bytes bytes);
void lab_session(Bytes bytes);
void mesh_file(Bytes bytes);
void mesh_shape(Bytes bytes);
void packed_model(Bytes bytes);
void recipe(Bytes bytes);
void recording(Bytes bytes);
void scene(Bytes bytes);
void state(Bytes bytes);
void study_file(Bytes bytes);
void tile(Bytes bytes);
void urdf(Bytes bytes);
void vrpn(Bytes bytes);

struct Target {
  const char* name;
  void (*run)(Bytes bytes);
};
inline const std::vector<Target> kTargets{{"command_line", command_line},
                                          {"gestures", gestures},
                                          {"hand_file", hand_file},
                                          {"http", http},
                                          {"image", image},
                                          {"lab_message", lab_message},
                                          {"lab_session", lab_session},
                                          {"mesh_file", mesh_file},
                                          {"mesh_shape", mesh_shape},
                                          {"packed_model", packed_model},
                                          {"recipe", recipe},
                                          {"recording", recording},
                                          {"scene", scene},
                                          {"state", state},
                                          {"study_file", study_file},
                                          {"tile", tile},
                                          {"urdf", urdf},
                                          {"vrpn", vrpn}};

}  // namespace twinarm::fuzz
