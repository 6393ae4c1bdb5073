// The painter draws into framebuffer objects: neither back end needs a surface.
#include "app/render/gl/painter.h"

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/osmesa.h>
#include <dlfcn.h>

#include <stdexcept>

#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

[[noreturn]] void fail(const std::string& library, const std::string& problem,
                       const std::string& fix) {
  throw InputError({Diagnostic{"", 0, "renderer " + library, problem, fix, "render.library"}});
}

// Never closed: unloading Mesa and LLVM, with threads and exit handlers, is not safe.
class Library {
 public:
  Library(const std::string& file, const std::string& package)
      : file_(file), handle_(dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL)) {
    if (handle_ == nullptr) {
      const char* reason = dlerror();
      fail(file, std::string("cannot be loaded: ") + (reason ? reason : "unknown reason"),
           "install " + package + ", or choose the other renderer");
    }
  }
  template <class Function>
  void load(Function& function, const char* name) const {
    function = reinterpret_cast<Function>(dlsym(handle_, name));
    if (function == nullptr)
      fail(file_, std::string("has no function ") + name, "install the version of Debian 12");
  }

 private:
  std::string file_;
  void* handle_;
};

class OsMesaContext final : public OffscreenContext {
 public:
  OsMesaContext() : library_("libOSMesa.so.8", "libosmesa6") {
    decltype(&OSMesaCreateContextAttribs) create = nullptr;
    library_.load(create, "OSMesaCreateContextAttribs");
    library_.load(make_current_, "OSMesaMakeCurrent");
    library_.load(destroy_, "OSMesaDestroyContext");
    library_.load(proc_, "OSMesaGetProcAddress");
    // clang-format off
    const std::array<int, 13> attributes = {
        OSMESA_FORMAT, OSMESA_RGBA, OSMESA_DEPTH_BITS, 0, OSMESA_STENCIL_BITS, 0,
        OSMESA_PROFILE, OSMESA_CORE_PROFILE,
        OSMESA_CONTEXT_MAJOR_VERSION, 3, OSMESA_CONTEXT_MINOR_VERSION, 3, 0};
    // clang-format on
    context_ = create(attributes.data(), nullptr);
    if (context_ == nullptr)
      fail("OSMesa", "has no OpenGL 3.3 core context", "install Mesa 17 or newer, or use egl");
  }
  ~OsMesaContext() override {
    make_current_(nullptr, nullptr, 0, 0, 0);
    destroy_(context_);
  }
  void make_current() override {
    if (!make_current_(context_, surface_.data(), GL_UNSIGNED_BYTE, kSide, kSide))
      throw std::runtime_error("OSMesaMakeCurrent failed");
  }
  void release() override { make_current_(nullptr, nullptr, 0, 0, 0); }
  void* proc(const char* name) override { return reinterpret_cast<void*>(proc_(name)); }

 private:
  static constexpr int kSide = 4;  // OSMesa requires a colour buffer, which stays unused

  Library library_;
  decltype(&OSMesaMakeCurrent) make_current_ = nullptr;
  decltype(&OSMesaDestroyContext) destroy_ = nullptr;
  decltype(&OSMesaGetProcAddress) proc_ = nullptr;
  OSMesaContext context_ = nullptr;
  std::array<unsigned char, 4 * kSide * kSide> surface_{};
};

class EglContext final : public OffscreenContext {
 public:
  EglContext() : library_("libEGL.so.1", "libegl1 libegl-mesa0") {
    library_.load(proc_, "eglGetProcAddress");
    library_.load(make_current_, "eglMakeCurrent");
    library_.load(destroy_, "eglDestroyContext");
    open_display();
    create_context();
  }
  // The display is not terminated: all contexts of the process share it.
  ~EglContext() override {
    release();
    destroy_(display_, context_);
  }
  void make_current() override {
    // The API is bound by thread.
    bind_api_(EGL_OPENGL_API);
    if (!make_current_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
      throw std::runtime_error("eglMakeCurrent failed");
  }
  void release() override {
    make_current_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
  void* proc(const char* name) override { return reinterpret_cast<void*>(proc_(name)); }

 private:
  void open_display() {
    decltype(&eglInitialize) initialize = nullptr;
    library_.load(initialize, "eglInitialize");
    const auto get_display =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(proc_("eglGetPlatformDisplayEXT"));
    if (get_display != nullptr)
      display_ = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display_ == EGL_NO_DISPLAY || !initialize(display_, nullptr, nullptr))
      fail("EGL", "has no surfaceless display", "install libegl-mesa0, or use osmesa");
  }

  void create_context() {
    decltype(&eglCreateContext) create = nullptr;
    library_.load(bind_api_, "eglBindAPI");
    library_.load(create, "eglCreateContext");
    // clang-format off
    const std::array<EGLint, 7> attributes = {
        EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 3,
        EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    // clang-format on
    if (bind_api_(EGL_OPENGL_API))
      context_ = create(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    if (context_ == EGL_NO_CONTEXT)
      fail("EGL", "has no OpenGL 3.3 core context", "install libgl1-mesa-dri, or use osmesa");
  }

  Library library_;
  decltype(&eglGetProcAddress) proc_ = nullptr;
  decltype(&eglMakeCurrent) make_current_ = nullptr;
  decltype(&eglDestroyContext) destroy_ = nullptr;
  decltype(&eglBindAPI) bind_api_ = nullptr;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<OffscreenContext> make_offscreen_context(Backend backend) {
  if (backend == Backend::egl) return std::make_unique<EglContext>();
  return std::make_unique<OsMesaContext>();
}

}  // namespace twinarm
