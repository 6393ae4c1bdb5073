// Relocating assimp and FCL takes several milliseconds. So the program has them in modules, which
// it opens when it first needs them: these functions stand for those in the libraries of
// collision/, with which tests and other programs are linked.
#include <dlfcn.h>

#include <string>

#include "collision/detection/fcl_box_tree.h"
#include "collision/detection/fcl_contact.h"
#include "collision/mesh_files/assimp_reader.h"
#include "solver/support/diagnostics.h"

namespace twinarm {
namespace {

// Function `name` of a module in the program's RUNPATH. The module is never closed.
template <class Function>
Function* function_of(const char* module, const char* name) {
  void* const handle = dlopen(module, RTLD_NOW | RTLD_LOCAL);
  void* const found = handle == nullptr ? nullptr : dlsym(handle, name);
  if (found == nullptr)
    throw InputError({{module, 0, "module", std::string("cannot be opened: ") + dlerror(),
                       "install twinarm and its libraries again", "program.module"}});
  return reinterpret_cast<Function*>(found);
}

}  // namespace
}  // namespace twinarm

twinarm::ChildWork twinarm_assimp_reader() {
  static const auto function = twinarm::function_of<decltype(twinarm_assimp_reader)>(
      "twinarm_assimp.so", "twinarm_assimp_reader");
  return function();
}

twinarm::BoxTree* twinarm_fcl_box_tree() {
  static const auto function = twinarm::function_of<decltype(twinarm_fcl_box_tree)>(
      "twinarm_fcl.so", "twinarm_fcl_box_tree");
  return function();
}

twinarm::FclContact* twinarm_fcl_contact() {
  static const auto function =
      twinarm::function_of<decltype(twinarm_fcl_contact)>("twinarm_fcl.so", "twinarm_fcl_contact");
  return function();
}
