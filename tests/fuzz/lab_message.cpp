// What a page says to the lab; changes go into a scene, which is read again.
#include "app/lab/session/lab_command.h"
#include "app/record/unpack.h"
#include "app/scene/read/read_scene.h"
#include "tests/fuzz/fuzz_input.h"

namespace twinarm::fuzz {
namespace {

constexpr const char* kScene = R"(duration = 1
[[body]]
name = "ball"
shape = { sphere = { radius = 0.1 } }
mass = 1
position = [0, 0, 1]
[[body]]
name = "floor"
fixed = true
shape = { halfspace = { normal = [0, 0, 1], offset = 0 } }
[[pair]]
a = "ball"
b = "floor"
friction = 0.5
)";

}  // namespace

void lab_message(Bytes bytes) {
  static const std::filesystem::path file = folder().write("lab.toml", kScene);
  static const Value scene = read_toml(file);
  goes_through([&] {
    const LabCommand command = parse_command(std::string(bytes));
    needs_control(command.what);
    if (command.what != "set" && command.what != "branch") return;
    Value tree = scene;
    DiagnosticList faults;
    for (const std::string& text : command.names) apply(parse_change(text), -1, tree, faults);
    faults.check();
    read_scene(tree, file);
  });
}

}  // namespace twinarm::fuzz
