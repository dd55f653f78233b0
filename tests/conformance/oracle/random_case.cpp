// Random operators for comparison with the oracle.
#include <algorithm>

#include "case.hpp"
#include "support/errors.hpp"

namespace hg::test {
namespace {

/// Gives the elements of a space nodes of an L-vector at random.
void place_nodes(Space &space, const Case &c, Random &random, CeedInt num_nodes) {
  const bool is_interleaved = random.chance(0.5);
  space.comp_stride = is_interleaved ? 1 : num_nodes;
  for (CeedInt e = 0; e < c.num_elem; e++) {
    for (const CeedInt node : random.distinct(space.elem_size, num_nodes)) {
      space.offsets.push_back(is_interleaved ? node * space.num_comp : node);
    }
  }
}

CeedInt shared_nodes(const Space &space, const Case &c, Random &random) {
  return space.elem_size + random.integer(0, std::max(1, c.num_elem * space.elem_size / 2));
}

/// A space with a basis: elements share nodes at random. l_size > 0 asks for an L-vector of that length.
Space random_space(const Case &c, Random &random, CeedInt num_comp, CeedSize l_size) {
  static const CeedInt max_P_1d[] = {0, 6, 4, 3};
  Space space;
  space.num_comp = num_comp;
  space.P_1d = random.integer(2, c.at_points ? std::min(max_P_1d[c.dim], c.Q_1d) : max_P_1d[c.dim]);
  space.elem_size = CeedIntPow(space.P_1d, c.dim);
  CeedInt num_nodes = shared_nodes(space, c, random);
  if (l_size > 0) {
    // As many nodes as fit; some entries may belong to none.
    while (space.elem_size * num_comp > l_size && space.num_comp > 1) num_comp = --space.num_comp;
    while (space.elem_size * num_comp > l_size && space.P_1d > 2) {
      space.P_1d--;
      space.elem_size = CeedIntPow(space.P_1d, c.dim);
    }
    num_nodes = static_cast<CeedInt>(l_size / num_comp);
  }
  space.l_size = l_size > 0 ? l_size : static_cast<CeedSize>(num_nodes) * num_comp;
  place_nodes(space, c, random, num_nodes);
  return space;
}

/// The same with random matrices for a basis, in H^1, H(div) or H(curl).
Space tabulated_space(const Case &c, Random &random, CeedInt num_comp, CeedSize l_size) {
  static const std::vector<CeedElemTopology> topologies[] = {
      {},
      {CEED_TOPOLOGY_LINE},
      {CEED_TOPOLOGY_TRIANGLE, CEED_TOPOLOGY_QUAD},
      {CEED_TOPOLOGY_TET, CEED_TOPOLOGY_PYRAMID, CEED_TOPOLOGY_PRISM, CEED_TOPOLOGY_HEX}};
  const auto &shapes = topologies[c.dim];
  Space space;
  space.kind = static_cast<CeedFESpace>(random.integer(CEED_FE_SPACE_H1, CEED_FE_SPACE_HCURL));
  space.topology = shapes[random.integer(0, static_cast<CeedInt>(shapes.size()) - 1)];
  space.num_comp = std::min<CeedInt>(num_comp, 4);
  space.elem_size = random.integer(1, 12);
  CeedInt num_nodes = shared_nodes(space, c, random);
  if (l_size > 0) {
    space.num_comp = static_cast<CeedInt>(std::min<CeedSize>(space.num_comp, l_size));
    num_nodes = static_cast<CeedInt>(l_size / space.num_comp);
    space.elem_size = std::min(space.elem_size, num_nodes);
  }
  space.l_size = l_size > 0 ? l_size : static_cast<CeedSize>(num_nodes) * space.num_comp;
  const CeedSize size = static_cast<CeedSize>(c.max_points()) * space.elem_size;
  space.interp = random.reals(space.q_comp(c.dim, CEED_EVAL_INTERP) * size);
  space.derivative = random.reals(space.q_comp(c.dim, space.derivative_mode()) * size);
  place_nodes(space, c, random, num_nodes);
  return space;
}

/// One node for each point.
Space point_space(const Case &c, Random &random, CeedInt num_comp) {
  Space space;
  space.num_comp = num_comp;
  space.l_size = static_cast<CeedSize>(c.total_points()) * num_comp;
  if (c.at_points) {
    for (CeedInt e = 0, start = c.num_elem + 1; e <= c.num_elem; e++) {
      space.point_list.push_back(start);
      if (e < c.num_elem) start += c.num_points[e];
    }
    for (const auto &numbers : c.point_numbers) {
      space.point_list.insert(space.point_list.end(), numbers.begin(), numbers.end());
    }
    return space;
  }
  const CeedInt Q = c.max_points();
  space.elem_size = Q;
  switch (random.integer(0, 2)) {
    case 0:  // point fastest, then component
      space.is_strided = true;
      space.comp_stride = Q;
      for (CeedInt e = 0; e < c.num_elem; e++) {
        for (CeedInt q = 0; q < Q; q++) space.offsets.push_back(e * Q * num_comp + q);
      }
      space.strides[0] = 1, space.strides[1] = Q, space.strides[2] = Q * num_comp;
      break;
    case 1:  // component fastest
      space.is_strided = true;
      space.comp_stride = 1;
      for (CeedInt i = 0; i < c.num_elem * Q; i++) space.offsets.push_back(i * num_comp);
      space.strides[0] = num_comp, space.strides[1] = 1, space.strides[2] = Q * num_comp;
      break;
    default:  // any order, by offsets
      space.comp_stride = c.num_elem * Q;
      space.offsets = random.distinct(c.num_elem * Q, c.num_elem * Q);
  }
  return space;
}

/// Adds fields while their values fit in the mixing matrix.
class Builder {
 public:
  Builder(Case &c, Random &random, const CaseWishes &wishes) : c_(c), random_(random), wishes_(wishes) {}

