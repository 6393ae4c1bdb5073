#include "solver/dynamics/dynamics.h"

#include <algorithm>
#include <cstdlib>

#include "solver/passes/aba.h"
#ifdef TWINARM_HAS_LEVELS
#include <cpuid.h>
#endif

namespace twinarm {

// Defined by solver/passes/compiled/passes.cpp, per scalar and level.
#define TWINARM_TABLE(isa, ...)       \
  namespace isa {                     \
  template <class S>                  \
  const Passes<S>& table();           \
  template <>                         \
  const Passes<__VA_ARGS__>& table(); \
  }
TWINARM_TABLE(generic, double)
TWINARM_TABLE(generic, Dual<8>)
TWINARM_TABLE(generic, Batch<4>)
TWINARM_TABLE(generic, Batch<8>)
#ifdef TWINARM_HAS_LEVELS
TWINARM_TABLE(v3, double)
TWINARM_TABLE(v3, Batch<4>)
TWINARM_TABLE(v3, Batch<8>)
TWINARM_TABLE(v4, double)
TWINARM_TABLE(v4, Batch<8>)
#endif
#undef TWINARM_TABLE

// Dual numbers are not used within steps: generic level only. v4 is built for scalars that fill
// vectors of eight doubles.
template <class S>
[[maybe_unused]] constexpr bool kHasLevels = !std::is_same_v<S, Dual<8>>;
template <class S>
[[maybe_unused]] constexpr bool kHasV4 = std::is_same_v<S, double> || std::is_same_v<S, Batch<8>>;

const char* name_of(Isa isa) {
  constexpr std::array names{"generic", "v3", "v4"};
  return names[static_cast<std::size_t>(isa)];
}

namespace {

Isa of_this_processor() {
#ifdef TWINARM_HAS_LEVELS
  __builtin_cpu_init();
  unsigned a, b, basic = 0, extended = 0, d;  // clang 14 cannot name MOVBE, F16C and LZCNT
  __get_cpuid(1, &a, &b, &basic, &d), __get_cpuid(0x80000001, &a, &b, &extended, &d);
  const bool v3 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                  __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") &&
                  (basic >> 22 & basic >> 29 & extended >> 5 & 1) != 0;
  const bool v4 = v3 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                  __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
                  __builtin_cpu_supports("avx512cd");
  return v4 ? Isa::v4 : v3 ? Isa::v3 : Isa::generic;
#else
  return Isa::generic;
#endif
}

}  // namespace

Isa best_isa() {
  static const Isa best = [] {
    const Isa here = of_this_processor();
    const char* cap = std::getenv("TWINARM_ISA");
    for (const Isa isa : {Isa::generic, Isa::v3})
      if (cap && std::string_view(cap) == name_of(isa) && isa < here) return isa;
    return here;
  }();
  return best;
}

template <class S>
const Passes<S>& passes([[maybe_unused]] Isa isa) {
#ifdef TWINARM_HAS_LEVELS
  if constexpr (kHasLevels<S>) {
    isa = std::min(isa, of_this_processor());
    if constexpr (kHasV4<S>)
      if (isa == Isa::v4) return v4::table<S>();
    if (isa >= Isa::v3) return v3::table<S>();
  }
#endif
  return generic::table<S>();
}
template <class S>
const Passes<S>& passes() {
  static const Passes<S>& best = passes<S>(best_isa());
  return best;
}

template const Passes<double>& passes();
template const Passes<Dual<8>>& passes();
template const Passes<Batch<4>>& passes();
template const Passes<Batch<8>>& passes();
template const Passes<double>& passes(Isa);
template const Passes<Dual<8>>& passes(Isa);
template const Passes<Batch<4>>& passes(Isa);
template const Passes<Batch<8>>& passes(Isa);

void aba(const Model<double>& model, const State<double>& x, const Forces<double>& forces,
         Workspace<double>& w, FullTrace<double>& trace) {
  generic::aba(model, x, forces, w, trace);
}

Eigen::MatrixXd mass_matrix(const Model<double>& model, const State<double>& x) {
  Workspace<double> w(model);
  const auto n = static_cast<Eigen::Index>(model.nv);
  Eigen::MatrixXd M(n, n);
  crba(model, x, w, {M.data(), model.nv * model.nv});  // symmetric: row-major = column-major
  return M;
}

}  // namespace twinarm
