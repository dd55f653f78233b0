/// Which instruction set serves.
#include <cstdlib>
#include <string_view>

#include "kernels.hpp"

namespace hg::host {

namespace portable {
extern const Kernels table, element_table;
}
#ifdef HG_HOST_X86
namespace avx2 {
extern const Kernels table, element_table;
}
namespace avx512 {
extern const Kernels table, element_table;
}
#endif

const Kernels *kernels(bool is_blocked, const char **reason) {
  const char *wanted = std::getenv("CEED_HOST_ISA");
  const auto serves = [&](const Kernels &candidate, bool machine_has_it) {
    return machine_has_it && (wanted == nullptr || std::string_view(wanted) == candidate.isa);
  };
#ifdef HG_HOST_X86
  const bool has_avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  const bool has_avx512 = has_avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                          __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
  if (serves(avx512::table, has_avx512)) return is_blocked ? &avx512::table : &avx512::element_table;
  if (serves(avx2::table, has_avx2)) return is_blocked ? &avx2::table : &avx2::element_table;
#endif
  if (serves(portable::table, true)) return is_blocked ? &portable::table : &portable::element_table;
  *reason = "CEED_HOST_ISA names no instruction set of this machine; expected portable, avx2 or avx512";
  return nullptr;
}

}  // namespace hg::host