  int add_space(Space space) {
    c_.spaces.push_back(std::move(space));
    return static_cast<int>(c_.spaces.size()) - 1;
  }
  int add_vector(int space, CeedScalar low = -1, CeedScalar high = 1) {
    c_.passive.push_back(random_.reals(c_.spaces[space].l_size, low, high));
    return static_cast<int>(c_.passive.size()) - 1;
  }
  bool add(std::vector<Field> &fields, CeedEvalMode mode, int space, int vector) {
    Field field{(&fields == &c_.inputs ? "in" : "out") + std::to_string(fields.size()), mode, space, vector};
    CeedInt total = c_.size(field);
    for (const Field &other : fields) total += c_.size(other);
    if (total > MIX_MAX_VALUES || fields.size() >= MIX_MAX_FIELDS) return false;
    fields.push_back(field);
    return true;
  }
  CeedInt comps(CeedInt high = 9) { return random_.integer(1, std::min<CeedInt>(high, wishes_.max_comp)); }
  CeedEvalMode any_mode(int space) {
    return random_.chance(0.5) ? CEED_EVAL_INTERP : c_.spaces[space].derivative_mode();
  }
  CeedEvalMode other_mode(int space, CeedEvalMode mode) const {
    return mode == CEED_EVAL_INTERP ? c_.spaces[space].derivative_mode() : CEED_EVAL_INTERP;
  }
  /// A space with a basis; l_size > 0 asks for an L-vector of that length.
  int add_basis_space(CeedInt num_comp, CeedSize l_size = 0) {
    // A tensor product has 2^dim nodes at least; matrices may have fewer.
    const bool is_too_small = l_size > 0 && l_size < CeedIntPow(2, c_.dim);
    const bool is_tabulated = is_too_small || (wishes_.mixes_spaces && random_.chance(0.6));
    if (is_tabulated) return add_space(tabulated_space(c_, random_, num_comp, l_size));
    Space space = random_space(c_, random_, num_comp, l_size);
    if (wishes_.has_matrices && !c_.at_points && random_.chance(0.5)) {
      space.interp_1d = random_.reals(static_cast<CeedSize>(c_.Q_1d) * space.P_1d);
      space.grad_1d = random_.reals(static_cast<CeedSize>(c_.Q_1d) * space.P_1d);
    }
    return add_space(std::move(space));
  }

