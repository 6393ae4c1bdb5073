// Time of a picture: about 20,000 triangles with shadows, rotating camera. Processor time of this
// process in milliseconds; LP_NUM_THREADS=0 disables Mesa's threads.
//
//   LP_NUM_THREADS=0 bench_frames [FRAMES]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "app/render/gl/painter.h"

namespace twinarm {
namespace {

double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

// 36 bodies on a floor: nine spheres, the rest boxes, rods and arrows.
DrawList scene() {
  DrawList list;
  for (int i = 0; i < 9; ++i) {
    const Vector3 p(0.3 * (i % 3) - 0.3, 0.3 * (i / 3) - 0.3, 0.12);
    add_sphere(list, p, 0.1, {0.34f, 0.56f, 0.74f, 1});
    add_box(list, {Matrix3::Identity(), p + Vector3(0.14, 0, -0.08)}, {0.06, 0.06, 0.08},
            {0.9f, 0.7f, 0.36f, 1});
    add_arrow(list, p, p + Vector3(0, 0, 0.25), 0.008, {0.8f, 0.16f, 0.14f, 1});
  }
  list.camera.target = Vector3(0, 0, 0.1);
  return list;
}

std::size_t triangles(const DrawList& list) {
  std::size_t sum = 0;
  for (const Instance& instance : list.instances)
    sum += list.meshes[instance.mesh]->triangles.size();
  return sum;
}

void measure(DrawList list, int width, int height, Quality quality, const char* name, int frames) {
  Painter painter(Backend::osmesa, width, height, quality);
  std::vector<double> costs;
  for (int i = -3; i < frames; ++i) {  // the first ones compile shaders
    const double turn = 0.02 * i;
    list.camera.eye = Vector3(1.5 * std::cos(turn), 1.5 * std::sin(turn), 0.9);
    const double before = processor_ms();
    const Image image = painter.paint(list);
    if (i >= 0) costs.push_back(processor_ms() - before);
  }
  std::sort(costs.begin(), costs.end());
  std::printf("%-28s median %6.1f ms, least %6.1f ms of processor time per frame\n", name,
              costs[costs.size() / 2], costs.front());
}

}  // namespace
}  // namespace twinarm

int main(int argc, char** argv) {
  using namespace twinarm;
  const int frames = argc > 1 ? std::max(1, std::atoi(argv[1])) : 50;
  const DrawList list = scene();
  std::printf("%zu triangles, %zu instances, %d frames\n", triangles(list), list.instances.size(),
              frames);
  measure(list, 1280, 720, Quality::normal, "1280x720, 4 samples a pixel", frames);
  measure(list, 640, 480, Quality::draft, "640x480, no antialiasing", frames);
}
