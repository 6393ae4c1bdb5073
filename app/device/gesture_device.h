// Keyboard, game controller and space mouse as hand devices: their gestures move the hand of a
// virtual Omni. One thread reads the device's bytes; poll() and render() never wait.
//
// A device that is unplugged makes `alive` false and lets go of everything; it is looked for twice
// a second until it is back.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "app/device/file_descriptors.h"
#include "app/device/gesture_decoder.h"
#include "coupling/device/virtual_omni.h"

namespace twinarm {

// Where the bytes come from. None has motors: what the force does to the virtual Omni is seen, not
// felt.
struct GestureSource {
  std::string description;
  std::unique_ptr<GestureDecoder> decoder;
  OwnedFd fd;                      // that does not block
  std::function<OwnedFd()> again;  // opens it anew; empty: gone is gone
  std::shared_ptr<void> keep;      // as long as the device lives: a terminal's mode
};

class GestureDevice final : public HandDevice {
 public:
  GestureDevice(GestureSource source, const VirtualOmniSettings& settings);
  ~GestureDevice() override;
  DeviceState poll(double now) noexcept override;
  void render(const DeviceForce& force) noexcept override { omni_.render(force); }
  const OmniParameters& figures() const override { return omni_.figures(); }
  std::string description() const override { return source_.description; }
  bool has_motors() const override { return false; }

 private:
  void run();
  bool read_some();

  GestureSource source_;
  std::shared_ptr<DesktopInput> hand_;
  VirtualOmni omni_;
  std::atomic<bool> connected_{true};
  OwnedFd stop_;
  std::thread thread_;
};

// Each throws InputError with a remedy where the device is not to be had. `path` may be empty.
GestureSource open_keyboard(const std::string& path);     // a terminal, by default /dev/tty
GestureSource open_gamepad(const std::string& path);      // by default the first /dev/input/js*
GestureSource open_space_mouse(const std::string& path);  // spacenavd's socket

}  // namespace twinarm