  /// Active fields of one space, or of a second one with an L-vector of the same length.
  void add_active(std::vector<Field> &fields, int space) {
    const CeedEvalMode mode = any_mode(space);
    add(fields, mode, space, -1);
    if (random_.chance(0.5)) add(fields, other_mode(space, mode), space, -1);
    if (!wishes_.is_square && random_.chance(0.3)) {
      const int other = add_basis_space(comps(3), c_.spaces[space].l_size);
      add(fields, any_mode(other), other, -1);
    }
  }

  void add_inputs(int active_space) {
    const int kind = wishes_.is_square || wishes_.is_bilinear ? 0 : random_.integer(0, 9);
    if (kind < 7) {
      add_active(c_.inputs, active_space);
    } else if (kind < 9) {
      add(c_.inputs, CEED_EVAL_NONE, add_space(point_space(c_, random_, comps())), -1);
    }
    if (random_.chance(0.6)) add(c_.inputs, CEED_EVAL_WEIGHT, -1, -1);
    if (random_.chance(0.5)) {
      const int space = add_space(point_space(c_, random_, comps()));
      add(c_.inputs, CEED_EVAL_NONE, space, add_vector(space));
      if (random_.chance(0.3)) add(c_.inputs, CEED_EVAL_NONE, space, add_vector(space));
    }
    if (random_.chance(0.5) || c_.inputs.empty()) {
      const int space = add_basis_space(comps(3));
      const int vector = add_vector(space);
      add(c_.inputs, CEED_EVAL_INTERP, space, vector);
      // The same values again, and another vector of the same space.
      if (random_.chance(0.5)) add(c_.inputs, c_.spaces[space].derivative_mode(), space, vector);
      if (random_.chance(0.3)) add(c_.inputs, CEED_EVAL_INTERP, space, add_vector(space));
    }
    // The active space with a passive vector.
    if (random_.chance(0.3)) add(c_.inputs, any_mode(active_space), active_space, add_vector(active_space));
  }

  void add_outputs(int active_space) {
    const int kind = wishes_.is_square || wishes_.is_bilinear ? 0 : random_.integer(0, 9);
    if (kind < 7) {
      const bool is_same = wishes_.is_square || random_.chance(0.5);
      add_active(c_.outputs, is_same ? active_space : add_basis_space(comps()));
    } else if (kind < 9) {
      add(c_.outputs, CEED_EVAL_NONE, add_space(point_space(c_, random_, comps())), -1);
    }
    if (!wishes_.is_square && (random_.chance(0.3) || c_.outputs.empty())) {
      const int space = add_space(point_space(c_, random_, comps()));
      add(c_.outputs, CEED_EVAL_NONE, space, add_vector(space));
    }
    if (!wishes_.is_square && random_.chance(0.2)) {
      const int space = add_basis_space(comps(3));
      add(c_.outputs, any_mode(space), space, add_vector(space));
    }
  }

