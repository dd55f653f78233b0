#include "box.hpp"

#include <cmath>

namespace hg::test {

Box::Box(CeedInt dim_, CeedInt n, CeedInt P_1d_, const std::function<Values(const Values &)> &map)
    : dim(dim_), P_1d(P_1d_), num_elem(CeedIntPow(n, dim_)), elem_size(CeedIntPow(P_1d_, dim_)) {
  const CeedInt line = n * (P_1d - 1) + 1;
  num_nodes = CeedIntPow(line, dim);
  Values nodes(P_1d);
  ok(CeedLobattoQuadrature(P_1d, nodes.data(), nullptr));
  coordinates.resize(static_cast<std::size_t>(num_nodes) * dim);
  for (CeedInt i = 0; i < num_nodes; i++) {
    Values x;
    for (CeedInt d = 0, rest = i; d < dim; d++, rest /= line) {
      const CeedInt cell = std::min(rest % line / (P_1d - 1), n - 1), local = rest % line - cell * (P_1d - 1);
      x.push_back((cell + (nodes[local] + 1) / 2) / n);
    }
    const Values place = map(x);
    for (CeedInt d = 0; d < dim; d++) coordinates[d * num_nodes + i] = place[d];
  }
  for (CeedInt e = 0; e < num_elem; e++) {
    for (CeedInt node = 0; node < elem_size; node++) {
      CeedInt place = 0, stride = 1;
      for (CeedInt d = 0, cell = e, local = node; d < dim; d++, cell /= n, local /= P_1d, stride *= line) {
        place += stride * (cell % n * (P_1d - 1) + local % P_1d);
      }
      offsets.push_back(place);
    }
  }
}

Box::Box(CeedInt dim_, CeedInt n, CeedInt P_1d_) : Box(dim_, n, P_1d_, [](const Values &x) { return x; }) {}

Restriction Box::restriction(Ceed ceed, CeedInt num_comp) const {
  Restriction rstr;
  ok(CeedElemRestrictionCreate(ceed, num_elem, elem_size, num_comp, num_nodes,
                               static_cast<CeedSize>(num_nodes) * num_comp, CEED_MEM_HOST, CEED_COPY_VALUES,
                               offsets.data(), rstr.out()));
  return rstr;
}

Values bent(const Values &x) {
  Values place = x;
  for (std::size_t d = 0; d < x.size(); d++) {
    CeedScalar product = 0.1;
    for (const CeedScalar other : x) product *= std::sin(3 * other + static_cast<CeedScalar>(d));
    place[d] += product;
  }
  return place;
}

}  // namespace hg::test
