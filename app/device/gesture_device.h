// Keyboard, game controller and space mouse as input devices: they move the operator of a virtual
// Omni. One thread reads the device; poll() and render() never block.
//
// An unplugged device sets `alive` to false and releases everything; reconnection is tried twice a
// second.
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

struct GestureSource {
  std::string description;
  std::unique_ptr<GestureDecoder> decoder;
  OwnedFd fd;                       // non-blocking
  std::function<OwnedFd()> reopen;  // empty: not possible
  std::shared_ptr<void> keep;       // lives as long as the device: a terminal's mode
};

class GestureDevice final : public InputDevice {
 public:
  GestureDevice(GestureSource source, const VirtualOmniSettings& settings);
  ~GestureDevice() override;
  DeviceState poll(double now) noexcept override;
  void render(const DeviceForce& force) noexcept override { omni_.render(force); }
  const OmniParameters& parameters() const override { return omni_.parameters(); }
  std::string description() const override { return source_.description; }
  bool has_motors() const override { return false; }

 private:
  void run();
  bool read_some();

  GestureSource source_;
  std::shared_ptr<DesktopInput> input_;
  VirtualOmni omni_;
  std::atomic<bool> connected_{true};
  OwnedFd stop_;
  std::thread thread_;
};

// Throw InputError: device not available. `path` may be empty.
GestureSource open_keyboard(const std::string& path);     // a terminal, by default /dev/tty
GestureSource open_gamepad(const std::string& path);      // by default the first /dev/input/js*
GestureSource open_space_mouse(const std::string& path);  // spacenavd's socket

}  // namespace twinarm