 private:
  Case &c_;
  Random &random_;
  const CaseWishes &wishes_;
};

/// Signs, or tridiagonal matrices, for the spaces that have offsets; and blocks.
void orient(Case &c, Random &random) {
  for (Space &space : c.spaces) {
    if (!space.point_list.empty()) continue;
    space.block_size = random.integer(0, 4);
    if (space.is_strided || random.chance(0.2)) continue;
    const bool has_signs = random.chance(0.4);
    space.type = has_signs ? CEED_RESTRICTION_ORIENTED : CEED_RESTRICTION_CURL_ORIENTED;
    for (std::size_t i = 0; i < space.offsets.size(); i++) {
      for (int band = -1; band <= 1; band++) {
        const CeedInt entry = has_signs ? (band == 0 ? 2 * random.integer(0, 1) - 1 : 0) : random.integer(-1, 1);
        space.orientation.push_back(static_cast<CeedInt8>(entry));
      }
    }
  }
}

void place_quadrature_points(Case &c) {
  Values points(c.Q_1d), weights(c.Q_1d);
  ok(c.quad_mode == CEED_GAUSS ? CeedGaussQuadrature(c.Q_1d, points.data(), weights.data())
                               : CeedLobattoQuadrature(c.Q_1d, points.data(), weights.data()));
  const CeedInt Q = CeedIntPow(c.Q_1d, c.dim);
  c.num_points.assign(c.num_elem, Q);
  c.x.assign(c.num_elem, {});
  for (auto &element : c.x) {
    for (CeedInt q = 0; q < Q; q++) {
      Values x;
      for (CeedInt d = 0, rest = q; d < c.dim; d++, rest /= c.Q_1d) x.push_back(points[rest % c.Q_1d]);
      element.push_back(x);
    }
  }
}

}  // namespace

void place_points(Case &c, Random &random, bool keep_counts) {
  if (!keep_counts) {
    c.num_points.clear();
    // Ragged, some elements empty; at least one point in all.
    for (CeedInt e = 0; e < c.num_elem; e++) {
      c.num_points.push_back(random.chance(0.2) ? 0 : random.integer(1, c.dim == 3 ? 9 : 7));
    }
    if (c.num_elem > 0 && c.total_points() == 0) c.num_points[random.integer(0, c.num_elem - 1)] = 1;
    const std::vector<CeedInt> order = random.distinct(c.total_points(), c.total_points());
    c.point_numbers.assign(c.num_elem, {});
    for (CeedInt e = 0, next = 0; e < c.num_elem; e++) {
      for (CeedInt q = 0; q < c.num_points[e]; q++) c.point_numbers[e].push_back(order[next++]);
    }
  }
  c.x.assign(c.num_elem, {});
  for (CeedInt e = 0; e < c.num_elem; e++) {
    for (CeedInt q = 0; q < c.num_points[e]; q++) c.x[e].push_back(random.reals(c.dim));
  }
}

Case random_case(Random &random, const CaseWishes &wishes) {
  static const CeedInt max_Q_1d[] = {0, 7, 5, 4}, max_small_Q_1d[] = {0, 5, 3, 3};
  Case c;
  c.dim = wishes.dim > 0 ? wishes.dim : random.integer(1, 3);
  c.num_elem = random.chance(0.2) ? 1 : random.integer(2, wishes.is_small ? 3 : 7);
  if (wishes.has_many_elements) c.num_elem = random.integer(9, 20);
  c.at_points = wishes.at_points;
  c.quad_mode = random.chance(0.7) ? CEED_GAUSS : CEED_GAUSS_LOBATTO;
  c.Q_1d = random.integer(c.quad_mode == CEED_GAUSS && !c.at_points ? 1 : 2,
                          wishes.is_small ? max_small_Q_1d[c.dim] : max_Q_1d[c.dim]);
  if (c.at_points) {
    place_points(c, random, false);
  } else {
    place_quadrature_points(c);
  }
  Builder builder(c, random, wishes);
  const int active_space = builder.add_basis_space(builder.comps());
  builder.add_inputs(active_space);
  builder.add_outputs(active_space);

  c.mix.num_in = static_cast<CeedInt>(c.inputs.size());
  c.mix.num_out = static_cast<CeedInt>(c.outputs.size());
  for (std::size_t i = 0; i < c.inputs.size(); i++) {
    c.mix.in_size[i] = c.size(c.inputs[i]);
    c.mix.in_is_active[i] = c.inputs[i].is_active();
  }
  for (std::size_t i = 0; i < c.outputs.size(); i++) c.mix.out_size[i] = c.size(c.outputs[i]);
  for (CeedScalar &factor : c.mix.factor) factor = random.real(-0.2, 0.2);
  for (CeedScalar &entry : c.mix.matrix) entry = random.real();
  if (wishes.is_oriented) orient(c, random);
  return c;
}

}  // namespace hg::test
